#include "plan/escape.hpp"

#include <gtest/gtest.h>

#include "guide/cylinders.hpp"
#include "small_world.hpp"

namespace navvi_nav::plan {
namespace {

constexpr double kRadius = 0.35;  // m, of the robot

/// \param at, radius, length, width  m
guide::MovingThing thing(std::uint32_t id, Point at, double radius, double length = 0.0,
                         double width = 0.0) {
  guide::MovingThing thing;
  thing.id = id;
  thing.pose.position = {at.x, at.y};
  thing.radius = radius;
  thing.length = length;
  thing.width = width;
  return thing;
}

/// A room of 10 x 6 m with a forklift in it.
class Escape : public testing::Test {
 protected:
  Escape() {
    world_.room(10, 6);
    EXPECT_EQ(mesh_.set_map(world_.voxels()).error, "");
  }
  /// Checks what is promised of every way out.
  std::optional<mesh::Mesh::Place> leave(Point start, Point towards = {9, 3}) {
    std::vector<Cylinder> row;
    for (const guide::MovingThing& one : things_)
      for (const Cylinder& part : guide::cylinders_of(one, 4)) row.push_back(part);
    mesh_.carve(row);
    EXPECT_TRUE(in_a_hole(start, mesh_.space(), kRadius));
    const auto out = escape(mesh_.mesh(), mesh_.space(), start, kRadius, std::nullopt, towards);
    if (!out) return out;
    EXPECT_FALSE(in_a_hole(out->point, mesh_.space(), kRadius - 1e-3));
    for (const Point at : points_along({start, out->point}, 0.02)) {
      for (const Cylinder& one : row) {
        const double least = std::min(distance(start, one.center), one.radius + kRadius);
        EXPECT_GE(distance(at, one.center), least - 1e-3);
      }
      for (const auto& block : world_.blocks())
        EXPECT_GE(distance_to(block, at), std::min(kRadius, distance_to(block, start)) - 1e-3);
    }
    return out;
  }
  SmallWorld world_;
  NavMesh mesh_{NavMeshConfig{}};
  std::vector<guide::MovingThing> things_{thing(1, {5, 3}, 1.35, 2.4, 1.1)};
};

TEST_F(Escape, N4_leads_off_before_beside_and_behind) {
  for (const Point start : {Point{6.6, 3}, Point{5, 3.9}, Point{5.4, 2.2}, Point{3.5, 3.1}}) {
    const auto out = leave(start);
    ASSERT_TRUE(out) << start.x << ' ' << start.y;
    EXPECT_LT(distance(out->point, start), 1.0);
  }
}

TEST_F(Escape, of_nearly_equal_ways_takes_the_one_towards_the_goal) {
  EXPECT_GT(leave({5, 3.9}, {9, 3})->point.x, leave({5, 3.9}, {1, 3})->point.x);
}

TEST_F(Escape, of_what_moves_leads_to_the_side_and_not_on_before_it) {
  things_[0].velocity = {1.0, 0.0};
  const auto out = leave({6.5, 3.1}, {9, 3.1});
  ASSERT_TRUE(out);
  EXPECT_GT(std::abs(out->point.y - 3.1), out->point.x - 6.5);
}

TEST_F(Escape, does_not_lead_into_another_hole_or_a_wall) {
  things_.push_back(thing(2, {5, 4.75}, 0.4));
  const auto out = leave({5, 3.95}, {5, 5.9});
  ASSERT_TRUE(out);
  EXPECT_GT(std::abs(out->point.x - 5.0), 0.3);
}

TEST_F(Escape, is_none_between_a_thing_and_a_wall) {
  world_.box(4, 4.0, 0, 6.5, 4.3, 1.0).box(6.3, 1.5, 0, 6.5, 4.3, 1.0);
  ASSERT_EQ(mesh_.set_map(world_.voxels()).error, "");
  things_.push_back(thing(2, {4.6, 3.5}, 0.3));
  things_.push_back(thing(3, {5.9, 2.2}, 0.3));
  EXPECT_FALSE(leave({5.85, 3.55}));
}

}  // namespace
}  // namespace navvi_nav::plan
