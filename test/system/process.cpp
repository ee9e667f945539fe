#include "process.hpp"

#include <csignal>
#include <ctime>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cairn::test {
namespace {

int next_number() {
  static int number = 0;
  return ++number;
}

int to_exit_status(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  const std::string number = std::to_string(next_number());
  output_ = folder / (number + ".out");
  errors_ = folder / (number + ".err");
  std::vector<std::string> copies = arguments;
  std::vector<char*> words;
  for (std::string& word : copies) {
    words.push_back(word.data());
  }
  words.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    const int out = open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err = open(errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    execv(words.front(), words.data());
    _exit(127);
  }
}

Process::~Process() {
  if (is_running()) {
    kill(pid_, SIGKILL);
    static_cast<void>(wait());
  }
}

void Process::send(int signal) const {
  kill(pid_, signal);
}

bool Process::is_running() {
  if (status_ >= 0) {
    return false;
  }
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) == pid_) {
    status_ = to_exit_status(status);
    return false;
  }
  return true;
}

Finished Process::wait(std::chrono::seconds patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (is_running()) {
    if (std::chrono::steady_clock::now() > until) {
      kill(pid_, SIGKILL);
    }
    timespec pause{0, 10'000'000};
    nanosleep(&pause, nullptr);
  }
  return {status_, output(), errors()};
}

Finished run(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  Process process(arguments, folder);
  return process.wait(std::chrono::seconds(250));
}

Hub::Hub(const TemporaryFolder& folder) : process_({CAIRN_HUB, "--port", "0"}, folder) {
  eventually([this] { return process_.output().find('\n') != std::string::npos; });
  url_ = process_.output().substr(0, process_.output().find('\n'));
}

}  // namespace cairn::test
