#include "description/footprint.hpp"

#include <gtest/gtest.h>

namespace navvi_sim {
namespace {

TEST(Ground, holds_a_point_exactly_where_the_two_overlap) {
  const std::vector<Polygon> polygons = {
      {}, {{1, 1}}, {{0, 0}, {2, 1}}, convex_hull({{0, 0}, {3, 0}, {3, 2}, {1, 4}, {0, 2}})};
  Random random(1);
  for (const Polygon& polygon : polygons) {
    const Ground ground(polygon);
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector2d point(0.25 * static_cast<double>(random.below(24)) - 1.0,
                                  0.25 * static_cast<double>(random.below(24)) - 1.0);
      for (const double gap : {0.0, 0.5}) {
        const auto [low, high] = ground.along_x(point.y(), gap);
        ASSERT_EQ(ground.holds(point, gap), overlap(polygon, {point}, gap)) << point.transpose();
        if (ground.holds(point, gap)) {
          ASSERT_TRUE(point.x() > low - 1e-9 && point.x() < high + 1e-9) << point.transpose();
        }
      }
    }
  }
}

}  // namespace
}  // namespace navvi_sim
