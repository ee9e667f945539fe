#include "clients/cairn/map_text.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using Gateway = std::pair<std::int64_t, std::int32_t>;  // Place, number of the gateway.

/// By gateway, where it leads: ">3" by a link, "!4" by a travel that the map does not explain.
std::map<Gateway, std::string> leads_of(const cairn_lcm::topology_t& topology) {
  std::map<Gateway, std::string> leads;
  for (const bool is_broken : {false, true}) {
    for (const cairn_lcm::segment_t& segment : topology.segments) {
      if ((segment.is_broken != 0) == is_broken) {
        const char* const sign = is_broken ? "!" : ">";
        leads[{segment.from_place, segment.from_gateway}] +=
            sign + std::to_string(segment.to_place);
        leads[{segment.to_place, segment.to_gateway}] += sign + std::to_string(segment.from_place);
      }
    }
  }
  return leads;
}

std::string gateways_text(const cairn_lcm::place_t& place,
                          const std::map<Gateway, std::string>& leads) {
  std::string text;
  for (std::size_t i = 0; i < place.gateways.size(); ++i) {
    text += (i == 0 ? "" : " ") + std::to_string(i);
    const auto lead = leads.find({place.id, static_cast<std::int32_t>(i)});
    text += place.gateways[i].is_pending != 0 ? "?" : "";
    text += lead != leads.end() ? lead->second : "";
  }
  return text;
}

std::string age(std::int32_t age_ms) {
  return age_ms < 0 ? "none yet" : duration(age_ms / 1000.0) + " ago";
}

void line(std::ostream& out, const std::string& label, const std::string& text) {
  out << label << std::string(label.size() < 13 ? 13 - label.size() : 1, ' ') << text << '\n';
}

std::string count_of(std::int64_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

std::string faults_text(const cairn_lcm::status_t& status) {
  const std::pair<std::int64_t, const char*> faults[] = {
      {status.slips, "slips"},
      {status.carryings, "liftings or pushes"},
      {status.odometry_stalls, "odometry stalls"},
      {status.scan_stalls, "scan stalls"},
      {status.bumps, "bumps"},
      {status.teleports, "odometry jumps"},
      {status.laser_reversals, "times the laser looked backward"},
      {status.laser_inversions, "times the laser was upside down"}};
  std::string text;
  for (const auto& [count, what] : faults) {
    if (count > 0) {
      text += (text.empty() ? "" : ", ") + count_of(count, what);
    }
  }
  return text.empty() ? "none" : text;
}

void print_localisation(std::ostream& out, const cairn_lcm::status_t& status) {
  line(
      out, "localisation",
      printable(status.localisation_name) +
          (status.localisation_reason.empty() ? "" : ": " + printable(status.localisation_reason)));
  line(out, "error",
       fixed(status.localisation_error_m, 2) + " m; lost above " +
           fixed(status.localisation_error_max_m, 2) + " m, found below " +
           fixed(status.localisation_error_min_m, 2) + " m; " +
           count_of(status.times_lost, "times lost, ") +
           count_of(status.local_map_restarts, "new local maps, ") +
           count_of(status.scans_not_mapped, "scans not mapped"));
  line(out, "distinctive",
       fixed(status.distinctiveness_share, 2) + " of 1: how well walls tell the pose here");
  line(out, "faults", faults_text(status));
  if (!status.relocalised.empty()) {
    line(out, "relocalised", printable(status.relocalised));
  }
}

void print_inputs(std::ostream& out, const cairn_lcm::status_t& status) {
  line(out, "scans",
       count_of(status.scans_received, "received, ") + count_of(status.scans_mapped, "mapped, ") +
           count_of(status.scans_dropped, "dropped, ") +
           count_of(status.scans_refused, "refused, ") +
           count_of(status.scans_out_of_order, "out of order, ") +
           count_of(status.laser_changes, "changes of the laser; last ") + age(status.scan_age_ms));
  line(out, "odometry",
       count_of(status.odometry_received, "received, ") +
           count_of(status.odometry_refused, "refused; last ") + age(status.odometry_age_ms) +
           (status.is_using_odometry != 0 ? "; used" : "; none used: constant velocity"));
  line(out, "bus",
       count_of(status.decode_errors, "unsound messages, ") +
           count_of(status.unknown_types, "of unknown type, ") +
           count_of(status.udp_drops, "dropped by the kernel, ") +
           count_of(status.foreign_daemons, "messages of other daemons, ") +
           count_of(status.clock_steps, "clock steps"));
  line(out, "update",
       fixed(static_cast<double>(status.update_ms_p50), 1) + " ms median, " +
           fixed(static_cast<double>(status.update_ms_max), 1) + " ms worst; " +
           fixed(static_cast<double>(status.rss_mb), 0) + " MB of memory");
}

}  // namespace

std::string guarantee_text(std::int64_t given_up_at, const std::string& reason) {
  if (given_up_at < 0) {
    return "kept: every map consistent with the visits is still among the hypotheses";
  }
  return "given up at visit " + std::to_string(given_up_at) +
         (reason.empty() ? "" : ": " + printable(reason));
}

void print_status(std::ostream& out, const cairn_lcm::status_t& status) {
  line(out, "daemon",
       "cairnd " + printable(status.version) + ", boot " + std::to_string(status.boot_id));
  line(out, "state",
       printable(status.state_name) +
           (status.reason.empty() ? "" : ": " + printable(status.reason)));
  print_localisation(out, status);
  line(out, "localized", status.is_localized != 0 ? "yes" : "no");
  line(out, "map",
       count_of(status.map_id, "") + "at revision " + std::to_string(status.map_revision) +
           ", topology " + std::to_string(status.topology_revision) + ", event " +
           std::to_string(status.event_number));
  line(out, "places", count_of(status.num_places, "in ") + count_of(status.num_visits, "visits"));
  line(out, "hypotheses",
       count_of(status.num_hypotheses, "live, the best with probability ") +
           fixed(status.best_probability, 3) + "; " + count_of(status.num_waiting, "waiting"));
  line(out, "guarantee", guarantee_text(status.guarantee_given_up_at, ""));
  if (!status.blamed.empty()) {
    line(out, "blamed", printable(status.blamed));
  }
  print_inputs(out, status);
}

void print_places(std::ostream& out, const cairn_lcm::topology_t& topology) {
  const auto on_one_line = [](std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  };
  const std::map<Gateway, std::string> leads = leads_of(topology);
  Table table({"id", "name", "x_m", "y_m", "heading_deg", "visits", "gateways", "star"});
  for (const cairn_lcm::place_t& place : topology.places) {
    table.add({std::to_string(place.id) + (place.id == topology.at_place ? "*" : ""),
               place.name.empty() ? "-" : printable(place.name), fixed(place.x_m, 2),
               fixed(place.y_m, 2), degrees(place.theta_rad), std::to_string(place.num_visits),
               gateways_text(place, leads), printable(on_one_line(place.star))});
  }
  table.print(out);
}

void print_hypotheses(std::ostream& out, const cairn_lcm::hypotheses_t& hypotheses) {
  Table table(
      {"rank", "id", "probability", "log_posterior", "places", "paths", "closures", "pending"});
  for (std::size_t i = 0; i < hypotheses.id.size(); ++i) {
    table.add({std::to_string(i + 1), std::to_string(hypotheses.id[i]),
               fixed(hypotheses.probability[i], 4), fixed(hypotheses.log_posterior[i], 3),
               std::to_string(hypotheses.num_places[i]), std::to_string(hypotheses.num_paths[i]),
               std::to_string(hypotheses.num_closures[i]),
               std::to_string(hypotheses.num_pending[i])});
  }
  table.print(out);
  const auto listed = static_cast<std::int64_t>(hypotheses.id.size());
  out << hypotheses.num_live << " live after " << hypotheses.num_visits << " visits, "
      << hypotheses.num_waiting << " waiting, " << hypotheses.num_refuted << " refuted"
      << (listed < hypotheses.num_live ? "; the best " + std::to_string(listed) + " are listed"
                                       : "")
      << '\n'
      << "guarantee "
      << guarantee_text(hypotheses.guarantee_given_up_at, hypotheses.guarantee_reason) << '\n';
  if (!hypotheses.blamed.empty()) {
    out << "blamed    " << printable(hypotheses.blamed) << '\n';
  }
}

void print_plan(std::ostream& out, const cairn_lcm::plan_t& plan) {
  std::string places;
  for (const std::int64_t place : plan.places) {
    places += (places.empty() ? "" : " > ") + std::to_string(place);
  }
  line(out, "places", places.empty() ? "none on the way" : places);
  line(out, "length", fixed(plan.length_m, 2) + " m");
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    line(out, i == 0 ? "steps" : "", std::to_string(i + 1) + ". " + printable(plan.steps[i]));
  }
  out << '\n';
  Table table({"x_m", "y_m", "heading_deg"});
  for (std::size_t i = 0; i < plan.x_m.size(); ++i) {
    table.add({fixed(plan.x_m[i], 3), fixed(plan.y_m[i], 3), degrees(plan.theta_rad[i])});
  }
  table.print(out);
}

}  // namespace cairn::clients
