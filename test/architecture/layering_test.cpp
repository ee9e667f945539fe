// Holds the source tree against lib/LAYERS: every include of lib/ goes down the layers, third-party
// code stays where its line names it, and the folders beside lib/ know only whom they may know.

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace cairn {
namespace {

namespace fs = std::filesystem;

struct Layer {
  std::set<std::string> may_include;
  std::set<std::string> may_use;
};

fs::path source() {
  return CAIRN_SOURCE_DIR;
}

/// Third-party headers that a layer must be allowed by name, by the first word of their path.
const std::set<std::string> kGuarded = {
    "Eigen",   "ceres",    "nlohmann",   "spdlog", "sqlite3.h", "lcm", "thread",  "mutex",
    "fstream", "iostream", "filesystem", "zstd.h", "png.h",     "CLI", "systemd", "random_device"};

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

std::map<std::string, Layer> read_layers() {
  std::map<std::string, Layer> layers;
  std::ifstream file(source() / "lib/LAYERS");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') {
      continue;
    }
    const auto colon = line.find(':');
    const auto bar = line.find('|');
    Layer layer;
    for (const std::string& below : words_of(line.substr(colon + 1, bar - colon - 1))) {
      EXPECT_EQ(layers.count(below), 1U) << below << " is named before its own line";
      layer.may_include.insert(below);
    }
    const std::string name = words_of(line.substr(0, colon)).front();
    layer.may_include.insert(name);
    for (const std::string& third_party : words_of(line.substr(bar + 1))) {
      layer.may_use.insert(third_party);
    }
    layers[name] = layer;
  }
  return layers;
}

struct Include {
  std::string folder;  ///< First word of the path.
  bool is_ours = false;
  std::string line;
};

std::vector<Include> includes_of(const fs::path& path) {
  std::vector<Include> includes;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const auto open = line.find_first_of("<\"");
    if (line.rfind("#include", 0) != 0 || open == std::string::npos) {
      continue;
    }
    const bool is_ours = line[open] == '"';
    const auto end = line.find_first_of("/>\"", open + 1);
    includes.push_back({line.substr(open + 1, end - open - 1), is_ours, line});
  }
  return includes;
}

std::vector<fs::path> sources_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path extension = entry.path().extension();
    if (extension == ".hpp" || extension == ".cpp") {
      files.push_back(entry.path());
    }
  }
  return files;
}

TEST(Architecture, EveryIncludeOfLibGoesDownTheLayers) {
  const std::map<std::string, Layer> layers = read_layers();
  ASSERT_GE(layers.size(), 13U);
  for (const fs::path& path : sources_in(source() / "lib")) {
    const fs::path file = fs::relative(path, source() / "lib");
    const auto layer = layers.find(file.begin()->string());
    ASSERT_NE(layer, layers.end()) << file << " is in no layer";
    for (const Include& include : includes_of(path)) {
      const bool allowed = include.is_ours ? layer->second.may_include.count(include.folder) == 1
                                           : kGuarded.count(include.folder) == 0 ||
                                                 layer->second.may_use.count(include.folder) == 1;
      EXPECT_TRUE(allowed) << file << ": " << include.line;
    }
  }
}

TEST(Architecture, ClientsAndTheWireKnowNothingOfTheLibrary) {
  const std::map<std::string, Layer> layers = read_layers();
  for (const std::string folder : {"clients", "wire"}) {
    for (const fs::path& path : sources_in(source() / folder)) {
      for (const Include& include : includes_of(path)) {
        EXPECT_FALSE(include.is_ours && layers.count(include.folder) == 1)
            << path << ": " << include.line;
      }
    }
  }
}

TEST(Architecture, TheDaemonAndTheWireKnowNothingOfTheClients) {
  for (const std::string folder : {"daemon", "wire", "lib"}) {
    for (const fs::path& path : sources_in(source() / folder)) {
      for (const Include& include : includes_of(path)) {
        EXPECT_NE(include.folder, "clients") << path << ": " << include.line;
      }
    }
  }
}

TEST(Architecture, NoOneOwnsAMutexOutsideRuntimeAndTheBus) {
  for (const std::string folder : {"lib", "daemon", "wire"}) {
    for (const fs::path& path : sources_in(source() / folder)) {
      const std::string where = fs::relative(path, source()).string();
      if (where.rfind("daemon/runtime/", 0) == 0 || where.rfind("wire/bus.", 0) == 0) {
        continue;
      }
      for (const Include& include : includes_of(path)) {
        EXPECT_NE(include.folder, "mutex") << where << ": " << include.line;
      }
    }
  }
}

}  // namespace
}  // namespace cairn
