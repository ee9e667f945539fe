#include <algorithm>
#include <vector>

#include "clients/cairn/commands.hpp"
#include "clients/common/json.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDoubtful_sigmas = 3.0;

/// A segment whose travels others can contradict, and what they say.
struct CheckedSegment {
  const cairn_lcm::segment_t* segment = nullptr;
  std::int64_t found_again = -1;  ///< The place that the disagreeing travel led back to; -1: none.
};

/// The place of a visit if an earlier visit was there, too; else -1.
std::int64_t place_found_again(const cairn_lcm::visit_places_t& visits, std::int64_t visit) {
  if (visit < 0 || visit >= static_cast<std::int64_t>(visits.place_id.size())) {
    return -1;
  }
  const auto at = visits.place_id.begin() + visit;
  return std::find(visits.place_id.begin(), at, *at) != at ? *at : -1;
}

/// Those that disagree most first.
std::vector<CheckedSegment> checked(const cairn_lcm::topology_t& topology,
                                    const cairn_lcm::visit_places_t& visits) {
  std::vector<CheckedSegment> segments;
  for (const cairn_lcm::segment_t& segment : topology.segments) {
    if (segment.disagreeing_visit >= 0) {
      segments.push_back({&segment, place_found_again(visits, segment.disagreeing_visit)});
    }
  }
  std::stable_sort(segments.begin(), segments.end(),
                   [](const CheckedSegment& a, const CheckedSegment& b) {
                     return a.segment->disagreement_sigmas > b.segment->disagreement_sigmas;
                   });
  return segments;
}

std::string verdict_on(const CheckedSegment& one) {
  std::string text = "travel to visit " + std::to_string(one.segment->disagreeing_visit);
  if (one.found_again >= 0) {
    text += ", where place " + std::to_string(one.found_again) + " was found again";
  }
  if (one.segment->disagreement_sigmas >= kDoubtful_sigmas) {
    text += one.found_again >= 0 ? ": that closure is in doubt" : ": that travel is in doubt";
  }
  return text;
}

std::string conclusion_of(const std::vector<CheckedSegment>& segments) {
  const auto doubtful = std::count_if(segments.begin(), segments.end(), [](const auto& one) {
    return one.segment->disagreement_sigmas >= kDoubtful_sigmas;
  });
  if (segments.empty()) {
    return "nothing checks anything yet: no loop is closed";
  }
  if (doubtful == 0) {
    return "all agree to within " + fixed(kDoubtful_sigmas, 0) +
           " sigmas; 0.0: at least as well as every second travel would by chance";
  }
  return std::to_string(doubtful) + " of " + std::to_string(segments.size()) +
         " disagree by 3 sigmas or more, one in 740 by chance; see `cairn why --visit N`";
}

Json to_json(const std::vector<CheckedSegment>& segments, const cairn_lcm::topology_t& topology) {
  Json json = {{"hypothesis_id", topology.hypothesis_id},
               {"num_segments", topology.segments.size()},
               {"segments", Json::array()}};
  for (const CheckedSegment& one : segments) {
    json["segments"].push_back({{"from_place", one.segment->from_place},
                                {"to_place", one.segment->to_place},
                                {"num_travels", one.segment->num_travels},
                                {"disagreement_sigmas", one.segment->disagreement_sigmas},
                                {"disagreeing_visit", one.segment->disagreeing_visit},
                                {"place_found_again", one.found_again}});
  }
  return json;
}

void print(std::ostream& out,
           const std::vector<CheckedSegment>& segments,
           const cairn_lcm::topology_t& topology) {
  out << topology.segments.size() << " segments of hypothesis " << topology.hypothesis_id << ", "
      << segments.size() << " of them checked by others: " << conclusion_of(segments) << '\n';
  if (segments.empty()) {
    return;
  }
  out << "from   to  travels  sigmas\n";
  const auto column = [&out](const std::string& text, std::size_t width) {
    out << std::string(text.size() < width ? width - text.size() : 0, ' ') << text;
  };
  for (const CheckedSegment& one : segments) {
    column(std::to_string(one.segment->from_place), 4);
    column(std::to_string(one.segment->to_place), 5);
    column(std::to_string(one.segment->num_travels), 9);
    column(fixed(one.segment->disagreement_sigmas, 1), 8);
    out << "  " << verdict_on(one) << '\n';
  }
}

void show_consistency(const SourceOptions& options, const Streams& streams) {
  const std::unique_ptr<MapSource> source = open_source(options);
  const cairn_lcm::topology_t topology = source->topology();
  const std::vector<CheckedSegment> segments = checked(topology, source->visit_places());
  if (options.as_json) {
    streams.out << dumped(to_json(segments, topology)) << '\n';
  } else {
    print(streams.out, segments, topology);
  }
}

}  // namespace

void add_consistency_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand(
      "consistency",
      "Which travels disagree with all others, and which closures that puts in doubt");
  const auto options = std::make_shared<SourceOptions>();
  add_map_file(*command, options.get());
  add_json_flag(*command, &options->as_json);
  add_link_options(*command, &options->link);
  command->callback([options, streams] { show_consistency(*options, streams); });
}

}  // namespace cairn::clients
