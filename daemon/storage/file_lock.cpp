#include "storage/file_lock.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace cairn {

void FileLock::Closer::operator()(const int* descriptor) const {
  close(*descriptor);
  delete descriptor;  // NOLINT(cppcoreguidelines-owning-memory): this is its owner.
}

Result<FileLock> FileLock::hold(const std::string& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    return Error{ErrorCode::kUnavailable, std::string("cannot be written: ") + strerror(errno)};
  }
  FileLock lock;
  lock.descriptor_.reset(new int(descriptor));
  // SQLite's own locks are of another kind (fcntl) and do not meet this one.
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    return Error{ErrorCode::kUnavailable,
                 "another cairnd holds this map file; stop it, or choose another --map"};
  }
  return lock;
}

}  // namespace cairn
