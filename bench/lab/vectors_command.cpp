#include <ostream>
#include <set>
#include <utility>

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
  Differences differences;
};

/// What remains of a file's counts when maps that are not region-consistent are pruned early: they
/// never heal, so their leaves are those that a filter leaves.
Json under_region_axiom(const Json& expected) {
  Json remaining = Json::object();
  for (const char* field : {"region_consistent_finals", "optimal", "minimal_region"}) {
    if (expected.contains(field)) {
      remaining[field] = expected[field];
    }
  }
  remaining["final_maps"] = expected["region_consistent_finals"];
  if (expected.contains("region_leaves_per_step")) {
    remaining["leaves_per_step"] = expected["region_leaves_per_step"];
    remaining["region_leaves_per_step"] = expected["region_leaves_per_step"];
  }
  return remaining;
}

Comparison compared(const TestVector& vector,
                    const ViewNames& names,
                    const TopologyRequest& request,
                    bool planar) {
  ExactSearchOptions options;
  options.planar = planar;
  options.region_consistent = request.search.region_consistent;
  options.max_places = vector.max_places;
  Comparison comparison;
  comparison.run = run_search(request.kind, vector.exploration, options, SearchOrder::kPaths);
  comparison.counted = to_json(comparison.run.counts, names);
  const Json& expected = planar ? vector.planar : vector.nonplanar;
  const Json comparable = options.region_consistent ? under_region_axiom(expected) : expected;
  comparison.differences = differences(comparable, comparison.counted);
  for (const auto& [field, value] : expected.items()) {
    if (!comparable.contains(field)) {
      comparison.differences.not_counted.insert(field);
    }
  }
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
  explicit Outcome(bool has_region_axiom) : has_region_axiom_(has_region_axiom) {}

  void add(const TestVector& vector, bool planar, const Comparison& comparison) {
    const char* mode = planar ? "planar" : "nonplanar";
    const MapCounts& counts = comparison.run.counts;
    const Differences& differences = comparison.differences;
    ++total_;
    agreeing_ += differences.found.empty() ? 1 : 0;
    compared_.insert(differences.compared.begin(), differences.compared.end());
    not_compared_.insert(differences.not_counted.begin(), differences.not_counted.end());
    all_.counts.tree_nodes += counts.tree_nodes;
    all_.cpu_s += comparison.run.cpu_s;
    all_.stored += comparison.run.stored;
    if (comparison.run.counting_cpu_s) {
      all_.counting_cpu_s = all_.counting_cpu_s.value_or(0.0) + *comparison.run.counting_cpu_s;
    }
    table_.add({clients::printable(vector.name), mode, grouped(counts.tree_nodes),
                grouped(counts.maps_built), grouped(counts.final_maps),
                grouped(counts.closed_paper), grouped(counts.region_consistent_finals),
                counts.optimal ? grouped(counts.optimal->count) : "-",
                clients::fixed(1000.0 * comparison.run.cpu_s, 2),
                differences.found.empty() ? "agrees" : "DIFFERS"});
    for (const std::string& difference : differences.found) {
      complaints_.push_back(clients::printable(vector.name) + ", " + mode + ": " + difference);
    }
  }
  [[nodiscard]] bool agrees() const { return agreeing_ == total_; }

  void print(std::ostream& out) const {
    table_.print(out);
    for (const std::string& complaint : complaints_) {
      out << complaint << '\n';
    }
    out << "compared: " << listed(compared_) << '\n';
    if (!not_compared_.empty()) {
      out << "in the file, but not compared" << why_not_compared() << ": " << listed(not_compared_)
          << '\n';
    }
    out << agreeing_ << " of " << total_ << " agree; " << cost_text(all_) << '\n';
  }
  [[nodiscard]] Json json(Json vectors) const {
    Json json = {{"vectors", std::move(vectors)},
                 {"agreeing", agreeing_},
                 {"compared", total_},
                 {"fields_compared", compared_},
                 {"fields_not_compared", not_compared_},
                 {"tree_nodes", all_.counts.tree_nodes},
                 {"agrees", agrees()}};
    json.update(cost_json(all_));
    return json;
  }

 private:
  static std::string listed(const std::set<std::string>& fields) {
    std::string list;
    for (const std::string& field : fields) {
      list += (list.empty() ? "" : ", ") + clients::printable(field);
    }
    return list;
  }
  [[nodiscard]] std::string why_not_compared() const {
    return has_region_axiom_ ? " (--region-axiom: the file counts them without the axiom)"
                             : " (not counted here)";
  }

  bool has_region_axiom_;
  std::set<std::string> compared_;
  std::set<std::string> not_compared_;
  clients::Table table_{{"exploration", "mode", "nodes", "maps", "final", "closed", "regions",
                         "optimal", "CPU ms", "counts"}};
  std::vector<std::string> complaints_;
  int total_ = 0;
  int agreeing_ = 0;
  SearchRun all_;  ///< Summed.
};

}  // namespace

int explore_vectors(const TopologyRequest& request, std::ostream& out) {
  const VectorsFile file = read_vectors(request.vectors_file);
  Outcome outcome(request.search.region_consistent);
  Json vectors = Json::array();
  {
    clients::Progress progress("explorations");
    for (const TestVector& vector : file.vectors) {
      // The mode asked for stands beside the name, too.
      Json entry = {{"name", vector.name},
                    {"mode", request.search.planar ? "planar" : "nonplanar"}};
      Json complaints = Json::object();
      for (const bool planar : {false, true}) {
        if (planar || !request.search.planar) {
          const char* mode = planar ? "planar" : "nonplanar";
          const Comparison comparison = compared(vector, file.names, request, planar);
          entry[mode] = comparison.counted;
          if (planar == request.search.planar) {
            entry.update(comparison.counted);
          }
          entry["agrees"] = entry.value("agrees", true) && comparison.differences.found.empty();
          if (!comparison.differences.found.empty()) {
            complaints[mode] = comparison.differences.found;
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
