#pragma once

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "lpm/linear_error.hpp"

namespace cairn {

/// Variances of what odometry says, as rates: the error of a long step is that of its parts
/// together.
///
/// Source: the velocity model of Thrun, Burgard and Fox, "Probabilistic Robotics", Sec. 5.3, with
/// variances that grow with travel instead of its square: what grows with the square is systematic,
/// and has its place in OdometryCalibration.
struct OdometryNoise {
  double drive_m2_per_m = 0.02;      ///< Ahead, by driving.
  double slide_m2_per_m = 0.02;      ///< Sideways, by driving.
  double turn_rad2_per_rad = 0.02;   ///< By turning.
  double turn_rad2_per_m = 0.01;     ///< By driving.
  double rest_m2_per_step = 1e-3;    ///< Each of ahead and sideways, even at rest.
  double rest_rad2_per_step = 1e-4;  ///< Even at rest.
};

/// What odometry gets wrong always in the same way.
struct OdometryCalibration {
  double drive_scale = 1.0;      ///< True metres per metre of odometry.
  double turn_scale = 1.0;       ///< True radians per radian of odometry.
  double turn_rad_per_m = 0.0;   ///< Turn per metre driven: wheels that are not alike.
  double slide_m_per_m = 0.0;    ///< To the left per metre driven: a laser mounted askew.
  double slide_m_per_rad = 0.0;  ///< To the left per radian turned: so far ahead of where its
                                 ///< mounting pose says is the laser, or the axle behind.
  double drive_m_per_rad = 0.0;  ///< Ahead per radian turned: the laser is so far to the right.
};

/// How the motion model learns. In the configuration file: the object "lpm.motion.learning".
struct MotionLearningOptions {
  OdometryNoise first;           ///< Believed before anything is learned. All > 0.
  double least_share = 1e-3;     ///< Floor of each noise, as a share of the first. (0, 1]
  double greatest_share = 16.0;  ///< Ceiling of each noise, as a share of the first. [1, 1e4]
  double lesson_m = 0.20;        ///< Travel after which odometry and matches are compared, > 0
  double lesson_rad = 0.20;      ///< or turn, > 0
  int lesson_steps = 20;         ///< or steps. [1, 1000]
  double noise_memory_lessons = 40.0;         ///< What is older has faded. [2, 1e5]
  double calibration_memory_lessons = 300.0;  ///< What is older has faded. [2, 1e6]
  double drive_scale_sigma = 0.05;            ///< Of 1, beforehand. [1e-4, 1]
  double turn_scale_sigma = 0.10;             ///< Of 1, beforehand. [1e-4, 1]
  double turn_sigma_rad_per_m = 0.05;         ///< Of 0, beforehand. [1e-4, 1]
  double slide_sigma_m_per_m = 0.02;          ///< Of 0, beforehand. [1e-4, 1]
  double lever_sigma_m = 0.05;  ///< Of both levers of a turn, of 0, beforehand. [1e-4, 1]
  double bound_sigmas = 5.0;    ///< Calibration never leaves this many of its sigmas. [1, 10]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const MotionLearningOptions& options);

/// Odometry made honest: removes what this robot's odometry gets wrong always, and says how far the
/// rest is to be believed, both learned from what scan matching corrects.
///
/// Calibration: recursive least squares with exponential forgetting. Noise: each variance climbs or
/// falls by its share in the error of a lesson, by a bounded step that is as large upwards as
/// downwards (the score of Cauchy's scale), so that one slip is one small step whatever its size.
/// A direction which the match knows less well than odometry teaches nothing, since there the match
/// has but repeated the prediction.
///
/// Same lessons, same model, bit for bit. Memory is constant.
class MotionModel {
 public:
  /// @pre validate(options).ok()
  explicit MotionModel(const MotionLearningOptions& options = {});

  /// The motion to expect, of the robot in the frame of the robot before it, where odometry says
  /// `odometry_step` of it. The covariance is positive definite.
  /// @pre finite
  [[nodiscard]] GaussianPose predict(const Pose2& odometry_step) const;

  /// Takes in what a scan match made of a step.
  /// @param matched_step the same motion by scan matching, with the covariance of the returns alone
  ///        (no prediction in it) of the match at its end, in the frame of the robot before it
  void learn(const Pose2& odometry_step, const GaussianPose& matched_step);
  /// A step that teaches nothing: not matched, or odometry was at fault in a way that is known.
  /// What was gathered for the lesson under way is dropped.
  void skip();

  [[nodiscard]] const OdometryNoise& noise() const { return noise_; }
  [[nodiscard]] OdometryCalibration calibration() const;
  [[nodiscard]] int lessons() const { return lessons_; }

 private:
  /// A step in the direction of its mean heading.
  struct Step {
    double drive_m = 0.0;
    double slide_m = 0.0;
    double turn_rad = 0.0;
  };
  /// Variances of the three for a motion of some length.
  struct Variances {
    double drive_m2 = 0.0;
    double slide_m2 = 0.0;
    double turn_rad2 = 0.0;
  };
  /// What was gathered since the last lesson.
  struct Lesson {
    Pose2 odometry;
    Pose2 matched;
    double drive_m = 0.0;   // by odometry, summed up without sign
    double turn_rad = 0.0;  // by odometry, summed up without sign
    Variances match;        // summed up
    int steps = 0;
  };

  [[nodiscard]] static Step step_of(const Pose2& motion);
  [[nodiscard]] Step corrected(const Step& odometry) const;
  [[nodiscard]] Variances random_variances(double drive_m, double turn_rad, int steps) const;
  [[nodiscard]] Variances calibration_variances(const Step& odometry) const;
  void take_lesson();
  void learn_calibration(const Step& odometry, const Step& error, const Variances& variances);
  void learn_noise(const Step& error, const Variances& expected, const Variances& match);
  [[nodiscard]] double climbed(double value, double first, double change) const;

  MotionLearningOptions options_;
  OdometryNoise noise_;
  LinearError drive_;  // by drive and turn
  LinearError slide_;  // by drive and turn
  LinearError turn_;   // by turn and drive
  Lesson lesson_;
  int lessons_ = 0;
};

}  // namespace cairn
