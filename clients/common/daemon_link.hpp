#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <cairn_lcm/assert_request_t.hpp>
#include <cairn_lcm/assertion_report_t.hpp>
#include <cairn_lcm/explain_request_t.hpp>
#include <cairn_lcm/explanation_t.hpp>
#include <cairn_lcm/name_request_t.hpp>
#include <cairn_lcm/perception_request_t.hpp>
#include <cairn_lcm/perception_t.hpp>
#include <cairn_lcm/plan_request_t.hpp>
#include <cairn_lcm/plan_t.hpp>
#include <cairn_lcm/status_t.hpp>

#include "clients/common/failure.hpp"
#include "clients/common/map_source.hpp"
#include "wire/bus.hpp"

namespace cairn::wire {
class DocumentFetch;
}  // namespace cairn::wire

namespace cairn::clients {

/// How to reach the daemon.
struct LinkOptions {
  std::string lcm_url;   ///< Empty: LCM_DEFAULT_URL, else this machine's multicast.
  double timeout_s = 3;  ///< To wait for the first sign of a daemon. > 0
};

/// A daemon reached over LCM. Subscribes first, asks afterwards, and asks again where the bus loses
/// a message.
class DaemonLink final : public MapSource {
 public:
  /// Throws Failure(kConfiguration) if the bus cannot be opened.
  explicit DaemonLink(const LinkOptions& options);
  /// For tests: over a bus that is shared with the other side.
  /// @param between called while waiting, to let the other side work
  DaemonLink(const LinkOptions& options, wire::Bus& bus, std::function<void()> between);
  ~DaemonLink() override;

  [[nodiscard]] cairn_lcm::topology_t topology() override;
  [[nodiscard]] cairn_lcm::hypotheses_t hypotheses() override;
  [[nodiscard]] cairn_lcm::grid_map_t global_map() override;
  [[nodiscard]] cairn_lcm::trajectory_t trajectory() override;
  [[nodiscard]] cairn_lcm::assertions_t assertions() override;

  [[nodiscard]] cairn_lcm::visit_places_t visit_places() override;
  [[nodiscard]] cairn_lcm::perceived_place_t perceived_place(std::int64_t visit) override;
  /// Waits for as long as the daemon draws; kBadData where no such hypothesis is live.
  [[nodiscard]] cairn_lcm::hypothesis_map_t hypothesis_map(std::int64_t hypothesis_id) override;

  /// The next heartbeat.
  [[nodiscard]] cairn_lcm::status_t status();
  /// A way; the header is filled in here. The answer's result says if there is none.
  [[nodiscard]] cairn_lcm::plan_t plan(cairn_lcm::plan_request_t request);
  /// Gives a place a name; an empty one takes it away.
  [[nodiscard]] cairn_lcm::result_t name_place(std::int64_t place, const std::string& name);

  /// Says that places are one or are not, or takes it back. What it did, or why it was not done.
  [[nodiscard]] cairn_lcm::assertion_report_t say(cairn_lcm::assert_request_t request);
  [[nodiscard]] cairn_lcm::explanation_t explain(cairn_lcm::explain_request_t request);

  [[nodiscard]] wire::Bus& bus() { return *bus_; }
  /// Serves the bus for at most that long. Throws Failure(kNoService) when the bus is gone.
  void handle(std::chrono::milliseconds at_most);
  /// What to tell a person when nobody answers.
  [[nodiscard]] Failure no_daemon() const;

 private:
  struct Inbox;

  void subscribe();
  [[nodiscard]] std::vector<std::uint8_t> fetch(std::int32_t what,
                                                const std::string& name,
                                                std::int64_t hypothesis_id);
  void wait_for(wire::DocumentFetch& fetch, const std::string& name);
  /// Of an answer in place of the document. Throws Failure for a refusal.
  /// @return whether the daemon works on it
  [[nodiscard]] bool is_at_work(const std::string& name, std::string* busy_with);
  /// Asks until there is an answer, and waits for as long as the daemon works on it.
  template <typename Answer, typename Request>
  [[nodiscard]] Answer ask(const std::string& channel, Request request);
  template <typename Message>
  [[nodiscard]] Message document(std::int32_t what,
                                 const std::string& name,
                                 std::int64_t hypothesis_id = 0);

  LinkOptions options_;
  std::unique_ptr<wire::Bus> own_bus_;
  wire::Bus* bus_;
  std::function<void()> between_;
  std::unique_ptr<Inbox> inbox_;
};

/// A new client id: random, never 0.
[[nodiscard]] std::int64_t random_client_id();
/// Microseconds of a clock that never steps.
[[nodiscard]] std::int64_t steady_us();
/// Microseconds since the epoch.
[[nodiscard]] std::int64_t now_utime();

}  // namespace cairn::clients
