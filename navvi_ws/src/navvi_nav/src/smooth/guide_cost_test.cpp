#include "smooth/guide_cost.hpp"

#include <gtest/gtest.h>

#include "small_world.hpp"

namespace navvi_nav::smooth {
namespace {

class GuideCosts : public testing::Test {
 protected:
  GuideCosts() {
    cost_.emplace(GuideCostConfig{}, mesh_.mesh(), mesh_.space(), 0.35);
    cost_->allow(1e9);
  }
  plan::NavMesh mesh_ = mesh_of(SmallWorld().room(14, 10).box(4, 3, 0, 9, 6, 1.0));
  std::optional<GuideCost> cost_;
};

TEST_F(GuideCosts, of_a_leg_with_room_is_its_length) {
  EXPECT_DOUBLE_EQ(cost_->leg({1.5, 8}, {12, 8}), 10.5);
}

TEST_F(GuideCosts, of_a_leg_rises_with_missing_clearance_and_steeply_where_it_is_tight) {
  const double wide = cost_->leg({4, 6.9}, {9, 6.9});
  const double near = cost_->leg({4, 6.6}, {9, 6.6});
  const double tight = cost_->leg({4, 6.4}, {9, 6.4});
  EXPECT_LT(wide, 5.1);
  EXPECT_GT(near, wide + 1.0);
  EXPECT_GT(tight, near + 30.0);
}

TEST_F(GuideCosts, of_a_leg_off_the_mesh_is_infinite) {
  EXPECT_TRUE(std::isinf(cost_->leg({2, 4.5}, {12, 4.5})));
  EXPECT_TRUE(std::isinf(cost_->leg({1, 1}, {1, 0.2})));
  EXPECT_TRUE(std::isinf(cost_->leg({-5, -5}, {-6, -6})));
}

TEST_F(GuideCosts, of_a_turn_grows_with_its_angle_and_is_less_than_that_of_two_halves) {
  const auto turn = [this](double degrees) {
    const double angle = navvi_types::radians(degrees);
    return cost_->turn({0, 0}, {1, 0}, {1 + 2 * std::cos(angle), 2 * std::sin(angle)});
  };
  for (int degrees = 5; degrees <= 180; degrees += 5) {
    EXPECT_GT(turn(degrees), turn(degrees - 5.0)) << degrees;
    EXPECT_NEAR(turn(degrees), turn(-degrees), 1e-9);
  }
  EXPECT_DOUBLE_EQ(turn(90.0), GuideCostConfig::kTurnPrice);
  EXPECT_LT(turn(90.0), 2.0 * turn(45.0));
  EXPECT_LT(turn(14.0) - turn(13.0), turn(15.5) - turn(13.0));
}

TEST_F(GuideCosts, of_a_path_charges_haste_between_corners_only) {
  const Path ends{{1.5, 8}, {1.6, 8}, {11, 8}, {11.1, 8}};
  EXPECT_NEAR(cost_->of(ends), length_of(ends), 1e-9);
  const Path corners{{1.5, 8}, {6, 8}, {7, 8}, {11, 8}};
  EXPECT_NEAR(cost_->of(corners), length_of(corners) + 0.5 * GuideCostConfig::kTurnPrice, 1e-9);
}

TEST_F(GuideCosts, stop_being_measured_when_the_allowance_is_spent) {
  const Path path{{1.5, 8}, {12, 8}};
  EXPECT_TRUE(cost_->less(path, 11.0));
  EXPECT_FALSE(cost_->less(path, 10.0));
  const GuideCost poor(GuideCostConfig{}, mesh_.mesh(), mesh_.space(), 0.35);
  EXPECT_FALSE(poor.less(path, 11.0));
  poor.allow(1.0);
  EXPECT_TRUE(poor.less(path, 11.0));
  EXPECT_TRUE(poor.spent());
  EXPECT_FALSE(poor.less({{1.5, 8}, {6, 8}}, 11.0));
}

/// A leg whose price is given up early is not taken for one that leaves the mesh later on.
TEST_F(GuideCosts, of_a_leg_does_not_depend_on_what_was_asked_before) {
  const Point a{4, 6.4}, b{9, 6.4};
  EXPECT_TRUE(std::isinf(cost_->leg(a, b, 6.0)));
  const double price = cost_->leg(a, b);
  EXPECT_TRUE(std::isfinite(price));
  EXPECT_DOUBLE_EQ(cost_->leg(a, b, price + 1.0), price);
}

/// m, from the point to the mesh, by every edge of every polygon.
double distance_to(const mesh::Mesh& mesh, Point point) {
  double least = 10.0;
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    if (mesh.polygons[i].corners.empty()) continue;
    const Point near = nearest_in_convex(point, mesh.outline(static_cast<int>(i)));
    least = std::min(least, distance(near, point));
  }
  return least;
}

/// In both directions, along borders, from vertices and through holes.
TEST(Covers, agrees_with_points_along_the_segment_in_any_world) {
  int whole = 0;
  int cut = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    RandomWorld world(seed);
    plan::NavMesh nav_mesh = mesh_of(world.map);
    nav_mesh.carve(world.cylinders);
    const mesh::Mesh& mesh = nav_mesh.mesh();
    std::mt19937 random(seed);
    const auto pick = [&] {
      const auto vertex = random() % mesh.vertices.size();
      if (seed % 2 == 0) return mesh.vertices[vertex].at;
      return Point{static_cast<double>(random() % 2000) / 100.0,
                   static_cast<double>(random() % 1400) / 100.0};
    };
    for (int i = 0; i < 300; ++i) {
      const Point a = pick();
      const Point b = a + 0.3 * (pick() - a);
      const auto from = mesh.locate(a, 1e-9);
      const auto to = mesh.locate(b, 1e-9);
      if (!from || !to) continue;
      const bool on_mesh = covers(mesh, from->polygon, a, b).has_value();
      EXPECT_EQ(on_mesh, covers(mesh, to->polygon, b, a).has_value());
      double off = 0.0;  // m, at most
      for (const Point point : points_along({a, b}, 0.01)) {
        const auto place = mesh.locate(point, 1e-9);
        if (!place) off = std::max(off, distance_to(mesh, point));
        if (off > 1e-5) break;
      }
      if (on_mesh) {
        EXPECT_LT(off, 1e-6);
        EXPECT_TRUE(nav_mesh.space().segment_clear(a, b, 0.35 - 1e-6));
      } else if (off < 1e-9) {
        // Between two points that were looked at, or past a place where parts only touch. The
        // corners of holes are up to 6 cm farther from a cylinder than its sides.
        const bool touches = !nav_mesh.space().segment_clear(a, b, 0.42);
        EXPECT_TRUE(touches) << seed << ": " << a.x << "," << a.y << " " << b.x << "," << b.y;
      }
      ++(on_mesh ? whole : cut);
    }
  }
  EXPECT_GT(whole, 500);
  EXPECT_GT(cut, 500);
}

}  // namespace
}  // namespace navvi_nav::smooth
