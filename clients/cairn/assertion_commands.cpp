// What an operator says about places: same, different, retract; and the audit of it.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <limits>

#include "clients/cairn/commands.hpp"
#include "clients/cairn/goal.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/json.hpp"
#include "clients/common/map_file.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::assert_request_t;
using cairn_lcm::result_t;

constexpr std::int32_t kMostShown = 20;
constexpr std::size_t kMostNameBytes = 64;  ///< Of places and of people: the daemon takes no more.

struct SayOptions {
  LinkOptions link;
  bool as_json = false;
  std::int32_t kind = assert_request_t::SAME;
  std::string a;
  std::string b;
  std::int64_t assertion = 0;
  std::string who;
};

std::string user() {
  const char* const name = std::getenv("USER");
  return name == nullptr || *name == '\0' ? "unknown" : name;
}

cairn_lcm::place_ref_t place_of(const std::string& text) {
  const std::optional<cairn_lcm::place_ref_t> place = parse_place(text);
  if (!place) {
    throw Failure(ExitCode::kUsage,
                  as_typed(text) + " is no place: expected its number, its name, or visit:N");
  }
  if (place->name.size() > kMostNameBytes) {
    throw Failure(ExitCode::kUsage, as_typed(text) + " is no place: a name has at most " +
                                        std::to_string(kMostNameBytes) + " bytes");
  }
  return *place;
}

void print_report(std::ostream& out, const cairn_lcm::assertion_report_t& report, bool is_made) {
  out << "assertion " << report.assertion << (is_made ? ": " : " taken back: ")
      << printable(report.sentence) << '\n';
  const auto shown = std::min<std::size_t>(report.visit.size(), kMostShown);
  for (std::size_t i = 0; i < shown; ++i) {
    out << "  visit " << report.visit[i] << ": place " << report.place[i] << " (known since visit "
        << report.known_since_after[i] << "), before the one known since visit "
        << report.known_since_before[i] << '\n';
  }
  if (static_cast<std::size_t>(report.num_moved) > shown) {
    out << "  and " << static_cast<std::size_t>(report.num_moved) - shown << " more\n";
  }
}

void check_who(const std::string& who) {
  const bool is_text = std::none_of(who.begin(), who.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (who.empty() || who.size() > kMostNameBytes || !is_text) {
    throw Failure(
        ExitCode::kUsage,
        "--who: expected 1 to " + std::to_string(kMostNameBytes) +
            " bytes without control characters, got " +
            (who.size() > kMostNameBytes ? std::to_string(who.size()) + " bytes" : as_typed(who)));
  }
}

void say(const SayOptions& options, const Streams& streams) {
  check_who(options.who);
  assert_request_t request{};
  request.kind = options.kind;
  request.assertion = options.assertion;
  request.who = options.who;
  const bool is_made = options.kind != assert_request_t::RETRACT;
  request.a = is_made ? place_of(options.a) : cairn_lcm::place_ref_t{-1, -1, ""};
  request.b = is_made ? place_of(options.b) : request.a;
  const cairn_lcm::assertion_report_t report = DaemonLink(options.link).say(request);
  const result_t& result = report.result;
  if (result.code != result_t::OK) {
    const bool is_our_fault =
        result.code == result_t::NOT_FOUND || result.code == result_t::BAD_REQUEST;
    throw Failure(
        is_our_fault ? ExitCode::kBadData : ExitCode::kNoService,
        std::string(is_made ? "not asserted: " : "not taken back: ") + printable(result.reason));
  }
  if (options.as_json) {
    streams.out << dumped(to_json(report)) << '\n';
  } else {
    print_report(streams.out, report, is_made);
  }
}

void add_who(CLI::App& command, SayOptions* options) {
  options->who = user();
  command.add_option("--who", options->who, "Who says so, for the audit [$USER]");
  add_json_flag(command, &options->as_json);
  add_link_options(command, &options->link);
}

void add_say_command(CLI::App& app,
                     const Streams& streams,
                     const std::pair<const char*, std::int32_t>& verb,
                     const char* help) {
  CLI::App* command = app.add_subcommand(verb.first, help);
  const auto options = std::make_shared<SayOptions>();
  options->kind = verb.second;
  const char* const place_help =
      "Number of a place of the best map, its name, or visit:N for the place of a visit";
  command->add_option("a", options->a, place_help)->required();
  command->add_option("b", options->b, place_help)->required();
  add_who(*command, options.get());
  command->callback([options, streams] { say(*options, streams); });
}

/// In UTC: an audit is read in other places than it was made.
std::string date_of(std::int64_t utime) {
  const std::time_t seconds = utime / 1'000'000;
  std::tm date{};
  std::array<char, 32> text{};
  if (gmtime_r(&seconds, &date) == nullptr ||
      std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &date) == 0) {
    return std::to_string(utime);
  }
  return text.data();
}

std::string visit_text(std::int64_t visit, std::int64_t place) {
  return "visit " + std::to_string(visit) +
         (place < 0 ? "" : " (place " + std::to_string(place) + ")");
}

void print_assertions(std::ostream& out, const cairn_lcm::assertions_t& assertions) {
  if (assertions.assertions.empty()) {
    out << "nothing was ever asserted\n";
    return;
  }
  for (const cairn_lcm::assertion_t& one : assertions.assertions) {
    out << one.number << "  " << visit_text(one.visit_a, one.place_a)
        << (one.is_same != 0 ? " is the same place as " : " is another place than ")
        << visit_text(one.visit_b, one.place_b) << "; " << printable(one.who) << ", "
        << date_of(one.made_utime) << ", after " << one.made_after_visits << " visits"
        << (one.is_in_force != 0 ? "; in force" : "; taken back") << '\n';
    if (!one.effect.empty()) {
      out << "   " << printable(one.effect) << '\n';
    }
    if (one.is_in_force == 0) {
      out << "   taken back by " << printable(one.retracted_by) << ", "
          << date_of(one.retracted_utime) << ", after " << one.retracted_after_visits << " visits"
          << (one.retraction_effect.empty() ? "" : ": " + printable(one.retraction_effect)) << '\n';
    }
  }
}

}  // namespace

void add_assertion_commands(CLI::App& app, const Streams& streams) {
  add_say_command(app, streams, {"same", assert_request_t::SAME},
                  "Says that two places are one; every map obeys until it is taken back");
  add_say_command(app, streams, {"different", assert_request_t::DIFFERENT},
                  "Says that two places are two; for one that two were merged into, name visits");

  CLI::App* retract = app.add_subcommand("retract", "Takes an assertion back");
  const auto options = std::make_shared<SayOptions>();
  options->kind = assert_request_t::RETRACT;
  retract->add_option("number", options->assertion, "Its number; see 'cairn assertions'")
      ->required()
      ->check(whole_number(1, std::numeric_limits<std::int64_t>::max()));
  add_who(*retract, options.get());
  retract->callback([options, streams] { say(*options, streams); });

  CLI::App* audit =
      app.add_subcommand("assertions", "All that was ever said about places, by whom and when");
  const auto source = std::make_shared<SourceOptions>();
  add_map_file(*audit, source.get());
  add_json_flag(*audit, &source->as_json);
  add_link_options(*audit, &source->link);
  audit->callback([source, streams] {
    const cairn_lcm::assertions_t assertions = open_source(*source)->assertions();
    if (source->as_json) {
      streams.out << dumped(to_json(assertions)) << '\n';
    } else {
      print_assertions(streams.out, assertions);
    }
  });
}

}  // namespace cairn::clients
