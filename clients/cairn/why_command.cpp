// Why the best map is what it is, and why others are not.

#include <algorithm>
#include <limits>

#include "clients/cairn/commands.hpp"
#include "clients/cairn/goal.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/json.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::explain_request_t;
using cairn_lcm::explained_step_t;
using cairn_lcm::explanation_t;
using cairn_lcm::result_t;

constexpr std::int64_t kMostVisits = std::numeric_limits<std::int32_t>::max();

struct WhyOptions {
  LinkOptions link;
  bool as_json = false;
  std::int64_t visit = -1;
  std::string place;
  std::vector<std::int64_t> hypotheses;
};

explanation_t ask(DaemonLink& link, const explain_request_t& request) {
  explanation_t explanation = link.explain(request);
  const result_t& result = explanation.result;
  if (result.code != result_t::OK) {
    const bool is_our_fault =
        result.code == result_t::NOT_FOUND || result.code == result_t::BAD_REQUEST;
    throw Failure(is_our_fault ? ExitCode::kBadData : ExitCode::kNoService,
                  "not explained: " + printable(result.reason));
  }
  return explanation;
}

explanation_t explained_visit(DaemonLink& link, std::int64_t visit) {
  explain_request_t request{};
  request.kind = explain_request_t::VISIT;
  request.visit = visit;
  return ask(link, request);
}

/// Asks page by page. The map may change between two pages; each step says of which map it is.
explanation_t overview(DaemonLink& link) {
  explain_request_t request{};
  request.kind = explain_request_t::OVERVIEW;
  explanation_t all = ask(link, request);
  while (all.next_visit > request.visit) {
    request.visit = all.next_visit;
    explanation_t page = ask(link, request);
    all.steps.insert(all.steps.end(), page.steps.begin(), page.steps.end());
    all.next_visit = page.next_visit;
  }
  return all;
}

void print_visit(std::ostream& out, const explanation_t& explanation) {
  if (!explanation.steps.empty()) {
    out << "visit " << explanation.visit << " is at place " << explanation.steps.front().at_place
        << " of hypothesis " << explanation.hypothesis_id << '\n';
  }
  for (const explained_step_t& step : explanation.steps) {
    out << "  " << printable(step.sentence) << '\n';
  }
  if (explanation.num_left_out > 0) {
    out << "  and " << explanation.num_left_out << " more that are refuted\n";
  }
}

void explain_visits(const WhyOptions& options,
                    const Streams& streams,
                    const std::vector<std::int64_t>& visits,
                    DaemonLink& link) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const std::int64_t visit : visits) {
    const explanation_t explanation = explained_visit(link, visit);
    if (options.as_json) {
      json.push_back(to_json(explanation));
    } else {
      print_visit(streams.out, explanation);
    }
  }
  if (options.as_json) {
    streams.out << dumped(options.visit >= 0 ? json.front() : json) << '\n';
  }
}

std::int64_t place_number(DaemonLink& link, const std::string& text) {
  const std::optional<cairn_lcm::place_ref_t> place = parse_place(text);
  if (!place || place->visit >= 0) {
    throw Failure(ExitCode::kUsage, "--place: expected the number of a place, or its name");
  }
  if (place->place >= 0) {
    return place->place;
  }
  for (const cairn_lcm::place_t& known : link.topology().places) {
    if (known.name == place->name) {
      return known.id;
    }
  }
  throw Failure(ExitCode::kBadData, "no place is called '" + printable(place->name) + "'");
}

void explain_place(const WhyOptions& options, const Streams& streams) {
  DaemonLink link(options.link);
  const std::int64_t place = place_number(link, options.place);
  std::vector<std::int64_t> visits;
  for (const explained_step_t& step : overview(link).steps) {
    if (step.at_place == place) {
      visits.push_back(step.visit);
    }
  }
  if (visits.empty()) {
    throw Failure(ExitCode::kBadData, "there is no place " + std::to_string(place));
  }
  explain_visits(options, streams, visits, link);
}

void explain_parting(const WhyOptions& options, const Streams& streams) {
  explain_request_t request{};
  request.kind = explain_request_t::PARTING;
  request.hypothesis_a = options.hypotheses[0];
  request.hypothesis_b = options.hypotheses[1];
  DaemonLink link(options.link);
  const explanation_t explanation = ask(link, request);
  if (options.as_json) {
    streams.out << dumped(to_json(explanation)) << '\n';
  } else {
    streams.out << printable(explanation.sentence) << '\n';
  }
}

void explain_map(const WhyOptions& options, const Streams& streams) {
  DaemonLink link(options.link);
  const explanation_t explanation = overview(link);
  if (options.as_json) {
    streams.out << dumped(to_json(explanation)) << '\n';
    return;
  }
  streams.out << "hypothesis " << explanation.hypothesis_id << " took\n";
  for (const explained_step_t& step : explanation.steps) {
    streams.out << "  place " << step.at_place << ": " << printable(step.sentence) << '\n';
  }
}

void explain(const WhyOptions& options, const Streams& streams) {
  if (!options.hypotheses.empty()) {
    explain_parting(options, streams);
  } else if (!options.place.empty()) {
    explain_place(options, streams);
  } else if (options.visit >= 0) {
    DaemonLink link(options.link);
    explain_visits(options, streams, {options.visit}, link);
  } else {
    explain_map(options, streams);
  }
}

}  // namespace

void add_why_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand(
      "why",
      "What the best map took each visit for; of one visit all that it might have been, and "
      "what decided");
  const auto options = std::make_shared<WhyOptions>();
  CLI::Option* const visit = command->add_option("visit", options->visit, "Number of a visit")
                                 ->check(whole_number(0, kMostVisits));
  CLI::Option* const place =
      command->add_option("--place", options->place, "All visits to this place, number or name")
          ->excludes(visit);
  command
      ->add_option("--hypotheses", options->hypotheses,
                   "Two of 'cairn hypotheses': where they part, and what speaks for each")
      ->expected(2)
      ->check(whole_number(0, std::numeric_limits<std::int64_t>::max()))
      ->excludes(visit)
      ->excludes(place);
  add_json_flag(*command, &options->as_json);
  add_link_options(*command, &options->link);
  command->callback([options, streams] { explain(*options, streams); });
}

}  // namespace cairn::clients
