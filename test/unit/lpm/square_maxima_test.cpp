#include "lpm/square_maxima.hpp"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>

namespace cairn {
namespace {

TEST(SquareMaxima, AreTheMaximaOfTheirSquaresOnTheMapAndAroundIt) {
  std::mt19937 random(3);
  GridGeometry geometry;
  geometry.width = 23;
  geometry.height = 17;
  std::vector<std::uint8_t> values(geometry.cell_count());
  std::generate(values.begin(), values.end(),
                [&] { return static_cast<std::uint8_t>(random() % 20 == 0 ? random() % 256 : 0); });
  const SquareMaxima maxima(geometry, values);
  for (int kind = 0; kind < static_cast<int>(SquareMaxima::kSides_cells.size()); ++kind) {
    const int side = SquareMaxima::kSides_cells[static_cast<std::size_t>(kind)];
    for (int y = -40; y < 25; ++y) {
      for (int x = -40; x < 30; ++x) {
        int greatest = 0;
        for (int v = std::max(y, 0); v < std::min(y + side, geometry.height); ++v) {
          for (int u = std::max(x, 0); u < std::min(x + side, geometry.width); ++u) {
            greatest = std::max<int>(greatest, values[geometry.index_of({u, v})]);
          }
        }
        const Cell inside = maxima.inside({x, y});
        ASSERT_TRUE(maxima.is_inside(inside));
        ASSERT_EQ(maxima.values()[maxima.index_of(inside) + maxima.offset_of(kind, 0, 0)], greatest)
            << side << " at " << x << ", " << y;
      }
    }
  }
}

TEST(SquareMaxima, NamesTheSmallestKindThatIsWideEnough) {
  for (int side = 1; side <= SquareMaxima::kWidest_cells; ++side) {
    const auto kind = static_cast<std::size_t>(SquareMaxima::kind_for(side));
    EXPECT_GE(SquareMaxima::kSides_cells[kind], side);
    EXPECT_TRUE(kind == 0 || SquareMaxima::kSides_cells[kind - 1] < side);
  }
}

}  // namespace
}  // namespace cairn
