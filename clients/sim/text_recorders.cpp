#include <cinttypes>

#include "clients/sim/recorders.hpp"

namespace cairn::sim {
namespace {

constexpr std::chrono::milliseconds kProgressEvery{250};
constexpr std::int64_t kSecond_us = 1'000'000;

}  // namespace

TruthRecorder::File TruthRecorder::open(const std::string& file) {
  File opened(std::fopen(file.c_str(), "wb"));
  if (!opened) {
    throw CannotWrite(file + ": cannot be written");
  }
  return opened;
}

TruthRecorder::TruthRecorder(const std::string& prefix, std::int64_t start_utime)
    : prefix_(prefix),
      start_utime_(start_utime),
      poses_(open(prefix + ".truth.txt")),
      passages_(open(prefix + ".junctions.txt")) {
  std::fputs("# t_s x_m y_m theta_rad\n", poses_.get());
  std::fputs("# t_s name x_m y_m\n", passages_.get());
}

void TruthRecorder::record_sweep(std::int64_t time_us, const Sweep& sweep) {
  const std::int64_t utime = start_utime_ + time_us;
  const Pose& pose = sweep.T_world_robot;
  std::fprintf(poses_.get(), "%" PRId64 ".%06" PRId64 " %.6f %.6f %.6f\n", utime / kSecond_us,
               utime % kSecond_us, pose.at.x_m, pose.at.y_m, pose.theta_rad);
}

void TruthRecorder::record_passage(const Passage& passage) {
  const std::int64_t utime = start_utime_ + passage.time_us;
  std::fprintf(passages_.get(), "%" PRId64 ".%06" PRId64 " %s %.3f %.3f\n", utime / kSecond_us,
               utime % kSecond_us, passage.junction.name.c_str(), passage.junction.at.x_m,
               passage.junction.at.y_m);
}

void TruthRecorder::close() {
  for (File* const file : {&poses_, &passages_}) {
    const bool has_failed = std::ferror(file->get()) != 0;
    if (std::fclose(file->release()) != 0 || has_failed) {
      throw CannotWrite(prefix_ + ".truth.txt, .junctions.txt: cannot be written");
    }
  }
}

void ProgressRecorder::record_odometry(std::int64_t time_us, const Pose& /*T_odom_robot*/) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) {
    return;
  }
  next_ = now + kProgressEvery;
  std::fprintf(stderr, "\r%3d %%  %" PRId64 " of %" PRId64 " s\x1b[K",
               static_cast<int>(100 * time_us / duration_us_), time_us / kSecond_us,
               duration_us_ / kSecond_us);
}

void ProgressRecorder::close() const {
  std::fputs("\r\x1b[K", stderr);
}

void RecorderGroup::record_odometry(std::int64_t time_us, const Pose& T_odom_robot) {
  for (Recorder* const recorder : recorders_) {
    recorder->record_odometry(time_us, T_odom_robot);
  }
}

void RecorderGroup::record_sweep(std::int64_t time_us, const Sweep& sweep) {
  for (Recorder* const recorder : recorders_) {
    recorder->record_sweep(time_us, sweep);
  }
}

void RecorderGroup::record_passage(const Passage& passage) {
  for (Recorder* const recorder : recorders_) {
    recorder->record_passage(passage);
  }
}

}  // namespace cairn::sim
