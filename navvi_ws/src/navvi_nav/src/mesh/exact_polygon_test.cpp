#include "mesh/exact_polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace navvi_nav::mesh {
namespace {

constexpr std::int64_t kCell = 1024;  // steps

std::vector<Point> outline(const ExactPolygon& polygon) {
  std::vector<Point> out;
  for (const auto& edge : polygon.edges) out.push_back(place_of(edge.begin));
  return out;
}

/// Steps squared.
double area(const ExactPolygon& polygon) {
  const std::vector<Point> corners = outline(polygon);
  double twice = 0.0;
  for (std::size_t i = 2; i < corners.size(); ++i)
    twice += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return twice / 2;
}

double area(const Cutter& cutter) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cutter.count(); ++i) sum += area(cutter.piece(i));
  return sum;
}

bool holds(const ExactPolygon& polygon, LatticePoint at) {
  for (const auto& edge : polygon.edges) {
    if (side_of(edge.line, {at.x, at.y, 1}) < 0) return false;
  }
  return !polygon.edges.empty();
}

bool strictly_holds(const ExactPolygon& polygon, LatticePoint at) {
  for (const auto& edge : polygon.edges) {
    if (side_of(edge.line, {at.x, at.y, 1}) <= 0) return false;
  }
  return !polygon.edges.empty();
}

bool strictly_convex(const ExactPolygon& polygon) {
  const std::size_t count = polygon.edges.size();
  for (std::size_t i = 0; i < count; ++i) {
    const HalfPlane& p = polygon.edges[i].line;
    const HalfPlane& q = polygon.edges[(i + 1) % count].line;
    if (p.a * q.b - q.a * p.b <= 0) return false;
    for (const auto& corner : polygon.edges) {
      if (side_of(p, corner.begin) < 0) return false;
    }
  }
  return count >= 3;
}

ExactPolygon box(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
  return exact_polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

Hole hole_about(Point center, double radius, int sides) {
  Hole out;
  out.place(center, radius, sides);
  return out;
}

Hole hole_of(const std::vector<LatticePoint>& corners) {
  Hole out;
  out.shape = exact_polygon(corners);
  for (std::size_t k = 0; k < out.shape.edges.size(); ++k) out.order.push_back(static_cast<int>(k));
  return out;
}

/// All that must hold of what is left of a polygon: pieces are convex, overlap neither each other
/// nor a hole, and every step of the polygon is in a piece or a hole.
void expect_rest(const ExactPolygon& polygon, const std::vector<const Hole*>& holes,
                 std::mt19937& random) {
  Cutter cutter;
  cutter.cut(polygon, holes);
  for (std::size_t i = 0; i < cutter.count(); ++i) {
    ASSERT_TRUE(strictly_convex(cutter.piece(i)));
    for (const Hole* hole : holes) ASSERT_FALSE(overlap(cutter.piece(i), hole->shape));
    for (std::size_t j = 0; j < i; ++j) ASSERT_FALSE(overlap(cutter.piece(i), cutter.piece(j)));
  }
  const auto inside = [&random](double low, double high) {
    return static_cast<std::int64_t>(std::uniform_real_distribution<double>(low, high)(random));
  };
  for (int k = 0; k < 60; ++k) {
    const LatticePoint at{inside(polygon.low.x, polygon.high.x),
                          inside(polygon.low.y, polygon.high.y)};
    bool in_piece = false, in_hole = false, deep_in_hole = false;
    for (std::size_t i = 0; i < cutter.count(); ++i)
      in_piece = in_piece || holds(cutter.piece(i), at);
    for (const Hole* hole : holes) {
      in_hole = in_hole || holds(hole->shape, at);
      deep_in_hole = deep_in_hole || strictly_holds(hole->shape, at);
    }
    if (!holds(polygon, at)) {
      ASSERT_FALSE(in_piece);
    } else if (deep_in_hole) {
      ASSERT_FALSE(in_piece);
    } else if (!in_hole) {
      ASSERT_TRUE(in_piece);
    }
  }
}

TEST(ExactPolygon, leaves_out_corners_on_a_straight_edge) {
  const ExactPolygon square = exact_polygon({{0, 0}, {5, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 4}});
  ASSERT_EQ(square.edges.size(), 4U);
  EXPECT_EQ(square.edges[0].number, 0);
  EXPECT_EQ(square.edges[1].number, 2);
  EXPECT_EQ(square.edges[3].number, 4);
  EXPECT_EQ(area(square), 100.0);
}

TEST(ExactPolygon, gives_a_place_the_same_doubles_however_it_came_to_be) {
  std::mt19937 random(1);
  const auto draw = [&random](int range) {
    return static_cast<std::int64_t>(random() % static_cast<unsigned>(2 * range + 1)) - range;
  };
  for (int i = 0; i < 5000; ++i) {
    const LatticePoint at{draw(1 << 28), draw(1 << 28)};
    const HalfPlane first = left_of(at, {at.x + draw(9000), at.y + 1 + std::abs(draw(9000))});
    const HalfPlane second = left_of(at, {at.x + 9001 + std::abs(draw(9000)), at.y + draw(9000)});
    if (first.a * second.b == first.b * second.a) continue;
    const Point place = place_of(intersect(first, second));
    ASSERT_EQ(place.x, static_cast<double>(at.x));
    ASSERT_EQ(place.y, static_cast<double>(at.y));
    // Three lines through one place that is no whole step.
    const HalfPlane level{0, 3, -10};
    const HalfPlane upright{7, 0, -5};
    const HalfPlane slanted{7 * 2, 3, -5 * 2 - 10};
    const Point a = place_of(intersect(level, upright));
    const Point b = place_of(intersect(upright, slanted));
    const Point c = place_of(intersect(slanted, level));
    ASSERT_TRUE(a == b && b == c);
  }
}

TEST(Hole, keeps_the_radius_and_loses_little) {
  for (const int sides : {4, 7, 8, 12, 16, 32}) {
    for (const double radius : {100.0, 8000.5, 200000.25}) {
      const Point center{1234.4, -987.6};
      const Hole hole = hole_about(center, radius, sides);
      ASSERT_EQ(hole.shape.edges.size(), static_cast<std::size_t>(sides));
      EXPECT_TRUE(strictly_convex(hole.shape));
      const std::vector<Point> corners = outline(hole.shape);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point next = corners[(i + 1) % corners.size()];
        const double gap = distance(center, nearest_on_segment(center, corners[i], next));
        EXPECT_GE(gap, radius);
        EXPECT_LE(gap, radius + 3.0);
        EXPECT_LE(distance(center, corners[i]), (radius + 4.0) / std::cos(kPi / sides));
      }
    }
  }
}

TEST(Hole, is_the_same_wherever_it_was_before) {
  Hole moved;
  for (const Point center : {Point{0.4, 0.6}, {-12345.6, 99999.4}, {1e12, 0}, {7.5, -7.5}}) {
    for (const double radius : {5000.0, 5000.0, 1e9, 7000.0}) {
      moved.place(center, radius, 12);
      const Hole fresh = hole_about(center, radius, 12);
      ASSERT_EQ(moved.shape.edges.size(), fresh.shape.edges.size());
      EXPECT_EQ(moved.order, fresh.order);
      for (std::size_t k = 0; k < fresh.shape.edges.size(); ++k) {
        EXPECT_TRUE(moved.shape.edges[k].line == fresh.shape.edges[k].line);
        EXPECT_TRUE(place_of(moved.shape.edges[k].begin) == place_of(fresh.shape.edges[k].begin));
      }
    }
  }
}

TEST(Hole, faces_along_the_axes_with_straight_edges) {
  const Hole hole = hole_about({500.3, 100.7}, 7000.9, 16);
  int level = 0, upright = 0;
  for (const auto& edge : hole.shape.edges) {
    level += edge.line.a == 0 ? 1 : 0;
    upright += edge.line.b == 0 ? 1 : 0;
  }
  EXPECT_EQ(level, 2);
  EXPECT_EQ(upright, 2);
  for (std::size_t i = 0; i < 4; ++i) {
    const HalfPlane& line = hole.shape.edges[static_cast<std::size_t>(hole.order[i])].line;
    EXPECT_TRUE(line.a == 0 || line.b == 0) << i;
  }
}

TEST(Hole, is_a_square_about_a_giant_and_nothing_beyond_the_farthest_step) {
  const Hole giant = hole_about({0, 0}, 1e9, 16);
  EXPECT_EQ(giant.shape.edges.size(), 4U);
  EXPECT_TRUE(holds(giant.shape, {999999999, -999999999}));
  const Hole all = hole_about({1e15, 0}, 1e16, 16);
  EXPECT_TRUE(holds(all.shape, {0, 0}));
  EXPECT_TRUE(hole_about({1e15, 0}, 1e9, 16).shape.edges.empty());
}

TEST(Cutter, leaves_a_polygon_alone_that_no_hole_reaches) {
  const ExactPolygon square = box(0, 0, 100, 100);
  const Hole beside = hole_of({{100, 20}, {150, 20}, {150, 80}, {100, 80}});  // along its edge
  const Hole at_corner = hole_of({{100, 100}, {150, 100}, {120, 150}});
  const Hole tip = hole_of({{100, 50}, {150, 40}, {150, 60}});  // a corner on the edge
  Cutter cutter;
  cutter.cut(square, {&beside, &at_corner, &tip});
  ASSERT_EQ(cutter.count(), 1U);
  EXPECT_EQ(outline(cutter.piece(0)), outline(square));
}

TEST(Cutter, leaves_nothing_of_a_polygon_inside_a_hole) {
  const ExactPolygon square = box(0, 0, 100, 100);
  const Hole same = hole_of({{0, 0}, {100, 0}, {100, 100}, {0, 100}});
  const Hole wider = hole_of({{-50, 0}, {150, 0}, {150, 100}, {-50, 100}});
  for (const Hole* hole : {&same, &wider}) {
    Cutter cutter;
    cutter.cut(square, {hole});
    EXPECT_EQ(cutter.count(), 0U);
  }
}

TEST(Cutter, cuts_as_many_pieces_as_the_hole_has_edges_inside) {
  const ExactPolygon square = box(0, 0, 400 * kCell, 400 * kCell);
  const Hole hole = hole_about({200.0 * kCell, 200.0 * kCell}, 17.0 * kCell, 16);
  Cutter cutter;
  cutter.cut(square, {&hole});
  EXPECT_EQ(cutter.count(), 16U);
  EXPECT_NEAR(area(cutter) + area(hole.shape), area(square), 1e-9 * area(square));
}

TEST(Cutter, is_right_about_holes_that_share_lines_and_corners) {
  std::mt19937 random(3);
  const ExactPolygon square = box(0, 0, 100, 100);
  const ExactPolygon slanted = exact_polygon({{0, 0}, {90, 30}, {60, 120}, {-30, 90}});
  const std::vector<Hole> holes{
      hole_of({{20, 0}, {60, 0}, {60, 40}, {20, 40}}),        // an edge along the polygon's
      hole_of({{0, 0}, {30, 0}, {30, 30}, {0, 30}}),          // a corner on the polygon's
      hole_of({{50, 50}, {100, 60}, {60, 90}}),               // a corner on the polygon's edge
      hole_of({{-20, 40}, {120, 40}, {120, 60}, {-20, 60}}),  // right through
      hole_of({{0, 0}, {90, 30}, {40, 60}}),                  // an edge that is the polygon's
      hole_of({{-10, -10}, {10, 10}, {-10, 10}}),             // through a corner
      hole_of({{20, 40}, {60, 40}, {60, 80}, {20, 80}}),      // touches the first
  };
  for (const ExactPolygon& polygon : {square, slanted}) {
    for (const Hole& a : holes) {
      for (const Hole& b : holes) {
        expect_rest(polygon, {&a, &b}, random);
        if (HasFatalFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace navvi_nav::mesh
