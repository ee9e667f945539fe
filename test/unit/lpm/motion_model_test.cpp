#include "lpm/motion_model.hpp"

#include <random>

#include <gmock/gmock.h>

#include "lpm/constant_velocity.hpp"

namespace cairn {
namespace {

/// A robot whose wheels err always in the same way, and at random.
struct Wheels {
  OdometryCalibration truth;
  double drive_m2_per_m = 4e-4;
  double turn_rad2_per_rad = 4e-4;
  double turn_rad2_per_m = 1e-4;
};

struct Lesson {
  Pose2 odometry;
  GaussianPose matched;
  Pose2 truth;
};

GaussianPose seen(const Pose2& motion, double sigma_m, double sigma_rad, std::mt19937* random) {
  std::normal_distribution<double> normal;
  GaussianPose matched{
      Pose2(motion.x() + sigma_m * normal(*random), motion.y() + sigma_m * normal(*random),
            motion.theta() + sigma_rad * normal(*random)),
      Matrix3d::Zero()};
  matched.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  return matched;
}

/// What odometry says of a step, and what the robot really does.
Lesson a_step(const Wheels& wheels, double drive_m, double turn_rad, std::mt19937* random) {
  std::normal_distribution<double> normal;
  const OdometryCalibration& truth = wheels.truth;
  const double true_drive_m =
      truth.drive_scale * drive_m +
      std::sqrt(wheels.drive_m2_per_m * std::abs(drive_m)) * normal(*random);
  const double true_turn_rad = truth.turn_scale * turn_rad + truth.turn_rad_per_m * drive_m +
                               std::sqrt(wheels.turn_rad2_per_rad * std::abs(turn_rad) +
                                         wheels.turn_rad2_per_m * std::abs(drive_m)) *
                                   normal(*random);
  const auto arc = [](double drive, double slide, double turn) {
    return Pose2(Pose2(0.0, 0.0, 0.5 * turn) * Vector2d(drive, slide), turn);
  };
  Lesson lesson;
  lesson.odometry = arc(drive_m, 0.0, turn_rad);
  lesson.truth =
      arc(true_drive_m + truth.drive_m_per_rad * turn_rad,
          truth.slide_m_per_m * drive_m + truth.slide_m_per_rad * turn_rad, true_turn_rad);
  lesson.matched = seen(lesson.truth, 0.003, 0.002, random);
  return lesson;
}

/// Drives about, with all sorts of turns and some rest.
Lesson any_step(const Wheels& wheels, int step, std::mt19937* random) {
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  const bool rests = step % 50 >= 45;
  return rests ? a_step(wheels, 0.0, 0.0, random)
               : a_step(wheels, 0.1 + 0.05 * share(*random), 0.3 * share(*random), random);
}

MotionModel taught(const Wheels& wheels, int steps, std::mt19937* random) {
  MotionModel model;
  for (int i = 0; i < steps; ++i) {
    const Lesson lesson = any_step(wheels, i, random);
    model.learn(lesson.odometry, lesson.matched);
  }
  return model;
}

TEST(MotionModel, LearnsWhatOdometryGetsWrongAlways) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    Wheels wheels;
    wheels.truth.drive_scale = 1.0 + 0.1 * share(random);
    wheels.truth.turn_scale = 1.0 + 0.2 * share(random);
    wheels.truth.turn_rad_per_m = 0.08 * share(random);
    wheels.truth.slide_m_per_m = 0.03 * share(random);
    wheels.truth.slide_m_per_rad = 0.2 * share(random);
    wheels.truth.drive_m_per_rad = 0.1 * share(random);
    const OdometryCalibration found = taught(wheels, 3'000, &random).calibration();
    EXPECT_NEAR(found.drive_scale, wheels.truth.drive_scale, 0.015);
    EXPECT_NEAR(found.turn_scale, wheels.truth.turn_scale, 0.03);
    EXPECT_NEAR(found.turn_rad_per_m, wheels.truth.turn_rad_per_m, 0.015);
    EXPECT_NEAR(found.slide_m_per_m, wheels.truth.slide_m_per_m, 0.01);
    EXPECT_NEAR(found.slide_m_per_rad, wheels.truth.slide_m_per_rad, 0.01);
    EXPECT_NEAR(found.drive_m_per_rad, wheels.truth.drive_m_per_rad, 0.02);
  }
}

/// Mean squared Mahalanobis length of the error of predictions, whose expectation is 3.
double consistency(const MotionModel& model, const Wheels& wheels, std::mt19937* random) {
  double sum = 0.0;
  constexpr int kSteps = 500;
  for (int i = 0; i < kSteps; ++i) {
    const Lesson lesson = any_step(wheels, 0, random);
    const GaussianPose predicted = model.predict(lesson.odometry);
    sum += squared_mahalanobis(lesson.truth, predicted.mean, predicted.covariance);
  }
  return sum / kSteps;
}

TEST(MotionModel, SaysHowFarThisRobotIsToBeBelieved) {
  for (const double share : {0.1, 1.0, 10.0}) {
    SCOPED_TRACE(share);
    std::mt19937 random(7);
    Wheels wheels;
    wheels.drive_m2_per_m *= share;
    wheels.turn_rad2_per_rad *= share;
    wheels.turn_rad2_per_m *= share;
    const double learned = consistency(taught(wheels, 3'000, &random), wheels, &random);
    EXPECT_GT(learned, 0.6);
    EXPECT_LT(learned, 6.0);
  }
}

TEST(MotionModel, BelievesGoodWheelsMoreThanBadOnes) {
  std::mt19937 random(3);
  Wheels good;
  Wheels bad;
  bad.drive_m2_per_m = 25.0 * good.drive_m2_per_m;
  bad.turn_rad2_per_rad = 25.0 * good.turn_rad2_per_rad;
  bad.turn_rad2_per_m = 25.0 * good.turn_rad2_per_m;
  const Pose2 step(0.2, 0.0, 0.1);
  const Matrix3d good_covariance = taught(good, 2'000, &random).predict(step).covariance;
  const Matrix3d bad_covariance = taught(bad, 2'000, &random).predict(step).covariance;
  EXPECT_GT(bad_covariance(0, 0), 4.0 * good_covariance(0, 0));
  EXPECT_GT(bad_covariance(2, 2), 4.0 * good_covariance(2, 2));
}

TEST(MotionModel, NoticesThatWheelsHaveChanged) {
  std::mt19937 random(5);
  Wheels wheels;
  MotionModel model = taught(wheels, 2'000, &random);
  wheels.truth.drive_scale = 1.08;  // a tyre pumped up
  for (int i = 0; i < 2'000; ++i) {
    const Lesson lesson = any_step(wheels, i, &random);
    model.learn(lesson.odometry, lesson.matched);
  }
  EXPECT_NEAR(model.calibration().drive_scale, 1.08, 0.02);
}

TEST(MotionModel, IsNotSpoiltByOneSlip) {
  for (const double slip_m : {0.5, 5.0, 500.0}) {
    SCOPED_TRACE(slip_m);
    std::mt19937 random(11);
    MotionModel model = taught(Wheels{}, 1'000, &random);
    const OdometryCalibration before = model.calibration();
    const Matrix3d covariance = model.predict(Pose2(0.2, 0.0, 0.1)).covariance;
    Lesson slip = a_step(Wheels{}, 0.2, 0.1, &random);
    slip.odometry = Pose2(slip_m, 0.0, 1.5);
    model.learn(slip.odometry, slip.matched);
    EXPECT_NEAR(model.calibration().drive_scale, before.drive_scale, 0.01);
    EXPECT_NEAR(model.calibration().turn_scale, before.turn_scale, 0.02);
    EXPECT_NEAR(model.calibration().turn_rad_per_m, before.turn_rad_per_m, 0.01);
    EXPECT_LT(model.predict(Pose2(0.2, 0.0, 0.1)).covariance(0, 0), 1.1 * covariance(0, 0));
    EXPECT_LT(model.predict(Pose2(0.2, 0.0, 0.1)).covariance(2, 2), 1.1 * covariance(2, 2));
  }
}

// Along a corridor a match repeats the prediction: agreement there is no merit of the wheels.
TEST(MotionModel, LearnsNothingFromMatchesThatKnowNothing) {
  std::mt19937 random(13);
  MotionModel model = taught(Wheels{}, 300, &random);
  const double drive_before = model.predict(Pose2(0.2, 0.0, 0.0)).covariance(0, 0);
  const double scale_before = model.calibration().drive_scale;
  for (int i = 0; i < 2'000; ++i) {
    GaussianPose matched = model.predict(Pose2(0.1, 0.0, 0.0));
    matched.covariance.diagonal() << 1.0, 1e-5, 1e-6;
    model.learn(Pose2(0.1, 0.0, 0.0), matched);
  }
  EXPECT_GT(model.predict(Pose2(0.2, 0.0, 0.0)).covariance(0, 0), 0.7 * drive_before);
  EXPECT_NEAR(model.calibration().drive_scale, scale_before, 0.005);
}

TEST(MotionModel, StaysWithinItsBoundsWhateverItIsTold) {
  const MotionLearningOptions options;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  MotionModel model(options);
  for (int i = 0; i < 5'000; ++i) {
    const Pose2 odometry(any(random), any(random), any(random));
    model.learn(odometry, seen(Pose2(any(random), any(random), any(random)), 1e-4, 1e-4, &random));
    ASSERT_TRUE(is_positive_definite(model.predict(odometry).covariance));
  }
  EXPECT_LE(std::abs(model.calibration().drive_scale - 1.0),
            options.bound_sigmas * options.drive_scale_sigma + 1e-12);
  EXPECT_LE(model.noise().drive_m2_per_m,
            options.greatest_share * options.first.drive_m2_per_m + 1e-12);
  for (int i = 0; i < 20'000; ++i) {  // at rest, and perfect
    model.learn(Pose2(), {Pose2(), 1e-12 * Matrix3d::Identity()});
  }
  EXPECT_TRUE(is_positive_definite(model.predict(Pose2()).covariance));
}

TEST(MotionModel, IsTheSameForTheSameLessons) {
  std::mt19937 random_a(19);
  std::mt19937 random_b(19);
  const GaussianPose a = taught(Wheels{}, 500, &random_a).predict(Pose2(0.3, 0.1, -0.2));
  const GaussianPose b = taught(Wheels{}, 500, &random_b).predict(Pose2(0.3, 0.1, -0.2));
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.covariance, b.covariance);
}

TEST(ConstantVelocity, GoesOnAsTheRobotWent) {
  ConstantVelocity velocity(3.0, 6.0);
  for (int i = 0; i < 20; ++i) {
    velocity.learn(Pose2(0.1, 0.0, 0.02), 0.2);
  }
  const GaussianPose next = velocity.predict(0.4);
  EXPECT_NEAR(next.mean.x(), 0.2, 0.01);
  EXPECT_NEAR(next.mean.theta(), 0.04, 0.001);
  EXPECT_TRUE(is_positive_definite(next.covariance));
}

TEST(ConstantVelocity, IsSurerOfASteadyRobotThanOfAJumpyOne) {
  ConstantVelocity steady(3.0, 6.0);
  ConstantVelocity jumpy(3.0, 6.0);
  for (int i = 0; i < 100; ++i) {
    steady.learn(Pose2(0.1, 0.0, 0.0), 0.2);
    jumpy.learn(Pose2(i % 2 == 0 ? 0.3 : -0.3, 0.0, 0.0), 0.2);
  }
  EXPECT_GT(jumpy.predict(0.2).covariance(0, 0), 9.0 * steady.predict(0.2).covariance(0, 0));
}

TEST(ConstantVelocity, SurvivesStampsThatStepBackOrAhead) {
  ConstantVelocity velocity(3.0, 6.0);
  velocity.learn(Pose2(5.0, 0.0, 0.0), 1e-6);
  EXPECT_LE(velocity.predict(1e6).mean.x(), 3.0 + 1e-9);
  EXPECT_EQ(velocity.predict(-1.0).mean.x(), 0.0);
  EXPECT_TRUE(is_positive_definite(velocity.predict(0.0).covariance));
}

}  // namespace
}  // namespace cairn
