#include "runtime/replay.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "runtime/engine.hpp"
#include "runtime/health_status.hpp"
#include "runtime/map_maker.hpp"
#include "runtime/progress.hpp"
#include "service/refined_map.hpp"
#include "wire/log_reader.hpp"

namespace cairn {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What a replay counts besides the inlets' own counters.
struct Tally {
  std::int64_t scans = 0;
  std::int64_t matched = 0;
  std::map<std::string, std::int64_t> notes;   ///< How the fixes came about.
  std::map<std::string, std::int64_t> health;  ///< How often each state began.
  std::vector<std::string> relocalised;
  std::map<std::string, std::int64_t> skipped;  ///< Lines and channels that carry nothing for us.
  std::int64_t first_utime = 0;
  std::int64_t last_utime = 0;
  std::vector<std::string> troubles;
  double refine_s = 0.0;
  double draw_s = 0.0;
  double store_s = 0.0;
};

void count(const Updates& updates, Tally* tally) {
  for (const PerceivedScan& scan : updates.scans) {
    ++tally->scans;
    tally->matched += scan.fix.is_matched ? 1 : 0;
    ++tally->notes[to_string(scan.fix.note)];
  }
  if (updates.relocalised) {
    tally->relocalised.push_back(to_text(*updates.relocalised));
  }
}

class Replay {
 public:
  Replay(const DaemonOptions& options, Engine* engine)
      : options_(options),
        engine_(engine),
        inlets_(to_inlet_options(options),
                {[this](LaserScan scan) { take(std::move(scan)); },
                 [this](OdometrySample sample) { take(sample); }, [](const SonarRing&) {}}) {}

  /// @return false where the log is damaged or cannot be opened; tally().troubles says why
  bool run(const std::string& log) {
    wire::Expected<wire::LogReader> reader = wire::LogReader::open(log);
    if (!reader) {
      tally_.troubles.push_back(reader.error());
      return false;
    }
    while (const std::optional<wire::LogMessage> message = reader->next()) {
      if (tally_.first_utime == 0) {
        tally_.first_utime = message->utime;
      }
      tally_.last_utime = std::max(tally_.last_utime, message->utime);
      const Inlets::Outcome outcome =
          inlets_.dispatch(message->channel, message->bytes.data(), message->bytes.size());
      if (outcome == Inlets::Outcome::kNotOurs) {
        ++tally_.skipped["channel " + message->channel];
      }
      progress_.show(log + ", " + std::to_string(tally_.scans) + " scans", reader->bytes_read(),
                     reader->bytes_total());
    }
    for (const auto& [word, lines] : reader->skipped_lines()) {
      tally_.skipped["line " + word] += lines;
    }
    for (const std::string& remark : inlets_.take_remarks()) {
      tally_.troubles.push_back(remark);
    }
    if (reader->damage()) {
      tally_.troubles.push_back(log + ": " + *reader->damage());
      return false;
    }
    return true;
  }

  /// Takes up what waits, and stores what is to be seen of the map.
  Status finish() {
    count(engine_->finish(), &tally_);
    progress_.finish();
    Clock::time_point start = Clock::now();
    MapMaker map_maker(options_.service.global_map);
    MapRefiner map_refiner(options_.service.refinement);
    const std::shared_ptr<const MapState> state = map_refiner.refined(engine_->service().state());
    tally_.refine_s = seconds_since(start);
    start = Clock::now();
    map_maker.draw(*state);
    tally_.draw_s = seconds_since(start);
    start = Clock::now();
    engine_->store(map_maker.documents(*state, {0, engine_->map_id()}));
    const Status status = engine_->close();
    tally_.store_s = seconds_since(start) + engine_->journal_seconds();
    return status;
  }

  [[nodiscard]] const Tally& tally() const { return tally_; }
  [[nodiscard]] const Inlets& inlets() const { return inlets_; }

 private:
  void take(SensorReading reading) {
    const Updates updates = engine_->take(std::move(reading));
    count(updates, &tally_);
    if (updates.is_health_changed) {
      ++tally_.health[health_code(engine_->service().health())];
    }
  }

  const DaemonOptions& options_;
  Engine* engine_;
  Tally tally_;
  Progress progress_;
  Inlets inlets_;
};

Json localisation_of(const Tally& tally, const MappingService& service) {
  const LocalisationHealth& health = service.health();
  Json faults = Json::object();
  for (std::size_t i = 1; i < health.fault_counts.size(); ++i) {
    if (health.fault_counts[i] > 0) {
      faults[std::string(to_string(static_cast<MotionFault>(i)))] = health.fault_counts[i];
    }
  }
  return {{"states", tally.health},
          {"faults", faults},
          {"relocalised", tally.relocalised},
          {"times_lost", health.times_lost},
          {"local_map_restarts", service.local_map_restarts()},
          {"scans_not_mapped", health.scans_not_mapped}};
}

Json summary_of(const Replay& replay, const Engine& engine, double spent_s) {
  const MappingService& service = engine.service();
  const std::shared_ptr<const MapState> state = service.state();
  const Tally& tally = replay.tally();
  const double log_s = static_cast<double>(tally.last_utime - tally.first_utime) * 1e-6;
  Json refused = Json::object();
  std::int64_t laser_changes = 0;
  for (const auto& [channel, counters] : replay.inlets().counters()) {
    laser_changes += counters.laser_changes;
    const std::int64_t all = counters.refused + counters.malformed + counters.unknown_type;
    if (all > 0) {
      refused[channel] = {{"messages", all}, {"last", counters.last_refusal}};
    }
  }
  const JoinerCounters& joiner = service.joiner_counters();
  const PlaceDetectorReport& places = service.place_report();
  const StageClock& clock = engine.stage_clock();
  return {{"scans", tally.scans},
          {"matched", tally.matched},
          {"fixes", tally.notes},
          {"localisation", localisation_of(tally, service)},
          {"duplicate_scans_dropped", joiner.duplicates},
          {"repeated_stamps", joiner.repeated},
          {"out_of_order", joiner.out_of_order},
          {"stray_stamps_dropped", joiner.strays},
          {"clock_steps", joiner.clock_steps},
          {"gaps", joiner.gaps},
          {"scans_without_odometry", joiner.scans_without_odometry},
          {"laser_changes", laser_changes},
          {"refused", refused},
          {"skipped", tally.skipped},
          {"visits", state->visit_count},
          {"visits_dropped", {{"incomplete", places.dropped_incomplete}}},
          {"turn_arounds", places.turn_arounds},
          {"places", state->places.size()},
          {"paths", state->path_count},
          {"closures", state->closure_count},
          {"hypotheses", state->live_count},
          {"best_probability", state->probability},
          {"guarantee_given_up_at", state->guarantee_given_up_at},
          {"guarantee_reason", state->guarantee_reason},
          {"log_s", log_s},
          {"spent_s", spent_s},
          {"seconds",
           {{"joining", clock.seconds(Stage::kJoining)},
            {"local_mapping", clock.seconds(Stage::kLocalMapping)},
            {"places", clock.seconds(Stage::kPlaces)},
            {"topology", clock.seconds(Stage::kTopology)},
            {"layout", clock.seconds(Stage::kLayout)},
            {"refinement", tally.refine_s},
            {"global_map", tally.draw_s},
            {"storage", tally.store_s}}}};
}

std::string counts_text(const Json& counts) {
  std::string text;
  for (const auto& [name, value] : counts.items()) {
    text += (text.empty() ? "" : ", ") + name + " " + value.dump();
  }
  return text.empty() ? "none" : text;
}

void print_text(const Json& summary) {
  const auto line = [](const char* name, const std::string& text) {
    static_cast<void>(std::printf("%-12s %s\n", name, text.c_str()));
  };
  const auto number = [&summary](const char* key) { return summary[key].dump(); };
  line("scans", number("scans") + ", matched " + number("matched") + " (" +
                    counts_text(summary["fixes"]) + ")");
  const Json& localisation = summary["localisation"];
  line("localisation", "lost " + localisation["times_lost"].dump() + " times, " +
                           localisation["local_map_restarts"].dump() + " new local maps, " +
                           localisation["scans_not_mapped"].dump() +
                           " scans not mapped; states: " + counts_text(localisation["states"]));
  line("faults", counts_text(localisation["faults"]));
  line("relocalised", counts_text(localisation["relocalised"]));
  line("stamps", number("repeated_stamps") + " repeated and " + number("out_of_order") +
                     " out of order (used), " + number("duplicate_scans_dropped") +
                     " duplicates and " + number("stray_stamps_dropped") +
                     " stray stamps (dropped), " + number("clock_steps") + " clock steps, " +
                     number("gaps") + " gaps, " + number("scans_without_odometry") +
                     " scans without odometry");
  line("refused", counts_text(summary["refused"]));
  line("skipped", counts_text(summary["skipped"]));
  line("visits", number("visits") + " (dropped: " + counts_text(summary["visits_dropped"]) +
                     "; turned around: " + number("turn_arounds") + ")");
  line("places", number("places") + " on " + number("paths") + " paths, " + number("closures") +
                     " loop closures");
  const bool is_kept = summary["guarantee_given_up_at"].get<std::int64_t>() < 0;
  line("hypotheses", number("hypotheses") + " alive, the best has probability " +
                         number("best_probability") + "; guarantee " +
                         (is_kept ? "kept"
                                  : "given up at visit " + number("guarantee_given_up_at") + ": " +
                                        summary["guarantee_reason"].get<std::string>()));
  line("seconds", counts_text(summary["seconds"]));
  const double log_s = summary["log_s"].get<double>();
  const double spent_s = summary["spent_s"].get<double>();
  static_cast<void>(std::printf("%-12s %.1f s of log in %.2f s: %.0f times real time\n", "speed",
                                log_s, spent_s, spent_s > 0.0 ? log_s / spent_s : 0.0));
}

Status check_is_new(const std::string& map_file) {
  std::error_code ignored;
  if (std::filesystem::exists(map_file, ignored) &&
      std::filesystem::file_size(map_file, ignored) > 0) {
    return Error{ErrorCode::kUnavailable,
                 map_file +
                     " is there already, and a replay never writes over a map: remove it or "
                     "choose another name"};
  }
  return {};
}

/// The file and what SQLite keeps beside it.
void remove_map(const std::string& map_file) {
  for (const char* const ending : {"", "-wal", "-shm"}) {
    std::error_code ignored;
    std::filesystem::remove(map_file + ending, ignored);
  }
}

void complain(const std::string& message) {
  static_cast<void>(std::fprintf(stderr, "cairnd: %s\n", message.c_str()));
}

}  // namespace

ExitCode replay(const DaemonOptions& options,
                const std::vector<std::string>& logs,
                const std::string& map_file,
                bool as_json) {
  const Clock::time_point start = Clock::now();
  if (const Status status = check_is_new(map_file); !status) {
    complain(status.error().message);
    return ExitCode::kCannotCreate;
  }
  for (const std::string& log : logs) {
    // Before a file is made: a wrong name should leave nothing behind.
    if (const auto reader = wire::LogReader::open(log); !reader) {
      complain(reader.error());
      return ExitCode::kBadData;
    }
  }
  Result<std::unique_ptr<Engine>> engine = Engine::open(options.service, map_file);
  if (!engine) {
    complain(engine.error().message);
    return ExitCode::kCannotCreate;
  }
  Replay replay(options, engine->get());
  bool is_sound = true;
  for (const std::string& log : logs) {
    is_sound = replay.run(log) && is_sound;
  }
  const Status stored = replay.finish();
  const Json summary = summary_of(replay, **engine, seconds_since(start));
  if (as_json) {
    static_cast<void>(std::printf("%s\n", summary.dump(2).c_str()));
  } else {
    print_text(summary);
  }
  for (const std::string& trouble : replay.tally().troubles) {
    complain(trouble);
  }
  if (!stored) {
    complain(stored.error().message);
    return ExitCode::kCannotCreate;
  }
  if (replay.tally().scans == 0) {
    complain("no scan in " + logs.front() + (logs.size() > 1 ? " and the others" : "") +
             ", on any channel that the configuration names as a laser's");
    // Nothing is in it, and it would stand in the way of the next replay.
    engine->reset();
    remove_map(map_file);
    return ExitCode::kBadData;
  }
  return is_sound ? ExitCode::kOk : ExitCode::kBadData;
}

}  // namespace cairn
