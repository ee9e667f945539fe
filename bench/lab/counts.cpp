#include "bench/lab/counts.hpp"

#include <algorithm>
#include <utility>

#include "bench/lab/codes.hpp"
#include "bench/lab/text.hpp"

namespace cairn::lab {
namespace {

/// Sorted anew, as their new names sort.
Json codes_json(const std::vector<std::string>& codes, const ViewNames& names) {
  std::vector<std::string> renamed;
  for (const std::string& code : codes) {
    renamed.push_back(renamed_code(code, names));
  }
  std::sort(renamed.begin(), renamed.end());
  return renamed;
}

Json optimal_json(const std::optional<SimplestMaps>& optimal, const ViewNames& names) {
  if (!optimal) {
    return nullptr;
  }
  Json json = {{"count", optimal->count}, {"paths", optimal->paths}, {"places", optimal->places}};
  if (!optimal->codes.empty()) {
    json["codes"] = codes_json(optimal->codes, names);
  }
  return json;
}

Json minimal_json(const std::optional<MinimalRegionMaps>& minimal, const ViewNames& names) {
  if (!minimal) {
    return nullptr;
  }
  Json json = {{"paths", minimal->paths},
               {"places", minimal->places},
               {"paths_with_two_places", minimal->paths_with_two_places},
               {"count", minimal->count},
               {"count_without_triangles", minimal->count_without_triangles},
               {"count_fewest_order_atoms", minimal->count_fewest_order_atoms}};
  if (!minimal->codes.empty()) {
    json["codes"] = codes_json(minimal->codes, names);
  }
  return json;
}

void compare(const std::string& field,
             const Json& expected,
             const Json& counted,
             Differences* differences);

void compare_members(const std::string& prefix,
                     const Json& expected,
                     const Json& counted,
                     Differences* differences) {
  for (const auto& [name, value] : expected.items()) {
    if (counted.contains(name)) {
      compare(prefix + name, value, counted[name], differences);
    } else {
      differences->not_counted.insert(prefix + name);
    }
  }
}

void compare(const std::string& field,
             const Json& expected,
             const Json& counted,
             Differences* differences) {
  if (expected.is_object() && counted.is_object()) {
    compare_members(field + ".", expected, counted, differences);
    return;
  }
  differences->compared.insert(field);
  const auto hold = [&](const std::string& name, const Json& one, const Json& other) {
    if (one != other) {
      differences->found.push_back(name + ": expected " + one.dump() + ", got " + other.dump());
    }
  };
  if (!expected.is_array() || !counted.is_array() || expected.size() != counted.size()) {
    return hold(field, expected, counted);
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    hold(field + "[" + std::to_string(i) + "]", expected[i], counted[i]);
  }
}

std::string simplest_text(std::int64_t count, int paths, int places) {
  return grouped(count) + (count == 1 ? " map of " : " maps of ") + std::to_string(paths) +
         " paths and " + std::to_string(places) + " places";
}

void print_line(std::ostream& out, std::string name, const std::string& value) {
  name.resize(34, ' ');
  out << "  " << name << value << '\n';
}

}  // namespace

Json to_json(const MapCounts& counts, const ViewNames& names) {
  return {{"tree_nodes", counts.tree_nodes},
          {"maps_built", counts.maps_built},
          {"view_mismatches", counts.view_mismatches},
          {"final_maps", counts.final_maps},
          {"closed_paper", counts.closed_paper},
          {"closed_no_pending", counts.closed_no_pending},
          {"region_consistent_finals", counts.region_consistent_finals},
          {"perpendicular_closed_paper", counts.perpendicular_closed_paper},
          {"optimal", optimal_json(counts.optimal, names)},
          {"leaves_per_step", counts.leaves_per_step},
          {"region_leaves_per_step", counts.region_leaves_per_step},
          {"minimal_region", minimal_json(counts.minimal_region, names)}};
}

Differences differences(const Json& expected, const Json& counted) {
  Differences differences;
  compare_members("", expected, counted, &differences);
  return differences;
}

void print_counts(const MapCounts& counts, std::ostream& out) {
  print_line(out, "tree nodes", grouped(counts.tree_nodes));
  print_line(out, "maps built", grouped(counts.maps_built));
  print_line(out, "views that contradict a link", grouped(counts.view_mismatches));
  print_line(out, "final maps", grouped(counts.final_maps));
  print_line(out, "  closed (as the paper counts)", grouped(counts.closed_paper));
  print_line(out, "  no gateway pending", grouped(counts.closed_no_pending));
  print_line(out, "  region-consistent", grouped(counts.region_consistent_finals));
  print_line(out, "  closed (paper), perpendicular", grouped(counts.perpendicular_closed_paper));
  print_line(out, "optimal",
             counts.optimal ? simplest_text(counts.optimal->count, counts.optimal->paths,
                                            counts.optimal->places)
                            : "none (a gateway is pending in every region-consistent map)");
  if (counts.minimal_region) {
    const MinimalRegionMaps& minimal = *counts.minimal_region;
    print_line(out, "simplest region-consistent",
               simplest_text(minimal.count, minimal.paths, minimal.places) + ", " +
                   grouped(minimal.count_without_triangles) + " without triangles, " +
                   grouped(minimal.count_fewest_order_atoms) + " with the fewest order atoms (" +
                   grouped(minimal.order_atoms) + "); " +
                   std::to_string(minimal.paths_with_two_places) +
                   " paths from two places or more");
  }
  print_line(out, "maps after each travel", joined(counts.leaves_per_step));
  print_line(out, "  region-consistent", joined(counts.region_leaves_per_step));
}

}  // namespace cairn::lab
