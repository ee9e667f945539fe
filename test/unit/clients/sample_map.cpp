#include "unit/clients/sample_map.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <cairn_lcm/snapshot_request_t.hpp>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "support/sqlite.hpp"
#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn::clients {
namespace {

constexpr double kCell = 0.05;
constexpr int kTileCells = 64;
constexpr double kPi = std::numbers::pi;

/// Free floor: an axis-parallel rectangle in metres.
struct Floor {
  double left;
  double bottom;
  double right;
  double top;
};
constexpr std::array<Floor, 6> kFloors{{{-1, -1, 17, 1},
                                        {-1, 9, 17, 11},
                                        {-1, -1, 1, 11},
                                        {15, -1, 17, 11},
                                        {17, -0.8, 22, 0.8},
                                        {22, -3, 28, 3}}};

bool is_floor(double x, double y) {
  for (const Floor& f : kFloors) {
    if (x > f.left && x < f.right && y > f.bottom && y < f.top) {
      return true;
    }
  }
  return false;
}

// Floor is free, what lies within one cell of it is wall, all else unknown.
std::uint8_t cell_at(double x, double y) {
  if (is_floor(x, y)) {
    return 4;
  }
  for (const double dx : {-1.5, 0.0, 1.5}) {
    for (const double dy : {-1.5, 0.0, 1.5}) {
      if (is_floor(x + dx * kCell, y + dy * kCell)) {
        return 97;
      }
    }
  }
  return 255;
}

cairn_lcm::tile_t tile_at(int tile_x, int tile_y) {
  cairn_lcm::tile_t tile;
  tile.tile_x = tile_x;
  tile.tile_y = tile_y;
  tile.num_cells = kTileCells * kTileCells;
  for (int y = 0; y < kTileCells; ++y) {
    for (int x = 0; x < kTileCells; ++x) {
      tile.cells.push_back(cell_at((tile_x * kTileCells + x + 0.5) * kCell,
                                   (tile_y * kTileCells + y + 0.5) * kCell));
    }
  }
  return tile;
}

cairn_lcm::gateway_t gateway(double bearing, std::int64_t path, bool is_pending = false) {
  return {1.2 * std::cos(bearing), 1.2 * std::sin(bearing), bearing, 1.9, is_pending ? 1 : 0, path};
}

cairn_lcm::place_t place(std::int64_t id,
                         const char* name,
                         double x,
                         double y,
                         const std::vector<cairn_lcm::gateway_t>& gateways) {
  cairn_lcm::place_t p{};
  p.id = id;
  p.name = name;
  p.x_m = x;
  p.y_m = y;
  p.star = "[1+ 2-]";
  p.num_visits = static_cast<std::int32_t>(id);
  p.num_gateways = static_cast<std::int32_t>(gateways.size());
  p.gateways = gateways;
  return p;
}

cairn_lcm::segment_t segment(std::int64_t from,
                             std::int32_t from_gateway,
                             std::int64_t to,
                             std::int32_t to_gateway) {
  cairn_lcm::segment_t s{};
  s.from_place = from;
  s.from_gateway = from_gateway;
  s.to_place = to;
  s.to_gateway = to_gateway;
  s.num_travels = 2;
  s.length_m = 10.0;
  return s;
}

void store_perceived(sqlite3* database, const cairn_lcm::perceived_place_t& perceived) {
  const wire::Bytes bytes = wire::to_document(perceived);
  sqlite3_stmt* statement = nullptr;
  ASSERT_EQ(
      sqlite3_prepare_v2(database, "INSERT INTO perception VALUES (?, ?)", -1, &statement, nullptr),
      SQLITE_OK);
  sqlite3_bind_int64(statement, 1, perceived.visit);
  sqlite3_bind_blob(statement, 2, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT);
  EXPECT_EQ(sqlite3_step(statement), SQLITE_DONE);
  sqlite3_finalize(statement);
}

template <typename Message>
void store(sqlite3* database, std::int32_t what, const Message& message) {
  const wire::Bytes bytes = wire::to_document(message);
  sqlite3_stmt* statement = nullptr;
  ASSERT_EQ(sqlite3_prepare_v2(database, "INSERT INTO document VALUES (?, ?, ?)", -1, &statement,
                               nullptr),
            SQLITE_OK);
  sqlite3_bind_int(statement, 1, what);
  sqlite3_bind_int64(statement, 2, message.revision);
  sqlite3_bind_blob(statement, 3, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT);
  EXPECT_EQ(sqlite3_step(statement), SQLITE_DONE);
  sqlite3_finalize(statement);
}

}  // namespace

cairn_lcm::grid_map_t sample_grid() {
  cairn_lcm::grid_map_t map{};
  map.map_id = 7;
  map.revision = 31;
  map.cell_m = kCell;
  map.tile_cells = kTileCells;
  for (int y = -2; y < 4; ++y) {
    for (int x = -1; x < 10; ++x) {
      map.tiles.push_back(tile_at(x, y));
    }
  }
  map.num_tiles = static_cast<std::int32_t>(map.tiles.size());
  return map;
}

cairn_lcm::topology_t sample_topology() {
  cairn_lcm::topology_t map{};
  map.map_id = 7;
  map.revision = 12;
  map.hypothesis_id = 3;
  map.probability = 0.75;
  map.at_place = 5;
  map.num_paths = 5;
  // Clockwise from north.
  map.places = {place(1, "", 0, 0, {gateway(kPi / 2, 1), gateway(0, 0)}),
                place(2, "", 16, 0, {gateway(kPi / 2, 2), gateway(0, 0), gateway(kPi, 0)}),
                place(3, "", 16, 10, {gateway(-kPi / 2, 2), gateway(kPi, 3)}),
                place(4, "", 0, 10, {gateway(0, 3), gateway(-kPi / 2, 1), gateway(kPi, 4, true)}),
                place(5, "B\xC3\xBCro & Lab", 25, 0, {gateway(kPi, 0)})};
  map.num_places = 5;
  map.segments = {segment(1, 1, 2, 2), segment(2, 0, 3, 0), segment(3, 1, 4, 0),
                  segment(4, 1, 1, 0), segment(2, 1, 5, 0)};
  map.num_segments = 5;
  for (cairn_lcm::segment_t& checked : map.segments) {
    checked.disagreeing_visit = -1;
  }
  map.segments[0].disagreeing_visit = 1;
  map.segments[0].disagreement_sigmas = 0.7;
  map.segments[3].disagreeing_visit = 5;
  map.segments[3].disagreement_sigmas = 4.2;
  return map;
}

cairn_lcm::hypotheses_t sample_hypotheses() {
  cairn_lcm::hypotheses_t h{};
  h.map_id = 7;
  h.revision = 12;
  h.num_visits = 9;
  h.num_live = 2;
  h.num_waiting = 17;
  h.num_refuted = 41;
  h.blamed = "visit 4: misread star";
  h.guarantee_given_up_at = -1;
  h.num_hypotheses = 2;
  h.id = {3, 8};
  h.parent_id = {1, 1};
  h.log_posterior = {-10.5, -11.6};
  h.probability = {0.75, 0.25};
  h.num_places = {5, 6};
  h.num_paths = {5, 6};
  h.num_closures = {1, 0};
  h.num_pending = {1, 3};
  return h;
}

cairn_lcm::assertions_t sample_assertions() {
  cairn_lcm::assertions_t all{};
  all.map_id = 7;
  all.revision = 12;
  all.num_assertions = 2;
  cairn_lcm::assertion_t one{};
  one.number = 1;
  one.is_same = 1;
  one.visit_a = 2;
  one.visit_b = 7;
  one.place_a = one.place_b = 3;
  one.who = "alice";
  one.made_utime = 1'700'000'000'000'000;
  one.made_after_visits = 8;
  one.effect = "the best map stays as it was";
  one.retracted_by = "bob";
  one.retracted_utime = 1'700'000'060'000'000;
  one.retracted_after_visits = 9;
  all.assertions.push_back(one);
  one.number = 2;
  one.is_same = 0;
  one.is_in_force = 1;
  one.place_b = 5;
  one.retracted_by.clear();
  one.retracted_utime = 0;
  one.retracted_after_visits = -1;
  all.assertions.push_back(one);
  return all;
}

cairn_lcm::trajectory_t sample_trajectory() {
  cairn_lcm::trajectory_t t{};
  t.map_id = 7;
  t.revision = 31;
  for (int i = 0; i <= 250; ++i) {
    const double s = 0.1 * i;
    t.pose_utime.push_back(1'700'000'000'000'001 + i * 100'000);
    t.x_m.push_back(s);
    t.y_m.push_back(0.3 * std::sin(s));
    t.theta_rad.push_back(0.3 * std::cos(s));
  }
  t.num_poses = static_cast<std::int32_t>(t.x_m.size());
  t.key_utime = {t.pose_utime.front(), t.pose_utime.back()};
  t.num_key_poses = 2;
  t.covariance_m2_rad2 = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.01, 0.002, 0.02, 0.0, 0.0, 0.003};
  t.num_covariance_entries = 12;
  return t;
}

cairn_lcm::status_t sample_status() {
  cairn_lcm::status_t s{};
  s.boot_id = 99;
  s.version = "0.1.0";
  s.state = cairn_lcm::status_t::MAPPING;
  s.state_name = "MAPPING";
  s.map_id = 7;
  s.event_number = 4;
  s.num_places = 5;
  s.num_visits = 9;
  s.num_hypotheses = 2;
  s.num_waiting = 17;
  s.blamed = "visit 4: misread star";
  s.best_probability = 0.75;
  s.is_localized = 1;
  s.is_guarantee_kept = 1;
  s.guarantee_given_up_at = -1;
  s.scans_received = 1234;
  s.scan_age_ms = 50;
  s.odometry_age_ms = -1;
  return s;
}

cairn_lcm::visit_places_t sample_visits() {
  cairn_lcm::visit_places_t visits{};
  visits.map_id = 7;
  visits.revision = 12;
  visits.place_id = {1, 2, 3, 4, 5, 1};
  visits.num_visits = 6;
  return visits;
}

cairn_lcm::perceived_place_t sample_perceived(std::int64_t visit) {
  const std::int64_t place_id = sample_visits().place_id.at(static_cast<std::size_t>(visit));
  const cairn_lcm::place_t place = sample_topology().places[static_cast<std::size_t>(place_id) - 1];
  cairn_lcm::perceived_place_t p{};
  p.visit = visit;
  p.place_id = -1;
  p.entered_utime = 1'700'000'000'000'000;
  p.left_utime = 1'700'000'005'000'000;
  p.departure_gateway = -1;
  p.distinctiveness_share = 0.5;
  p.star = "((PF1+, (gw1,out), MIDLINE),\n(PF1-, (gw1,in), DEADEND))";
  for (const cairn_lcm::gateway_t& gateway : place.gateways) {
    cairn_lcm::opening_t opening{};
    opening.x_m = gateway.x_m;
    opening.y_m = gateway.y_m;
    opening.bearing_rad = gateway.bearing_rad;
    opening.width_m = gateway.width_m;
    opening.gateway = static_cast<std::int32_t>(p.openings.size());
    opening.state_name = "gateway";
    opening.reason = "driven through";
    p.fragment_from.push_back(opening.gateway);
    p.fragment_through.push_back(-1);
    p.openings.push_back(opening);
  }
  cairn_lcm::opening_t alcove{};
  alcove.gateway = -1;
  alcove.state = cairn_lcm::opening_t::REJECTED;
  alcove.state_name = "rejected";
  alcove.reason = "blind alcove";
  p.openings.push_back(alcove);
  p.num_openings = static_cast<std::int32_t>(p.openings.size());
  p.num_fragments = static_cast<std::int32_t>(p.fragment_from.size());
  p.axis_x_m = {-1.0F, 0.0F, 1.0F};
  p.axis_y_m = {0.0F, 0.0F, 0.5F};
  p.num_axis_points = 3;
  p.axis_line_points = {3};
  p.num_axis_lines = 1;
  p.cell_m = 0.1;
  p.origin_x_m = p.origin_y_m = -2.0;
  p.width = p.height = 40;
  p.cells.assign(1600, 0);
  p.num_cells = 1600;
  return p;
}

cairn_lcm::hypothesis_map_t sample_hypothesis_map() {
  cairn_lcm::hypothesis_map_t map{};
  map.map_id = 7;
  map.revision = 12;
  map.hypothesis_id = 8;
  map.topology = sample_topology();
  map.topology.hypothesis_id = 8;
  map.topology.probability = 0.25;
  map.topology.places.back().name = "annexe";
  map.global_map = sample_grid();
  map.trajectory = sample_trajectory();
  map.visits = sample_visits();
  return map;
}

void write_sample_map(const std::filesystem::path& path) {
  test::run_sql(path,
                "PRAGMA journal_mode = WAL;"
                "CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT);"
                "CREATE TABLE document (what INTEGER PRIMARY KEY, revision INTEGER NOT NULL,"
                "                       bytes BLOB NOT NULL);"
                "CREATE TABLE visit (id INTEGER PRIMARY KEY);"
                "INSERT INTO meta VALUES ('application', 'cairn'), ('format_version', '3'),"
                "                        ('map_id', '7');"
                "INSERT INTO visit VALUES (1), (2), (3);");
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  store(database, cairn_lcm::snapshot_request_t::GLOBAL_MAP, sample_grid());
  store(database, cairn_lcm::snapshot_request_t::TOPOLOGY, sample_topology());
  store(database, cairn_lcm::snapshot_request_t::HYPOTHESES, sample_hypotheses());
  store(database, cairn_lcm::snapshot_request_t::VISITS, sample_visits());
  test::run_sql(path, "CREATE TABLE perception(visit INTEGER PRIMARY KEY, bytes BLOB NOT NULL)");
  for (std::int64_t visit = 0; visit < sample_visits().num_visits; ++visit) {
    store_perceived(database, sample_perceived(visit));
  }
  store(database, cairn_lcm::snapshot_request_t::TRAJECTORY, sample_trajectory());
  sqlite3_close(database);
}

}  // namespace cairn::clients
