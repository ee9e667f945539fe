#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "service/mapping_service.hpp"

namespace cairn {

/// Adds up how long each stage of the pipeline takes.
class StageClock {
 public:
  static constexpr std::size_t kStages = static_cast<std::size_t>(Stage::kIdle);

  void enter(Stage stage) {
    const auto now = std::chrono::steady_clock::now();
    if (stage_ != Stage::kIdle) {
      spent_[static_cast<std::size_t>(stage_)] += now - since_;
    }
    stage_ = stage;
    since_ = now;
  }

  [[nodiscard]] double seconds(Stage stage) const {
    return std::chrono::duration<double>(spent_[static_cast<std::size_t>(stage)]).count();
  }

 private:
  std::array<std::chrono::steady_clock::duration, kStages> spent_{};
  Stage stage_ = Stage::kIdle;
  std::chrono::steady_clock::time_point since_;
};

}  // namespace cairn
