#include "lpm/motion_model.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "lpm/robust_scale.hpp"

namespace cairn {
namespace {

constexpr double kFirstGain = 0.5;  // of noise: fast at first
constexpr double kLeastVariance = 1e-12;
constexpr double kVagueMatch = 4.0;  // ratio of variances

double squared(double value) {
  return value * value;
}

Matrix3d turned(const Matrix3d& covariance, double angle_rad) {
  Matrix3d turn = Matrix3d::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(angle_rad);
  turn(1, 0) = std::sin(angle_rad);
  turn(0, 1) = -turn(1, 0);
  const Matrix3d seen = turn * covariance * turn.transpose();
  return 0.5 * (seen + seen.transpose());
}

}  // namespace

Status validate(const MotionLearningOptions& options) {
  const OdometryNoise& first = options.first;
  return Validator("lpm.motion.learning")
      .within("first.drive_m2_per_m", first.drive_m2_per_m, 1e-9, 10.0)
      .within("first.slide_m2_per_m", first.slide_m2_per_m, 1e-9, 10.0)
      .within("first.turn_rad2_per_rad", first.turn_rad2_per_rad, 1e-9, 10.0)
      .within("first.turn_rad2_per_m", first.turn_rad2_per_m, 1e-9, 10.0)
      .within("first.rest_m2_per_step", first.rest_m2_per_step, 1e-9, 10.0)
      .within("first.rest_rad2_per_step", first.rest_rad2_per_step, 1e-9, 10.0)
      .within("least_share", options.least_share, 1e-6, 1.0)
      .within("greatest_share", options.greatest_share, 1.0, 1e4)
      .positive("lesson_m", options.lesson_m)
      .positive("lesson_rad", options.lesson_rad)
      .within("lesson_steps", options.lesson_steps, 1, 1000)
      .within("noise_memory_lessons", options.noise_memory_lessons, 2.0, 1e5)
      .within("calibration_memory_lessons", options.calibration_memory_lessons, 2.0, 1e6)
      .within("drive_scale_sigma", options.drive_scale_sigma, 1e-4, 1.0)
      .within("turn_scale_sigma", options.turn_scale_sigma, 1e-4, 1.0)
      .within("turn_sigma_rad_per_m", options.turn_sigma_rad_per_m, 1e-4, 1.0)
      .within("slide_sigma_m_per_m", options.slide_sigma_m_per_m, 1e-4, 1.0)
      .within("lever_sigma_m", options.lever_sigma_m, 1e-4, 1.0)
      .within("bound_sigmas", options.bound_sigmas, 1.0, 10.0)
      .status();
}

MotionModel::MotionModel(const MotionLearningOptions& options)
    : options_(options),
      noise_(options.first),
      drive_({options.drive_scale_sigma, options.lever_sigma_m},
             options.bound_sigmas,
             options.calibration_memory_lessons),
      slide_({options.slide_sigma_m_per_m, options.lever_sigma_m},
             options.bound_sigmas,
             options.calibration_memory_lessons),
      turn_({options.turn_scale_sigma, options.turn_sigma_rad_per_m},
            options.bound_sigmas,
            options.calibration_memory_lessons) {
  CAIRN_CHECK(validate(options).ok());
}

OdometryCalibration MotionModel::calibration() const {
  OdometryCalibration calibration;
  calibration.drive_scale += drive_.shares()(0);
  calibration.drive_m_per_rad = drive_.shares()(1);
  calibration.slide_m_per_m = slide_.shares()(0);
  calibration.slide_m_per_rad = slide_.shares()(1);
  calibration.turn_scale += turn_.shares()(0);
  calibration.turn_rad_per_m = turn_.shares()(1);
  return calibration;
}

MotionModel::Step MotionModel::step_of(const Pose2& motion) {
  const Vector2d along = Pose2(0.0, 0.0, -0.5 * motion.theta()) * motion.translation();
  return {along.x(), along.y(), motion.theta()};
}

MotionModel::Step MotionModel::corrected(const Step& odometry) const {
  const Vector2d drive_first(odometry.drive_m, odometry.turn_rad);
  const Vector2d turn_first(odometry.turn_rad, odometry.drive_m);
  return {odometry.drive_m + drive_.shares().dot(drive_first),
          odometry.slide_m + slide_.shares().dot(drive_first),
          odometry.turn_rad + turn_.shares().dot(turn_first)};
}

MotionModel::Variances MotionModel::random_variances(double drive_m,
                                                     double turn_rad,
                                                     int steps) const {
  const double rest_m2 = steps * noise_.rest_m2_per_step;
  return {rest_m2 + noise_.drive_m2_per_m * drive_m, rest_m2 + noise_.slide_m2_per_m * drive_m,
          steps * noise_.rest_rad2_per_step + noise_.turn_rad2_per_rad * turn_rad +
              noise_.turn_rad2_per_m * drive_m};
}

MotionModel::Variances MotionModel::calibration_variances(const Step& odometry) const {
  const Vector2d drive_first(odometry.drive_m, odometry.turn_rad);
  const Vector2d turn_first(odometry.turn_rad, odometry.drive_m);
  return {drive_.variance(drive_first), slide_.variance(drive_first), turn_.variance(turn_first)};
}

GaussianPose MotionModel::predict(const Pose2& odometry_step) const {
  const Step odometry = step_of(odometry_step);
  const Step expected = corrected(odometry);
  const double drive_m = std::hypot(odometry.drive_m, odometry.slide_m);
  const Variances random = random_variances(drive_m, std::abs(odometry.turn_rad), 1);
  const Variances lasting = calibration_variances(odometry);
  Matrix3d along = Matrix3d::Zero();
  along.diagonal() << random.drive_m2 + lasting.drive_m2, random.slide_m2 + lasting.slide_m2,
      random.turn_rad2 + lasting.turn_rad2;
  // An error of the turn happens on the way: half of it bends the way.
  Matrix3d bend = Matrix3d::Identity();
  bend(0, 2) = -0.5 * expected.slide_m;
  bend(1, 2) = 0.5 * expected.drive_m;
  const Pose2 half(0.0, 0.0, 0.5 * expected.turn_rad);
  return {Pose2(half * Vector2d(expected.drive_m, expected.slide_m), expected.turn_rad),
          turned(bend * along * bend.transpose(), half.theta())};
}

void MotionModel::skip() {
  lesson_ = {};
}

void MotionModel::learn(const Pose2& odometry_step, const GaussianPose& matched_step) {
  const Step odometry = step_of(odometry_step);
  lesson_.odometry = lesson_.odometry * odometry_step;
  lesson_.matched = lesson_.matched * matched_step.mean;
  lesson_.drive_m += std::hypot(odometry.drive_m, odometry.slide_m);
  lesson_.turn_rad += std::abs(odometry.turn_rad);
  const Matrix3d match = turned(matched_step.covariance, -0.5 * odometry_step.theta());
  lesson_.match.drive_m2 += match(0, 0);
  lesson_.match.slide_m2 += match(1, 1);
  lesson_.match.turn_rad2 += match(2, 2);
  ++lesson_.steps;
  if (lesson_.drive_m >= options_.lesson_m || lesson_.turn_rad >= options_.lesson_rad ||
      lesson_.steps >= options_.lesson_steps) {
    take_lesson();
    lesson_ = {};
  }
}

void MotionModel::take_lesson() {
  const Step odometry = step_of(lesson_.odometry);
  const Step expected = corrected(odometry);
  const Step matched = step_of(lesson_.matched);
  const Step error{matched.drive_m - expected.drive_m, matched.slide_m - expected.slide_m,
                   wrap_angle(matched.turn_rad - expected.turn_rad)};
  const Variances random = random_variances(lesson_.drive_m, lesson_.turn_rad, lesson_.steps);
  // The motion hangs between two matches, each as good as those of the lesson on average.
  const double ends = 2.0 / lesson_.steps;
  const Variances match{ends * lesson_.match.drive_m2, ends * lesson_.match.slide_m2,
                        ends * lesson_.match.turn_rad2};
  // Half of a random turn bends the way, about a third of its square remains as slide.
  const double bend_m2 = random.turn_rad2 * squared(odometry.drive_m) / 12.0;
  const Variances expected_variances{std::max(random.drive_m2, kLeastVariance),
                                     std::max(random.slide_m2 + bend_m2, kLeastVariance),
                                     std::max(random.turn_rad2, kLeastVariance)};
  ++lessons_;
  learn_noise(error, expected_variances, match);
  learn_calibration(
      odometry, error,
      {expected_variances.drive_m2 + match.drive_m2, expected_variances.slide_m2 + match.slide_m2,
       expected_variances.turn_rad2 + match.turn_rad2});
}

void MotionModel::learn_calibration(const Step& odometry,
                                    const Step& error,
                                    const Variances& variances) {
  const Vector2d drive_first(odometry.drive_m, odometry.turn_rad);
  const Vector2d turn_first(odometry.turn_rad, odometry.drive_m);
  drive_.learn(drive_first, error.drive_m, variances.drive_m2);
  slide_.learn(drive_first, error.slide_m, variances.slide_m2);
  turn_.learn(turn_first, error.turn_rad, variances.turn_rad2);
}

double MotionModel::climbed(double value, double first, double change) const {
  return std::clamp(value * std::exp(change), options_.least_share * first,
                    options_.greatest_share * first);
}

void MotionModel::learn_noise(const Step& error,
                              const Variances& expected,
                              const Variances& match) {
  const double gain =
      std::max(1.0 / options_.noise_memory_lessons, kFirstGain / (1.0 + 0.1 * lessons_));
  // How much of a step each variance takes: its share in the variance of the error. That of the
  // match has its share, too, so that a vague match teaches little. A match much vaguer than
  // odometry has but repeated the prediction: no reason to believe odometry more.
  const auto change = [gain](double miss, double random, double of_match) {
    const double variance = random + of_match;
    const double score = scale_score(miss, variance);
    const bool is_vague = of_match > kVagueMatch * random;
    return gain * (is_vague ? std::max(score, 0.0) : score) / variance;
  };
  const OdometryNoise& first = options_.first;
  const double drive = change(error.drive_m, expected.drive_m2, match.drive_m2);
  const double slide = change(error.slide_m, expected.slide_m2, match.slide_m2);
  const double turn = change(error.turn_rad, expected.turn_rad2, match.turn_rad2);
  const double rest_m2 = lesson_.steps * noise_.rest_m2_per_step;
  const double rest_rad2 = lesson_.steps * noise_.rest_rad2_per_step;
  const double drive_m2 = noise_.drive_m2_per_m * lesson_.drive_m;
  const double slide_m2 = noise_.slide_m2_per_m * lesson_.drive_m;
  const double turn_rad2 = noise_.turn_rad2_per_rad * lesson_.turn_rad;
  const double bend_rad2 = noise_.turn_rad2_per_m * lesson_.drive_m;
  noise_.drive_m2_per_m = climbed(noise_.drive_m2_per_m, first.drive_m2_per_m, drive * drive_m2);
  noise_.slide_m2_per_m = climbed(noise_.slide_m2_per_m, first.slide_m2_per_m, slide * slide_m2);
  noise_.rest_m2_per_step =
      climbed(noise_.rest_m2_per_step, first.rest_m2_per_step, 0.5 * (drive + slide) * rest_m2);
  noise_.turn_rad2_per_rad =
      climbed(noise_.turn_rad2_per_rad, first.turn_rad2_per_rad, turn * turn_rad2);
  noise_.turn_rad2_per_m = climbed(noise_.turn_rad2_per_m, first.turn_rad2_per_m, turn * bend_rad2);
  noise_.rest_rad2_per_step =
      climbed(noise_.rest_rad2_per_step, first.rest_rad2_per_step, turn * rest_rad2);
}

}  // namespace cairn
