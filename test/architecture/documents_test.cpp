// What the documentation and the messages promise about the tree, held against it.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "support/files.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = CAIRN_SOURCE_DIR;

/// The endings that say the unit of a floating-point field, or that it has none.
const std::vector<std::string> kUnits = {
    "_m",          "_rad",      "_s",      "_ms",  "_mb",  "_share",     "_m2_rad2", "_m_rad",
    "probability", "posterior", "_sigmas", "_p50", "_max", "likelihood", "log_odds"};

bool says_its_unit(const std::string& field) {
  return std::any_of(kUnits.begin(), kUnits.end(), [&field](const std::string& unit) {
    return field.size() >= unit.size() &&
           field.compare(field.size() - unit.size(), unit.size(), unit) == 0;
  });
}

TEST(Messages, EveryFloatingFieldSaysItsUnit) {
  int checked = 0;
  for (const std::string package : {"cairn_lcm", "cairn_journal"}) {
    for (const fs::directory_entry& entry :
         fs::directory_iterator(kSource / "lcmtypes" / package)) {
      std::istringstream text(test::content_of(entry.path()));
      for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string type;
        std::string field;
        words >> type >> field;
        if (type != "double" && type != "float") {
          continue;
        }
        field = field.substr(0, field.find_first_of("[;"));
        EXPECT_TRUE(says_its_unit(field)) << entry.path().filename() << ": " << line;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 40);
}

TEST(Messages, UtimeComesFirstInEveryMessageOnTheBus) {
  for (const std::string name :
       {"laser_scan_t", "odometry_t", "sonar_ring_t", "status_t", "pose_t", "place_event_t",
        "frame_change_t", "topology_t", "hypotheses_t", "hypothesis_map_t", "map_delta_t",
        "snapshot_chunk_t", "rpc_header_t"}) {
    const std::string text = test::content_of(kSource / "lcmtypes/cairn_lcm" / (name + ".lcm"));
    const auto first = text.find("int64_t utime;");
    ASSERT_NE(first, std::string::npos) << name;
    const auto body = text.find('{');
    const std::string before = text.substr(body, first - body);
    EXPECT_EQ(before.find("double"), std::string::npos) << name;
    EXPECT_EQ(before.find("int64_t"), std::string::npos) << name;
  }
}

/// Words in backticks that look like a path of this tree.
std::set<std::string> named_paths(const std::string& text) {
  std::set<std::string> paths;
  std::size_t open = text.find('`');
  while (open != std::string::npos) {
    const std::size_t close = text.find('`', open + 1);
    if (close == std::string::npos) {
      break;
    }
    const std::string word = text.substr(open + 1, close - open - 1);
    for (const std::string folder : {"lib/", "test/", "daemon/", "wire/", "clients/"}) {
      if (word.rfind(folder, 0) == 0 && word.find(' ') == std::string::npos) {
        paths.insert(word);
      }
    }
    open = text.find('`', close + 1);
  }
  return paths;
}

TEST(Documentation, ThePaperMapNamesFilesThatExist) {
  const std::set<std::string> paths = named_paths(test::content_of(kSource / "docs/paper-map.md"));
  EXPECT_GT(paths.size(), 20U);
  for (const std::string& path : paths) {
    EXPECT_TRUE(fs::exists(kSource / path)) << path;
  }
}

}  // namespace
}  // namespace cairn
