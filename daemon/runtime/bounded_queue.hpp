#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace cairn {

/// A first-in, first-out queue between two threads that never grows past its capacity: when it is
/// full the oldest element makes room, and is counted.
template <typename T>
class BoundedQueue {
 public:
  /// @param capacity > 0
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

  /// Never waits. After close() the element is ignored.
  void push(T element) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (is_closed_) {
        return;
      }
      if (elements_.size() == capacity_) {
        elements_.pop_front();
        ++dropped_;
      }
      elements_.push_back(std::move(element));
    }
    changed_.notify_one();
  }

  /// Waits for an element. Empty once the queue is closed and drained.
  std::optional<T> pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return is_closed_ || !elements_.empty(); });
    return take_front();
  }

  /// As pop(), but waits no longer than this; see is_over().
  std::optional<T> pop_within(std::chrono::duration<double> patience) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, patience, [this] { return is_closed_ || !elements_.empty(); });
    return take_front();
  }

  /// Takes an element if there is one.
  std::optional<T> try_pop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return take_front();
  }

  /// No more elements come; what waits can still be taken.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_closed_ = true;
    }
    changed_.notify_all();
  }

  /// Closed, and drained.
  [[nodiscard]] bool is_over() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_closed_ && elements_.empty();
  }
  [[nodiscard]] std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return elements_.size();
  }
  [[nodiscard]] std::int64_t dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  std::optional<T> take_front() {
    if (elements_.empty()) {
      return std::nullopt;
    }
    std::optional<T> element(std::move(elements_.front()));
    elements_.pop_front();
    return element;
  }

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> elements_;
  std::int64_t dropped_ = 0;
  bool is_closed_ = false;
};

}  // namespace cairn
