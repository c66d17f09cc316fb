#include "look/ribbon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_rviz::look {
namespace {

constexpr double kWidth = 0.19;  // m, half

double distance(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& line) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector2d leg = line[i] - line[i - 1];
    const double along = std::clamp((point - line[i - 1]).dot(leg) / leg.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (point - line[i - 1] - along * leg).norm());
  }
  return least;
}

bool covers(const visualization_msgs::Marker& list, const Eigen::Vector2d& point) {
  const auto side = [&](std::size_t a, std::size_t b) {
    const auto &p = list.points[a], &q = list.points[b];
    return (q.x - p.x) * (point.y() - p.y) - (q.y - p.y) * (point.x() - p.x);
  };
  for (std::size_t i = 0; i + 3 <= list.points.size(); i += 3) {
    const double a = side(i, i + 1), b = side(i + 1, i + 2), c = side(i + 2, i);
    if (std::min({a, b, c}) >= -1e-12 || std::max({a, b, c}) <= 1e-12) return true;
  }
  return false;
}

TEST(Ribbon, neither_pinches_nor_splits_at_any_corner) {
  for (int degrees = -170; degrees <= 170; degrees += 10) {
    const double turn = degrees * M_PI / 180.0;
    const std::vector<Eigen::Vector2d> line =
        rounded({{0.0, 0.0}, {3.0, 0.0}, {3.0 + 3.0 * std::cos(turn), 3.0 * std::sin(turn)}});
    visualization_msgs::Marker list;
    add_ribbon(line, -kWidth, kWidth, 0.0, {1.0F, 1.0F, 1.0F}, list);
    // Whatever is nearer to the line than 9/10 of its half width is covered, but at its two ends.
    for (double x = 1.0; x <= 4.0; x += 0.021) {
      for (double y = -2.0; y <= 2.0; y += 0.021) {
        const Eigen::Vector2d point(x, y);
        if ((point - line.back()).norm() < 0.4 || distance(point, line) > 0.9 * kWidth) continue;
        ASSERT_TRUE(covers(list, point)) << degrees << " degrees, at " << point.transpose();
      }
    }
  }
}

TEST(Ribbon, keeps_the_ends_and_drops_what_repeats) {
  const std::vector<Eigen::Vector2d> line =
      rounded({{0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {1.0, 5.0}});
  EXPECT_EQ(line.front(), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(line.back(), Eigen::Vector2d(1.0, 5.0));
  EXPECT_TRUE(rounded({}).empty());
  visualization_msgs::Marker list;
  add_borders({}, 0.1, 0.2, 0.0, {}, list);
  add_borders({{1.0, 1.0}}, 0.1, 0.2, 0.0, {}, list);
  EXPECT_TRUE(list.points.empty());
}

}  // namespace
}  // namespace navvi_rviz::look
