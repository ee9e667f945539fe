#pragma once

namespace cairn {

/// Lets one thread wake another out of poll().
class Wakeup {
 public:
  Wakeup();
  ~Wakeup();
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;
  Wakeup(Wakeup&&) = delete;
  Wakeup& operator=(Wakeup&&) = delete;

  /// To be polled for reading.
  [[nodiscard]] int fd() const { return fd_; }
  /// From any thread.
  void signal() const;
  /// Makes the descriptor silent again.
  void clear() const;

 private:
  int fd_ = -1;
};

}  // namespace cairn
