// Floor plans with true rooms, without and with furniture.

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "bench/lab/rooms_score.hpp"
#include "support/recorded_data.hpp"

namespace cairn::lab {
namespace {

const std::vector<std::string> kMaps = {"Freiburg52_scan", "lab_a_scan", "lab_b_scan", "lab_c_scan",
                                        "lab_d_scan",      "office_a",   "office_b",   "office_c",
                                        "office_d",        "office_e"};

RoomsScore mean_score(const std::string& ending) {
  RoomsScore mean;
  for (const std::string& name : kMaps) {
    SCOPED_TRACE(name);
    const auto file = [&](const std::string& end) {
      return test::recorded_data("maps/rooms/" + name + end + ".png");
    };
    const RegionGraph graph =
        region_graph(grid_of(read_grey_picture(file(ending)), 0.05), RegionOptions{});
    const RoomsScore score =
        score_of(graph, true_rooms(read_grey_picture(file("_gt_segmentation"))));
    EXPECT_GT(score.recall, 85.0);
    EXPECT_GT(score.precision, 85.0);
    const double share = 1.0 / static_cast<double>(kMaps.size());
    mean.recall += share * score.recall;
    mean.credited_recall += share * score.credited_recall;
    mean.precision += share * score.precision;
  }
  return mean;
}

TEST(RecordedFloors, HaveTheirRoomsFound) {
  CAIRN_NEED_DATA("maps/rooms");
  const RoomsScore mean = mean_score("");
  EXPECT_GT(mean.recall, 98.5);
  EXPECT_GT(mean.credited_recall, 95.0);
  EXPECT_GT(mean.precision, 97.0);
}

TEST(RecordedFloors, HaveTheirRoomsFoundBehindFurniture) {
  CAIRN_NEED_DATA("maps/rooms");
  const RoomsScore mean = mean_score("_furnitures");
  EXPECT_GT(mean.recall, 93.5);
  EXPECT_GT(mean.credited_recall, 90.0);
  EXPECT_GT(mean.precision, 97.0);
}

}  // namespace
}  // namespace cairn::lab
