#include "navvi_sim/occupancy/slice.hpp"

#include <gtest/gtest.h>

#include "navvi_sim/occupancy/occupancy.hpp"

namespace navvi_sim::occupancy {
namespace {

TEST(Slice, shows_the_floor_and_what_reaches_the_height) {
  for (const double floor : {0.0, -1.5}) {
    WorldDescription world{"hall", floor, {}, {}};
    const auto add = [&](const char* name, double x, double bottom, double tall, double wide) {
      Thing thing;
      thing.name = name;
      thing.pose.translation() = Eigen::Vector3d(x, 0.0, floor + bottom + 0.5 * tall);
      thing.shapes = {{Box{{wide, wide, tall}}}};
      world.things.push_back(thing);
    };
    add("ground", 0.0, -0.1, 0.1, 6.0);
    add("box", 1.0, 0.0, 0.5, 0.2);
    add("pedestal", -1.0, 0.0, 0.1, 0.2);
    add("table", 0.0, 0.7, 0.05, 0.4);
    const Slice slice = slice_of(occupancy_of(world, OccupancyConfig()), floor, 0.12);
    ASSERT_EQ(slice.width, 120);
    ASSERT_EQ(slice.height, 120);
    EXPECT_NEAR(slice.origin.x(), -3.0, 1e-9);
    const auto at = [&](double x, double y) {
      return slice.cells[static_cast<std::size_t>((y - slice.origin.y()) / 0.05) * 120 +
                         static_cast<std::size_t>((x - slice.origin.x()) / 0.05)];
    };
    EXPECT_EQ(at(1.01, 0.01), 100);
    EXPECT_EQ(at(-1.01, 0.01), 0) << "too low for the plane";
    EXPECT_EQ(at(0.01, 0.01), 0) << "above the plane";
    EXPECT_EQ(std::count(slice.cells.begin(), slice.cells.end(), 100), 16);
  }
}

TEST(Slice, of_nothing_is_nothing) { EXPECT_TRUE(slice_of({0.05, {}}, 0.0, 0.1).cells.empty()); }

}  // namespace
}  // namespace navvi_sim::occupancy
