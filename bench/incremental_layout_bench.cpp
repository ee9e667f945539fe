// The layout kept up to date travel by travel. Percentiles over the steps of one run, CPU time.
//
//     incremental_layout_bench GRAPH.g2o...    the edges in the order of the later vertex
//     incremental_layout_bench --tour PLACES   a wanderer's tour of so many places, and a loop

#include "layout/incremental_layout.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "bench/lab/pose_graph.hpp"
#include "bench/lab/resources.hpp"
#include "support/simulated_tour.hpp"

namespace cairn {
namespace {

/// CPU times of steps of one kind.
struct Times {
  std::vector<double> ms;

  void print(const char* kind) {
    if (ms.empty()) {
      return;
    }
    std::sort(ms.begin(), ms.end());
    double sum_ms = 0.0;
    for (const double one_ms : ms) {
      sum_ms += one_ms;
    }
    const auto percentile = [&](double share) {
      return ms[static_cast<std::size_t>(share * static_cast<double>(ms.size() - 1))];
    };
    std::printf("  %-18s %6zu  mean %8.4f  p50 %8.4f  p90 %8.4f  p99 %8.4f  max %8.4f ms\n", kind,
                ms.size(), sum_ms / static_cast<double>(ms.size()), percentile(0.5),
                percentile(0.9), percentile(0.99), ms.back());
  }
};

double now_ms() {
  return 1e3 * lab::cpu_time_s();
}

/// Travels ordered by their later place, so that each new place comes by one of its travels.
std::vector<TravelConstraint> in_order(std::vector<TravelConstraint> travels) {
  std::stable_sort(travels.begin(), travels.end(),
                   [](const TravelConstraint& a, const TravelConstraint& b) {
                     return std::max(a.from, a.to) < std::max(b.from, b.to);
                   });
  return travels;
}

int feed(const std::string& name, const std::vector<TravelConstraint>& travels, int place_count) {
  IncrementalLayout layout;
  Times places;
  Times closures;
  for (const TravelConstraint& travel : in_order(travels)) {
    const bool is_new = std::max(travel.from, travel.to) == layout.place_count();
    const double begin_ms = now_ms();
    const Status added = is_new ? layout.add_place(travel) : layout.add_travel(travel);
    (is_new ? places : closures).ms.push_back(now_ms() - begin_ms);
    if (!added) {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), added.error().message.c_str());
      return 1;
    }
  }
  const double begin_ms = now_ms();
  const Result<PlaceLayout> batch = solve_layout(place_count, travels);
  const double batch_ms = now_ms() - begin_ms;
  const double copy_begin_ms = now_ms();
  const IncrementalLayout copy = layout;
  const double copy_ms = now_ms() - copy_begin_ms;
  std::printf("%s: %d places, %zu travels\n", name.c_str(), copy.place_count(), travels.size());
  places.print("a new place");
  closures.print("a loop closed");
  if (batch) {
    std::printf(
        "  chi2 %.10g, batch %.10g (relative %.2g), %d restarts, %.1f places eliminated for "
        "each loop; all at once %.2f ms, a copy %.3f ms\n",
        layout.chi2(), batch->chi2, layout.chi2() / batch->chi2 - 1.0, layout.restart_count(),
        static_cast<double>(layout.eliminated_count()) /
            static_cast<double>(std::max<std::size_t>(closures.ms.size(), 1)),
        batch_ms, copy_ms);
  }
  return 0;
}

int feed_file(const std::string& file) {
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  const Result<lab::PoseGraph> graph = lab::parse_pose_graph(content.str());
  if (!graph) {
    std::fprintf(stderr, "%s: %s\n", file.c_str(), graph.error().message.c_str());
    return 1;
  }
  return feed(file.substr(file.find_last_of('/') + 1), travels_of(*graph),
              static_cast<int>(graph->ids.size()));
}

int feed_tour(int place_count) {
  int status = 0;
  for (const double preference : {0.9, 0.5}) {
    test::TourOptions options;
    options.place_count = place_count;
    options.preference = preference;
    const test::SimulatedTour tour = test::simulated_tour(options);
    status |= feed("tour, preference " + std::to_string(preference), tour.travels, place_count);
  }
  return status;
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  int status = 0;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--tour" && i + 1 < argc) {
      status |= cairn::feed_tour(std::stoi(argv[++i]));
    } else {
      status |= cairn::feed_file(argv[i]);
    }
  }
  return status;
}
