#include "bench/lab/buildings_command.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/building_score.hpp"
#include "clients/common/progress.hpp"
#include "clients/common/text.hpp"
#include "clients/common/within.hpp"

namespace cairn::lab {
namespace {

using clients::fixed;
using OrderedJson = nlohmann::ordered_json;

struct BuildingsRequest {
  int count = 20;
  std::uint64_t first_seed = 1;
  int travels = 40;
  bool as_json = false;
};

struct ScoredBuilding {
  std::uint64_t seed = 0;
  bool repeats_itself = false;
  BuildingScore score;
};

double percent(std::size_t part, std::size_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 100.0;
}

OrderedJson json_of(const BuildingScore& score) {
  return {{"passages", score.passages},
          {"noticed", score.noticed},
          {"false_places", score.false_places},
          {"gateways", score.gateways},
          {"gateways_found", score.gateways_found},
          {"gateways_false", score.gateways_false},
          {"stars_true", score.stars_true},
          {"revisits", score.revisits},
          {"same_star", score.same_star}};
}

std::vector<std::string> row(const std::string& name, const BuildingScore& score) {
  const auto share = [](std::size_t part, std::size_t whole) {
    return fixed(percent(part, whole), 1) + " (" + std::to_string(part) + "/" +
           std::to_string(whole) + ")";
  };
  return {name,
          share(score.noticed, score.passages),
          std::to_string(score.false_places),
          share(score.gateways_found, score.gateways),
          std::to_string(score.gateways_false),
          share(score.stars_true, score.noticed),
          share(score.same_star, score.revisits)};
}

int score_buildings(const BuildingsRequest& request, const Streams& streams) {
  std::vector<ScoredBuilding> scored;
  BuildingScore all;
  clients::Progress progress("buildings");
  for (int i = 0; i < request.count; ++i) {
    const std::uint64_t seed = request.first_seed + static_cast<std::uint64_t>(i);
    const Building building(seed);
    const BuildingScore score = score_of(building, walk_of(building, 0, request.travels),
                                         drive_building(building, seed, 0, request.travels));
    scored.push_back({seed, building.repeats_itself(), score});
    all += score;
    progress.show(i + 1, request.count);
  }
  if (request.as_json) {
    OrderedJson json = {{"buildings", OrderedJson::array()}, {"all", json_of(all)}};
    for (const ScoredBuilding& building : scored) {
      OrderedJson one = {{"seed", building.seed}, {"repeats_itself", building.repeats_itself}};
      one.update(json_of(building.score));
      json["buildings"].push_back(std::move(one));
    }
    streams.out << json.dump(2) << '\n';
    return 0;
  }
  clients::Table table({"building", "noticed, %", "false places", "gateways found, %", "false",
                        "star true, %", "same star again, %"});
  for (const ScoredBuilding& building : scored) {
    table.add(row(std::to_string(building.seed), building.score));
  }
  table.add(row("all", all));
  table.print(streams.out);
  return 0;
}

}  // namespace

void add_buildings_command(CLI::App& app, const Streams& streams, int* status) {
  CLI::App* command = app.add_subcommand(
      "buildings", "Perceive the junctions of made-up buildings and hold them against the truth");
  auto request = std::make_shared<BuildingsRequest>();
  command->add_option("--worlds", request->count, "So many buildings")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--seed", request->first_seed, "Of the first building; the others follow")
      ->check(clients::within(0.0, clients::kMostSeed))
      ->capture_default_str();
  command->add_option("--travels", request->travels, "Corridors driven in each")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_flag("--json", request->as_json, "Print JSON");
  command->callback([request, streams, status] { *status = score_buildings(*request, streams); });
}

}  // namespace cairn::lab
