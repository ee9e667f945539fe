#include <cmath>
#include <csignal>
#include <cstring>
#include <tuple>

#include <cairn_lcm/frame_change_t.hpp>
#include <cairn_lcm/place_event_t.hpp>
#include <cairn_lcm/pose_t.hpp>

#include "clients/cairn/commands.hpp"
#include "clients/cairn/event_follower.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/json.hpp"
#include "clients/common/planar_pose.hpp"
#include "clients/common/subscribe.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

constexpr double kStepM = 0.25;   // A pose is news after that much of a way,
constexpr double kTurnRad = 0.2;  // or that much of a turn.
constexpr std::chrono::milliseconds kTick{50};

volatile std::sig_atomic_t stop_requested = 0;
void request_stop(int /*signal*/) {
  stop_requested = 1;
}

struct WatchOptions {
  LinkOptions link;
  bool as_json = false;
  std::int64_t count = 0;
};

std::string clock_text(std::int64_t utime) {
  const std::int64_t milliseconds = utime / 1'000;
  const std::string fraction = std::to_string(1'000 + milliseconds % 1'000).substr(1);
  return std::to_string(milliseconds / 1'000) + "." + fraction;
}

std::string pose_text(double x_m, double y_m, double theta_rad) {
  return "(" + fixed(x_m, 2) + " m, " + fixed(y_m, 2) + " m, " + degrees(theta_rad) + " deg)";
}

/// Prints one line for every change.
class Watcher {
 public:
  Watcher(const WatchOptions& options, const Streams& streams)
      : options_(options), streams_(streams), link_(options.link), events_(make_follower()) {
    subscribe<cairn_lcm::place_event_t>(link_.bus(), "CAIRN_PLACE_EVENT",
                                        [this](const cairn_lcm::place_event_t& event) {
                                          is_heard_ = true;
                                          events_.on_event(event);
                                        });
    subscribe<cairn_lcm::frame_change_t>(link_.bus(), "CAIRN_FRAME_CHANGE",
                                         [this](const cairn_lcm::frame_change_t& change) {
                                           is_heard_ = true;
                                           on_frame_change(change);
                                         });
    subscribe<cairn_lcm::pose_t>(link_.bus(), "CAIRN_POSE", [this](const cairn_lcm::pose_t& pose) {
      is_heard_ = true;
      on_pose(pose);
    });
    subscribe<cairn_lcm::status_t>(link_.bus(), "CAIRN_STATUS",
                                   [this](const cairn_lcm::status_t& status) {
                                     is_heard_ = true;
                                     on_status(status);
                                   });
  }

  void run() {
    const std::int64_t begin_us = steady_us();
    while (stop_requested == 0 && !is_done()) {
      link_.handle(kTick);
      events_.tick(steady_us());
      const double waited_s = static_cast<double>(steady_us() - begin_us) * 1e-6;
      if (!is_heard_ && waited_s > options_.link.timeout_s) {
        throw link_.no_daemon();
      }
    }
  }

 private:
  [[nodiscard]] bool is_done() const {
    return (options_.count > 0 && printed_ >= options_.count) || !streams_.out;
  }

  EventFollower make_follower() {
    const std::int64_t client_id = random_client_id();
    return EventFollower([this](const cairn_lcm::place_event_t& event) { on_event(event); },
                         [this, client_id](std::int64_t have) {
                           cairn_lcm::event_request_t request{};
                           request.header = {now_utime(), client_id, ++requests_, 0};
                           request.have_event_number = have;
                           link_.bus().publish("CAIRN_REQUEST_EVENTS", request);
                         },
                         [this](std::int64_t first, std::int64_t last) {
                           streams_.err << "cairn: events " << first << " to " << last
                                        << " are lost\n";
                         });
  }

  void print(std::int64_t utime,
             const char* what,
             const std::string& text,
             const nlohmann::ordered_json& json) {
    if (is_done()) {
      return;
    }
    if (options_.as_json) {
      streams_.out << dumped_line({{"what", what}, {"message", json}}) << std::endl;
    } else {
      const std::string column = std::string(what) + std::string(8 - std::strlen(what), ' ');
      streams_.out << clock_text(utime) << "  " << column << text << std::endl;
    }
    ++printed_;
  }

  void on_event(const cairn_lcm::place_event_t& event) {
    std::string text = std::to_string(event.event_number) + " " + printable(event.kind_name);
    if (event.place_id >= 0) {
      text += " place " + std::to_string(event.place_id);
    }
    if (!event.reason.empty()) {
      text += ": " + printable(event.reason);
    }
    print(event.utime, "event", text, to_json(event));
  }

  void on_frame_change(const cairn_lcm::frame_change_t& change) {
    print(change.utime, "moved",
          "map " + std::to_string(change.older_revision) + " to " +
              std::to_string(change.newer_revision) + ": " +
              std::to_string(change.place_id.size()) + " places, by " +
              fixed(change.largest_move_m, 2) + " m at most; the robot by " +
              pose_text(change.robot_dx_m, change.robot_dy_m, change.robot_dtheta_rad),
          to_json(change));
  }

  void on_status(const cairn_lcm::status_t& status) {
    events_.on_status(status.boot_id, status.event_number);
    const auto key = std::make_tuple(status.boot_id, status.state, status.reason, status.num_places,
                                     status.num_hypotheses, status.is_localized,
                                     status.is_guarantee_kept, status.blamed);
    if (last_status_ && *last_status_ == key) {
      return;
    }
    last_status_ = key;
    print(status.utime, "status",
          printable(status.state_name) +
              (status.reason.empty() ? "" : " (" + printable(status.reason) + ")") + ", " +
              std::to_string(status.num_places) + " places, " +
              std::to_string(status.num_hypotheses) + " hypotheses and " +
              std::to_string(status.num_waiting) + " waiting, " +
              (status.is_localized != 0 ? "localized" : "not localized") +
              (status.is_guarantee_kept != 0 ? "" : ", guarantee given up") +
              (status.blamed.empty() ? "" : ", blamed " + printable(status.blamed)),
          to_json(status));
  }

  void on_pose(const cairn_lcm::pose_t& pose) {
    const bool is_global = pose.is_global_known != 0;
    const PlanarPose now = is_global
                               ? PlanarPose{pose.global_x_m, pose.global_y_m, pose.global_theta_rad}
                               : PlanarPose{pose.lpm_x_m, pose.lpm_y_m, pose.lpm_theta_rad};
    if (last_pose_ && last_is_global_ == is_global && last_place_ == pose.place_id &&
        std::hypot(now.x_m - last_pose_->x_m, now.y_m - last_pose_->y_m) < kStepM &&
        std::abs(std::remainder(now.theta_rad - last_pose_->theta_rad, 2.0 * std::acos(-1.0))) <
            kTurnRad) {
      return;
    }
    last_pose_ = now;
    last_is_global_ = is_global;
    last_place_ = pose.place_id;
    print(pose.utime, "pose",
          std::string(is_global ? "global " : "local ") +
              pose_text(now.x_m, now.y_m, now.theta_rad) +
              (pose.place_id >= 0 ? " at place " + std::to_string(pose.place_id) : " travelling"),
          to_json(pose));
  }

  using StatusKey = std::tuple<std::int64_t,
                               std::int32_t,
                               std::string,
                               std::int32_t,
                               std::int32_t,
                               std::int32_t,
                               std::int32_t,
                               std::string>;

  const WatchOptions& options_;
  const Streams& streams_;
  DaemonLink link_;
  EventFollower events_;
  std::int32_t requests_ = 0;
  std::int64_t printed_ = 0;
  bool is_heard_ = false;
  std::optional<StatusKey> last_status_;
  std::optional<PlanarPose> last_pose_;
  bool last_is_global_ = false;
  std::int64_t last_place_ = -1;
};

}  // namespace

void add_watch_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand(
      "watch", "One line for each change of state, event, move of the map and step of the robot");
  const auto options = std::make_shared<WatchOptions>();
  command->add_option("--count", options->count, "Stop after that many lines [until Ctrl-C]")
      ->check(CLI::PositiveNumber);
  add_json_flag(*command, &options->as_json);
  add_link_options(*command, &options->link);
  command->callback([options, streams] {
    stop_requested = 0;
    std::signal(SIGINT, request_stop);
    std::signal(SIGTERM, request_stop);
    Watcher(*options, streams).run();
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  });
}

}  // namespace cairn::clients
