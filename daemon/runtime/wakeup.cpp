#include "runtime/wakeup.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include "base/check.hpp"

namespace cairn {

Wakeup::Wakeup() : fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  CAIRN_CHECK(fd_ >= 0);
}

Wakeup::~Wakeup() {
  close(fd_);
}

// A full counter or an empty one are no errors here: the descriptor already says what it should.
void Wakeup::signal() const {
  static_cast<void>(eventfd_write(fd_, 1));
}

void Wakeup::clear() const {
  eventfd_t count = 0;
  static_cast<void>(eventfd_read(fd_, &count));
}

}  // namespace cairn
