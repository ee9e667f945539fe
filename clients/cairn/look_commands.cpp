#include <cairn_lcm/snapshot_request_t.hpp>

#include "clients/cairn/commands.hpp"
#include "clients/cairn/map_text.hpp"
#include "clients/common/json.hpp"
#include "clients/common/map_file.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using Json = nlohmann::ordered_json;
using Request = cairn_lcm::snapshot_request_t;

struct DocumentName {
  std::int32_t what;
  const char* name;
};
constexpr DocumentName kDocumentNames[] = {
    {Request::GLOBAL_MAP, "global_map"}, {Request::TOPOLOGY, "topology"},
    {Request::HYPOTHESES, "hypotheses"}, {Request::TRAJECTORY, "trajectory"},
    {Request::LPM, "local_map"},         {Request::VISITS, "visits"}};
constexpr const char* kJournalTables[] = {"visit", "scan", "assertion"};

// A map file just begun holds no documents yet; that is no damage.
template <typename Message>
std::optional<Message> if_held(MapFile& file, std::int32_t what, Message (MapFile::*read)()) {
  return file.documents().count(what) == 0 ? std::nullopt : std::optional<Message>((file.*read)());
}

Json file_summary(MapFile& file, const std::string& name) {
  Json json = {{"file", name}, {"meta", file.meta()}};
  const auto topology = if_held(file, Request::TOPOLOGY, &MapFile::topology);
  const auto hypotheses = if_held(file, Request::HYPOTHESES, &MapFile::hypotheses);
  if (topology) {
    json["num_places"] = topology->places.size();
    json["num_paths"] = topology->num_paths;
    json["num_segments"] = topology->segments.size();
    json["best_hypothesis"] = topology->hypothesis_id;
    json["best_probability"] = topology->probability;
  }
  if (hypotheses) {
    json["num_hypotheses"] = hypotheses->num_live;
    json["num_waiting"] = hypotheses->num_waiting;
    json["num_refuted"] = hypotheses->num_refuted;
    json["num_visits"] = hypotheses->num_visits;
    json["guarantee_given_up_at"] = hypotheses->guarantee_given_up_at;
    json["guarantee_reason"] = hypotheses->guarantee_reason;
    json["blamed"] = hypotheses->blamed;
  }
  json["documents"] = Json::object();
  const std::map<std::int32_t, MapFile::Document> documents = file.documents();
  for (const DocumentName& document : kDocumentNames) {
    const auto found = documents.find(document.what);
    if (found != documents.end()) {
      json["documents"][document.name] = {{"revision", found->second.revision},
                                          {"size_bytes", found->second.size_bytes}};
    }
  }
  json["journal"] = Json::object();
  for (const char* table : kJournalTables) {
    const std::int64_t rows = file.row_count(table);
    if (rows >= 0) {
      json["journal"][table] = rows;
    }
  }
  return json;
}

std::string number(const Json& json, const char* key) {
  return json.value(key, Json(0)).dump();
}

void print_file(std::ostream& out, const Json& json) {
  out << "map file     " << printable(json["file"].get<std::string>()) << '\n';
  for (const auto& [key, value] : json["meta"].items()) {
    out << "  " << printable(key) << " = " << printable(value.get<std::string>()) << '\n';
  }
  if (json.contains("num_places")) {
    out << "topology     " << number(json, "num_places") << " places, " << number(json, "num_paths")
        << " paths, " << number(json, "num_segments") << " segments; hypothesis "
        << number(json, "best_hypothesis") << " with probability "
        << fixed(json["best_probability"].get<double>(), 3) << '\n';
  }
  if (json.contains("num_hypotheses")) {
    out << "hypotheses   " << number(json, "num_hypotheses") << " live after "
        << number(json, "num_visits") << " visits, " << number(json, "num_waiting") << " waiting, "
        << number(json, "num_refuted") << " refuted\nguarantee    "
        << guarantee_text(json["guarantee_given_up_at"], json["guarantee_reason"]) << '\n';
    if (!json["blamed"].get<std::string>().empty()) {
      out << "blamed       " << printable(json["blamed"].get<std::string>()) << '\n';
    }
  }
  for (const auto& [name, document] : json["documents"].items()) {
    out << "document     " << name << " at revision " << number(document, "revision") << ", "
        << byte_size(document["size_bytes"]) << '\n';
  }
  for (const auto& [table, rows] : json["journal"].items()) {
    out << "journal      " << table << ": " << rows.dump() << " rows\n";
  }
}

void show_status(const SourceOptions& options, const Streams& streams) {
  if (!options.map_file.empty()) {
    MapFile file(options.map_file);
    const Json json = file_summary(file, options.map_file);
    if (options.as_json) {
      streams.out << dumped(json) << '\n';
    } else {
      print_file(streams.out, json);
    }
    return;
  }
  const cairn_lcm::status_t status = DaemonLink(options.link).status();
  if (options.as_json) {
    streams.out << dumped(to_json(status)) << '\n';
  } else {
    print_status(streams.out, status);
  }
}

std::shared_ptr<SourceOptions> add_source_options(CLI::App& command) {
  auto options = std::make_shared<SourceOptions>();
  add_map_file(command, options.get());
  add_json_flag(command, &options->as_json);
  add_link_options(command, &options->link);
  return options;
}

}  // namespace

void add_status_command(CLI::App& app, const Streams& streams) {
  CLI::App* command =
      app.add_subcommand("status", "How the daemon fares, or what a map file holds");
  const auto options = add_source_options(*command);
  command->callback([options, streams] { show_status(*options, streams); });
}

void add_hypotheses_command(CLI::App& app, const Streams& streams) {
  CLI::App* command =
      app.add_subcommand("hypotheses", "The maps that are held possible, best first");
  const auto options = add_source_options(*command);
  command->callback([options, streams] {
    const cairn_lcm::hypotheses_t hypotheses = open_source(*options)->hypotheses();
    if (options->as_json) {
      streams.out << dumped(to_json(hypotheses)) << '\n';
    } else {
      print_hypotheses(streams.out, hypotheses);
    }
  });
}

}  // namespace cairn::clients
