#include "mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <random>

namespace navvi_nav::mesh {
namespace {

/// A triangle one of whose edges has vertices on it, with rounding, as where holes end at it.
TEST(Mesh, locates_points_on_an_edge_of_several_parts_where_they_are) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int world = 0; world < 200; ++world) {
    const Point a{50.0 * any(random), 50.0 * any(random)};
    const Point along{1.0 + 5.0 * any(random), any(random)};
    Mesh mesh;
    Polygon polygon;
    for (const double share : {0.0, 0.3, 0.7, 1.0}) mesh.vertices.push_back({a + share * along});
    mesh.vertices.push_back({a + Point{0.0, 6.0}});
    for (int i = 0; i < 5; ++i) polygon.corners.push_back(i);
    mesh.polygons.push_back(polygon);
    mesh.grid = BoxGrid({0, 0}, {60, 60}, 4.0);
    mesh.grid.add(0, a, a + Point{along.x, 7.0});
    for (int i = 0; i < 200; ++i) {
      const Point point = a + any(random) * along;
      const auto place = mesh.locate(point, 1.0);
      ASSERT_TRUE(place);
      EXPECT_LT(distance(place->point, point), 1e-12);
    }
  }
}

}  // namespace
}  // namespace navvi_nav::mesh
