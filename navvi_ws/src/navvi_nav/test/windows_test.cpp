#include "navvi_nav/windows.hpp"

#include <gtest/gtest.h>

#include <set>

#include "grid_world.hpp"
#include "visibility_graph.hpp"

namespace navvi_nav {
namespace {

constexpr int kPlaces = 20;  // in each world

/// Calls check(mesh, a, b) for places inside polygons of many worlds.
template <typename Check>
void each_pair(Check check) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const GridWorld world = grid_world(static_cast<WorldKind>(seed % 4), seed);
    const Mesh mesh = join(world.polygons(seed), 0.5);
    std::mt19937 random(seed);
    const auto somewhere = [&] {
      const std::size_t polygon = random() % mesh.polygons.size();
      const auto& corners = mesh.polygons[polygon].corners;
      const Point corner = mesh.at(corners[random() % corners.size()]);
      const double share = 0.9 * static_cast<double>(random() % 1000) / 999.0;
      const Point center = mesh.centroid(static_cast<int>(polygon));
      return Mesh::Place{static_cast<int>(polygon), center + share * (corner - center)};
    };
    for (int i = 0; i < kPlaces && !testing::Test::HasFailure(); ++i)
      check(mesh, somewhere(), somewhere());
  }
}

TEST(Windows, show_the_corners_that_are_seen_when_looking_about) {
  std::size_t seen_in_all = 0;
  std::uint64_t version = 0;
  Windows windows;
  Sight sight;
  each_pair([&](const Mesh& mesh, const Mesh::Place& place, const Mesh::Place&) {
    if (std::exchange(version, mesh.version) != mesh.version) windows.measure(mesh);
    const VisibilityGraph graph(mesh);
    std::set<int> shown;
    for (const Sight::Corner& corner : windows.look(mesh, place)) {
      shown.insert(corner.vertex);
      EXPECT_TRUE(graph.visible(place.point, mesh.at(corner.vertex)));
      EXPECT_NEAR(corner.away, distance(place.point, mesh.at(corner.vertex)), 1e-12);
    }
    for (const Sight::Corner& corner : sight.look(mesh, place)) {
      ++seen_in_all;
      EXPECT_EQ(shown.count(corner.vertex), 1U) << corner.vertex;
    }
  });
  EXPECT_GT(seen_in_all, 1000U);
}

TEST(Windows, stay_unknown_if_they_are_too_many) {
  const Mesh mesh = join(grid_world(WorldKind::clutter, 1).polygons(1), 0.5);
  Windows windows(10);
  windows.measure(mesh);
  EXPECT_FALSE(windows.known());
}

TEST(Windows, of_another_mesh_are_measured_anew) {
  Windows windows;
  EXPECT_FALSE(windows.known());
  const Mesh mesh = join(grid_world(WorldKind::clutter, 1).polygons(1), 0.5);
  windows.measure(mesh);
  EXPECT_TRUE(windows.known());
  windows.forget();
  EXPECT_FALSE(windows.known());
  const Mesh empty = join({{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, 0.5);
  windows.measure(empty);
  EXPECT_TRUE(windows.look(empty, {0, {0.2, 0.2}}).empty());
}

TEST(Sight, tells_of_a_single_place_what_a_ruler_does) {
  int seen = 0;
  int hidden = 0;
  Sight sight;
  each_pair([&](const Mesh& mesh, const Mesh::Place& a, const Mesh::Place& b) {
    const bool straight = VisibilityGraph(mesh).visible(a.point, b.point);
    EXPECT_EQ(sight.sees(mesh, a, b), straight);
    EXPECT_EQ(sight.sees(mesh, b, a), straight);
    ++(straight ? seen : hidden);
  });
  EXPECT_GT(seen, 30);
  EXPECT_GT(hidden, 100);
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
