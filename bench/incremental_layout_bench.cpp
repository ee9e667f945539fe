// The layout kept up to date travel by travel. Percentiles over the steps of one run, CPU time.
//
//     incremental_layout_bench GRAPH.g2o...    the edges in the order of the later vertex
//     incremental_layout_bench --tour PLACES   a wanderer's tour of so many places, and a loop

#include "layout/incremental_layout.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <random>
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

/// A way of so many new places from the last place around a circle, back to that place.
void append_loop(int place_count, int first, std::vector<TravelConstraint>* travels) {
  constexpr int kPlaces = 1000;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Matrix3d covariance = Matrix3d::Zero();
  covariance.diagonal() << 0.0025, 0.0025, 0.0001;
  for (int i = 0; i < kPlaces; ++i) {
    const int from = i == 0 ? first : place_count + i - 1;
    const int to = i + 1 == kPlaces ? first : place_count + i;
    travels->push_back({from,
                        to,
                        {Pose2(10.0 + 0.05 * normal(random), 0.05 * normal(random),
                               2.0 * kPi / kPlaces + 0.01 * normal(random)),
                         covariance}});
  }
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

/// One loop of 1,000 new places on top of the map.
int close_a_large_loop(std::vector<TravelConstraint> travels, int place_count) {
  for (const int first : {0, place_count / 2, place_count - 1}) {
    std::vector<TravelConstraint> loop;
    append_loop(place_count, first, &loop);
    IncrementalLayout layout;
    for (const TravelConstraint& travel : in_order(travels)) {
      const bool is_new = std::max(travel.from, travel.to) == layout.place_count();
      if (!(is_new ? layout.add_place(travel) : layout.add_travel(travel))) {
        return 1;
      }
    }
    for (std::size_t i = 0; i + 1 < loop.size(); ++i) {
      if (!layout.add_place(loop[i])) {
        return 1;
      }
    }
    const int restarts_before = layout.restart_count();
    const double begin_ms = now_ms();
    const Status closed = layout.add_travel(loop.back());
    const double closed_ms = now_ms() - begin_ms;
    travels.insert(travels.end(), loop.begin(), loop.end());
    const Result<PlaceLayout> batch = solve_layout(layout.place_count(), travels);
    travels.resize(travels.size() - loop.size());
    std::printf(
        "  a loop of 1000 places at place %d closed in %.2f ms, %d restarts, chi2 %.10g, "
        "batch %.10g\n",
        first, closed ? closed_ms : -1.0, layout.restart_count() - restarts_before, layout.chi2(),
        batch ? batch->chi2 : -1.0);
  }
  return 0;
}

int feed_tour(int place_count) {
  int status = 0;
  for (const double preference : {0.9, 0.5}) {
    test::TourOptions options;
    options.place_count = place_count;
    options.preference = preference;
    const test::SimulatedTour tour = test::simulated_tour(options);
    status |= feed("tour, preference " + std::to_string(preference), tour.travels, place_count);
    if (place_count > 2000) {
      status |= close_a_large_loop(tour.travels, place_count);
    }
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
