#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <vector>

namespace cairn {

/// How long it takes to take in a scan, over the last few hundred.
class Latency {
 public:
  void add(double ms) {
    recent_.push_back(static_cast<float>(ms));
    if (recent_.size() > 400) {
      recent_.pop_front();
    }
  }
  [[nodiscard]] float median_ms() const {
    std::vector<float> sorted(recent_.begin(), recent_.end());
    if (sorted.empty()) {
      return 0.0F;
    }
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }
  [[nodiscard]] float max_ms() const {
    return recent_.empty() ? 0.0F : *std::max_element(recent_.begin(), recent_.end());
  }

 private:
  std::deque<float> recent_;
};

}  // namespace cairn
