#include "runtime/stop_signal.hpp"

#include <csignal>

#include <sys/signalfd.h>
#include <unistd.h>

#include "base/check.hpp"

namespace cairn {

StopSignal::StopSignal() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGHUP);
  CAIRN_CHECK(pthread_sigmask(SIG_BLOCK, &signals, nullptr) == 0);
  fd_ = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
  CAIRN_CHECK(fd_ >= 0);
}

StopSignal::~StopSignal() {
  close(fd_);
}

bool StopSignal::was_raised() {
  bool stop = false;
  signalfd_siginfo info{};
  while (read(fd_, &info, sizeof info) == static_cast<ssize_t>(sizeof info)) {
    stop = stop || info.ssi_signo != SIGHUP;
  }
  return stop;
}

}  // namespace cairn
