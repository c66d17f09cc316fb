#include <gtest/gtest.h>

#include "join.hpp"
#include "search/centroid_astar.hpp"
#include "search/search.hpp"

namespace navvi_nav::search {
namespace {

mesh::GridPolygon triangle(int ax, int ay, int bx, int by, int cx, int cy) {
  return {{{ax, ay}, {bx, by}, {cx, cy}}};
}

/// Two triangles a unit square, from (x, y).
void add_square(std::vector<mesh::GridPolygon>& out, int x, int y) {
  out.push_back(triangle(x, y, x + 1, y, x + 1, y + 1));
  out.push_back(triangle(x, y, x + 1, y + 1, x, y + 1));
}

/// An L of unit squares: along x to (n, 0), then up to (n, n).
mesh::Mesh corner_mesh(int n) {
  std::vector<mesh::GridPolygon> triangles;
  for (int i = 0; i <= n; ++i) add_square(triangles, i, 0);
  for (int i = 1; i <= n; ++i) add_square(triangles, n, i);
  return mesh::join(triangles, 1.0);
}

Path path_between(const mesh::Mesh& mesh, Point start, Point goal) {
  const auto from = mesh.locate(start, 0.0);
  const auto to = mesh.locate(goal, 0.0);
  if (!from || !to) return {};
  Search search(SearchMethod::centroid_astar);
  return search.find(mesh, *from, *to).path;
}

TEST(Mesh, of_no_triangles_locates_nothing) {
  EXPECT_FALSE(mesh::Mesh{}.locate({0, 0}, 100.0));
  EXPECT_TRUE(mesh::join({}, 0.05).polygons.empty());
}

TEST(Mesh, connects_triangles_that_share_only_a_part_of_an_edge) {
  const mesh::Mesh mesh =
      mesh::join({triangle(0, 0, 4, 0, 0, 4), triangle(1, 0, 0, -2, 3, 0)}, 0.5);
  ASSERT_EQ(mesh.polygons[0].portals.size(), 1U);
  const mesh::Portal& portal = mesh.polygons[0].portals[0];
  EXPECT_EQ(portal.to, 1);
  EXPECT_EQ(mesh.at(portal.left), (Point{1.5, 0}));  // who goes down has east on the left
  EXPECT_EQ(mesh.at(portal.right), (Point{0.5, 0}));
}

TEST(Mesh, makes_the_end_of_a_link_a_corner_of_both_polygons) {
  const mesh::Mesh mesh =
      mesh::join({{{{0, 0}, {4, 0}, {4, 2}, {0, 2}}}, {{{1, 2}, {3, 2}, {2, 4}}}}, 1.0);
  EXPECT_EQ(mesh.outline(0), (Path{{0, 0}, {4, 0}, {4, 2}, {3, 2}, {1, 2}, {0, 2}}));
  EXPECT_EQ(mesh.outline(1), (Path{{1, 2}, {3, 2}, {2, 4}}));
}

TEST(Mesh, knows_where_a_path_may_turn) {
  // An L of three squares, its long side in one piece, with the square above split by a T.
  const mesh::Mesh mesh =
      mesh::join({{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}}}, 1.0);
  for (const mesh::Vertex& vertex : mesh.vertices)
    EXPECT_EQ(vertex.corner, vertex.at == (Point{1, 1})) << vertex.at.x << " " << vertex.at.y;
}

TEST(Mesh, takes_neither_open_floor_nor_a_straight_wall_for_a_corner) {
  std::vector<mesh::GridPolygon> squares;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y)
      squares.push_back({{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}});
  }
  for (const mesh::Vertex& vertex : mesh::join(squares, 0.05).vertices) EXPECT_FALSE(vertex.corner);
}

TEST(Mesh, gives_each_side_of_a_non_manifold_vertex_its_own) {
  const auto square = [](int x, int y) {
    return mesh::GridPolygon{{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};
  };
  const mesh::Mesh mesh =
      mesh::join({square(0, 0), square(1, 1), square(0, 1), square(2, 1), square(2, 0)}, 1);
  int there = 0;
  for (const mesh::Vertex& vertex : mesh.vertices) there += vertex.at == (Point{1, 1}) ? 1 : 0;
  EXPECT_EQ(there, 1);  // (0, 1) joins them
  const mesh::Mesh touching =
      mesh::join({square(0, 0), square(1, 1), square(2, 1), square(2, 0)}, 1);
  there = 0;
  for (const mesh::Vertex& vertex : touching.vertices) there += vertex.at == (Point{1, 1}) ? 1 : 0;
  EXPECT_EQ(there, 2);
}

TEST(Mesh, does_not_link_triangles_that_touch_in_a_point) {
  const mesh::Mesh mesh = mesh::join({triangle(0, 0, 1, 0, 0, 1), triangle(1, 0, 2, 0, 2, 1)}, 1.0);
  EXPECT_TRUE(mesh.polygons[0].portals.empty());
  EXPECT_NE(mesh.polygons[0].component, mesh.polygons[1].component);
}

TEST(Mesh, locates_the_nearest_point_within_reach_only) {
  const mesh::Mesh mesh = mesh::join({triangle(0, 0, 2, 0, 0, 2)}, 1.0);
  EXPECT_TRUE(mesh.locate({0.5, 0.5}, 0.0));
  EXPECT_FALSE(mesh.locate({1, -1}, 0.9));
  EXPECT_EQ(mesh.locate({1, -1}, 1.1)->point, (Point{1, 0}));
}

TEST(Search, takes_the_shorter_way_round_a_block) {
  std::vector<mesh::GridPolygon> triangles;  // a ring, 5 wide and 3 high, open in its middle
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 3; ++y) {
      if (y != 1 || x == 0 || x == 4) add_square(triangles, x, y);
    }
  }
  const mesh::Mesh mesh = mesh::join(triangles, 1.0);
  const Path path = path_between(mesh, {0.5, 0.5}, {4.5, 0.5});
  ASSERT_EQ(path.size(), 2U);
  EXPECT_DOUBLE_EQ(length_of(path), 4.0);
}

TEST(Funnel, turns_at_the_inner_corner) {
  const Path path = path_between(corner_mesh(3), {0.2, 0.5}, {3.5, 3.8});
  ASSERT_EQ(path.size(), 3U);
  EXPECT_EQ(path[1], (Point{3, 1}));
}

TEST(Funnel, goes_straight_through_collinear_portals) {
  std::vector<mesh::GridPolygon> triangles;
  for (int i = 0; i < 10; ++i) add_square(triangles, i, 0);
  const mesh::Mesh mesh = mesh::join(triangles, 1.0);
  EXPECT_EQ(path_between(mesh, {0.2, 0.5}, {9.7, 0.5}).size(), 2U);
  // Along the very border every portal begins on the line.
  EXPECT_NEAR(length_of(path_between(mesh, {0.0, 0.0}, {10.0, 0.0})), 10.0, 1e-12);
}

TEST(Funnel, is_straight_without_portals_and_winds_through_those_that_there_are) {
  struct Row {
    Point goal;
    std::vector<mesh::Interval> portals;
    Path path;
  };
  const Row no_portals{{3, 4}, {}, {{0, 0}, {3, 4}}};
  const Row no_way{{0, 0}, {}, {{0, 0}}};
  const Row no_width{{4, 0}, {{{2, 1}, {2, 1}}}, {{0, 0}, {2, 1}, {4, 0}}};
  const Row slalom{{4, 0},
                   {{{1, 1}, {1, 3}}, {{2, -3}, {2, -1}}, {{3, 1}, {3, 3}}},
                   {{0, 0}, {1, 1}, {2, -1}, {3, 1}, {4, 0}}};
  for (const Row& row : {no_portals, no_way, no_width, slalom})
    EXPECT_EQ(funnel({0, 0}, row.goal, row.portals), row.path) << row.portals.size();
}

}  // namespace
}  // namespace navvi_nav::search
