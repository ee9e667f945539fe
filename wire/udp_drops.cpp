#include "wire/udp_drops.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace cairn::wire {

namespace {

/// Inode numbers of the sockets this process holds, as text.
std::set<std::string> own_socket_inodes() {
  namespace fs = std::filesystem;
  static const std::string kPrefix = "socket:[";
  std::set<std::string> inodes;
  std::error_code error;
  for (fs::directory_iterator entry("/proc/self/fd", error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code vanished;  // The descriptor may have been closed meanwhile.
    const std::string target = fs::read_symlink(entry->path(), vanished).string();
    if (!vanished && target.starts_with(kPrefix) && target.ends_with(']')) {
      inodes.insert(target.substr(kPrefix.size(), target.size() - kPrefix.size() - 1));
    }
  }
  return inodes;
}

}  // namespace

std::optional<std::int64_t> own_udp_drops() {
  // Not /proc/net/udp: systemd's ProcSubset=pid hides that one.
  std::ifstream table("/proc/self/net/udp");
  std::string line;
  if (!std::getline(table, line)) {
    return std::nullopt;
  }
  constexpr std::size_t kInodeColumn = 9;
  constexpr std::size_t kNumColumns = 13;
  const std::set<std::string> own = own_socket_inodes();
  std::int64_t drops = 0;
  while (std::getline(table, line)) {
    std::istringstream words(line);
    std::vector<std::string> columns;
    for (std::string word; words >> word;) {
      columns.push_back(word);
    }
    if (columns.size() >= kNumColumns && own.contains(columns[kInodeColumn])) {
      std::int64_t of_socket = 0;
      std::istringstream(columns.back()) >> of_socket;
      drops += of_socket;
    }
  }
  return drops;
}

}  // namespace cairn::wire
