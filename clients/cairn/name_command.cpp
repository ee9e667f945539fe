#include "clients/cairn/commands.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::result_t;

struct NameOptions {
  LinkOptions link;
  std::int64_t place = -1;
  std::string name;
};

void name_place(const NameOptions& options, const Streams& streams) {
  const result_t result = DaemonLink(options.link).name_place(options.place, options.name);
  if (result.code != result_t::OK) {
    const bool is_our_fault =
        result.code == result_t::NOT_FOUND || result.code == result_t::BAD_REQUEST;
    throw Failure(is_our_fault ? ExitCode::kBadData : ExitCode::kNoService,
                  "not named: " + printable(result.reason));
  }
  streams.out << "place " << options.place
              << (options.name.empty() ? " has no name" : " is called " + options.name) << '\n';
}

}  // namespace

void add_name_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand("name", "Gives a place a name");
  const auto options = std::make_shared<NameOptions>();
  command->add_option("place", options->place, "Number of the place")
      ->required()
      ->check(CLI::NonNegativeNumber);
  command->add_option("name", options->name, "Its name; empty takes it away")->required();
  add_link_options(*command, &options->link);
  command->callback([options, streams] { name_place(*options, streams); });
}

}  // namespace cairn::clients
