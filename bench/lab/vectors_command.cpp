#include <ostream>

#include "bench/lab/counts.hpp"
#include "bench/lab/text.hpp"
#include "bench/lab/topology_command.hpp"
#include "bench/lab/vectors_file.hpp"
#include "clients/common/progress.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

/// One exploration in one mode.
struct Comparison {
  SearchRun run;
  Json counted;
  std::vector<std::string> differences;
};

Comparison compared(const TestVector& vector,
                    const ViewNames& names,
                    SearchKind kind,
                    bool planar) {
  ExactSearchOptions options;
  options.planar = planar;
  options.max_places = vector.max_places;
  Comparison comparison;
  comparison.run = run_search(kind, vector.exploration, options, SearchOrder::kPaths);
  comparison.counted = to_json(comparison.run.counts, names);
  const Json& expected = planar ? vector.planar : vector.nonplanar;
  comparison.differences = differences(expected, comparison.counted);
  // The same fields as the file has.
  for (const char* optional : {"region_leaves_per_step", "minimal_region"}) {
    if (!expected.contains(optional)) {
      comparison.counted.erase(optional);
    }
  }
  return comparison;
}

/// Collects what is printed at the end.
class Outcome {
 public:
  void add(const TestVector& vector, bool planar, const Comparison& comparison) {
    const char* mode = planar ? "planar" : "nonplanar";
    ++total_;
    agreeing_ += comparison.differences.empty() ? 1 : 0;
    nodes_ += comparison.run.counts.tree_nodes;
    cpu_s_ += comparison.run.cpu_s;
    const MapCounts& counts = comparison.run.counts;
    table_.add({clients::printable(vector.name), mode, grouped(counts.tree_nodes),
                grouped(counts.maps_built), grouped(counts.final_maps),
                grouped(counts.closed_paper), grouped(counts.region_consistent_finals),
                counts.optimal ? grouped(counts.optimal->count) : "-",
                clients::fixed(1000.0 * comparison.run.cpu_s, 2),
                comparison.differences.empty() ? "agrees" : "DIFFERS"});
    for (const std::string& difference : comparison.differences) {
      complaints_.push_back(clients::printable(vector.name) + ", " + mode + ": " + difference);
    }
  }
  [[nodiscard]] bool agrees() const { return agreeing_ == total_; }

  void print(std::ostream& out) const {
    table_.print(out);
    for (const std::string& complaint : complaints_) {
      out << complaint << '\n';
    }
    out << agreeing_ << " of " << total_ << " agree; " << summary() << '\n';
  }
  [[nodiscard]] Json json(Json vectors) const {
    return {
        {"vectors", std::move(vectors)}, {"agreeing", agreeing_},          {"compared", total_},
        {"tree_nodes", nodes_},          {"cpu_ms", milliseconds(cpu_s_)}, {"agrees", agrees()}};
  }

 private:
  [[nodiscard]] std::string summary() const {
    SearchRun all;
    all.counts.tree_nodes = nodes_;
    all.cpu_s = cpu_s_;
    return cost_text(all);
  }

  clients::Table table_{{"exploration", "mode", "nodes", "maps", "final", "closed", "regions",
                         "optimal", "CPU ms", "counts"}};
  std::vector<std::string> complaints_;
  int total_ = 0;
  int agreeing_ = 0;
  std::int64_t nodes_ = 0;
  double cpu_s_ = 0.0;
};

}  // namespace

int explore_vectors(const TopologyRequest& request, std::ostream& out) {
  const VectorsFile file = read_vectors(request.vectors_file);
  Outcome outcome;
  Json vectors = Json::array();
  {
    clients::Progress progress("explorations");
    for (const TestVector& vector : file.vectors) {
      Json entry = {{"name", vector.name}};
      Json complaints = Json::object();
      for (const bool planar : {false, true}) {
        if (planar || !request.search.planar) {
          const char* mode = planar ? "planar" : "nonplanar";
          const Comparison comparison = compared(vector, file.names, request.kind, planar);
          entry[mode] = comparison.counted;
          entry["agrees"] = entry.value("agrees", true) && comparison.differences.empty();
          if (!comparison.differences.empty()) {
            complaints[mode] = comparison.differences;
          }
          outcome.add(vector, planar, comparison);
        }
      }
      if (!complaints.empty()) {
        entry["differences"] = complaints;
      }
      vectors.push_back(std::move(entry));
      progress.show(static_cast<std::int64_t>(vectors.size()),
                    static_cast<std::int64_t>(file.vectors.size()));
    }
  }
  if (request.as_json) {
    out << outcome.json(std::move(vectors)).dump(2) << '\n';
  } else {
    outcome.print(out);
  }
  return outcome.agrees() ? 0 : 1;
}

}  // namespace cairn::lab
