#pragma once

#include <cstdint>
#include <vector>

#include "geometry.hpp"

namespace navvi_nav::mesh {

/// A point of a lattice that is finer than the map's cells, in steps of it. Polygons and holes have
/// all corners on this lattice, so every predicate below is exact.
struct LatticePoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// Steps from the origin, at most: all products below fit in 128 bits.
constexpr std::int64_t kFarthestStep = std::int64_t{1} << 36;
/// Steps along an edge of what is cut out, at most.
constexpr std::int64_t kLongestEdge = std::int64_t{1} << 24;

/// The points with a x + b y + c >= 0, in steps; a and b have no common divisor, so equal lines
/// have equal numbers.
struct HalfPlane {
  std::int64_t a = 0;
  std::int64_t b = 0;
  std::int64_t c = 0;

  [[nodiscard]] HalfPlane opposite() const { return {-a, -b, -c}; }
};

inline bool operator==(const HalfPlane& p, const HalfPlane& q) {
  return p.a == q.a && p.b == q.b && p.c == q.c;
}

/// The points left of the line from one point through another.
[[nodiscard]] HalfPlane left_of(LatticePoint from, LatticePoint to);

/// The intersection of two lines: (x / w, y / w) in steps, w > 0. Exact.
struct Intersection {
  __extension__ typedef __int128 Wide;
  Wide x = 0;
  Wide y = 0;
  std::int64_t w = 1;
};

[[nodiscard]] Intersection intersect(const HalfPlane& p, const HalfPlane& q);
/// 1 inside, 0 on the border, -1 outside.
[[nodiscard]] int side_of(const HalfPlane& half, const Intersection& at);
/// The nearest doubles, in steps: the same ones for the same place, whatever lines intersect there.
[[nodiscard]] Point place_of(const Intersection& at);

/// A strictly convex polygon given by the lines of its edges, after Sugihara and Iri, "A solid
/// modelling system free from topological inconsistency" (1989): no cut rounds, so neighbours that
/// were cut by the same line still match, and no order of cuts opens a gap.
struct ExactPolygon {
  struct Edge {
    HalfPlane line;      ///< the polygon is inside
    Intersection begin;  ///< with the edge before
    int number = 0;      ///< of the edge before cutting; kCut for a cut
  };
  static constexpr int kCut = -1;

  std::vector<Edge> edges;  ///< counter-clockwise; none if the polygon is empty
  /// Steps, at most one too wide on each side.
  Point low;
  Point high;
};

/// \param corners  counter-clockwise, convex; those on a straight edge are left out. The number of
///                 an edge is that of the corner where it begins.
[[nodiscard]] ExactPolygon exact_polygon(const std::vector<LatticePoint>& corners);

/// A convex hole around a circle.
struct Hole {
  ExactPolygon shape;      ///< no edges before place(), and for a circle beyond the farthest step
  std::vector<int> order;  ///< in which the shape's edges cut

  /// Puts the hole around a circle: no point outside the shape is nearer than `radius` to `center`.
  /// The hole is a step or two larger than the circle where an edge faces along an axis, elsewhere
  /// up to 1 / cos(pi / sides) times as large. Those four edges cut first: they box the hole in,
  /// and the others only bevel the box, so that few cuts run far. A circle too large for exact
  /// cutting gets a square hole. Moving a hole of the same size costs little. \param center, radius
  /// steps \param sides  at least 4
  void place(Point center, double radius, int sides);

 private:
  void build(LatticePoint middle, double reach, int sides);
  void build_square(Point center, double reach);
  void find_order(int sides);

  LatticePoint middle_;
  double radius_ = -1.0;
  int sides_ = 0;  // 0: a square, which is built again for each place
};

/// True if the two share more than their borders.
[[nodiscard]] bool overlap(const ExactPolygon& a, const ExactPolygon& b);

/// Cuts holes out of polygons. Keeps its memory from one cut to the next.
class Cutter {
 public:
  /// Divides `polygon` without the holes into convex pieces that do not overlap. They are valid
  /// until the next cut.
  void cut(const ExactPolygon& polygon, const std::vector<const Hole*>& holes);

  [[nodiscard]] std::size_t count() const { return pieces_.count; }
  [[nodiscard]] const ExactPolygon& piece(std::size_t i) const { return pieces_.items[i]; }

 private:
  struct Pool {
    std::vector<ExactPolygon> items;
    std::size_t count = 0;
    ExactPolygon& add();
  };

  /// On which side of a line the corners of a polygon lie.
  struct Sides {
    std::vector<signed char> each;  ///< as side_of()
    bool inside = false;            ///< any
    bool outside = false;           ///< any

    void look(const ExactPolygon& polygon, const HalfPlane& line);
  };

  bool bite(const ExactPolygon& piece, const Hole& hole);
  bool find_biting_edges(const ExactPolygon& piece, const Hole& hole);

  Pool pieces_;
  Pool next_;
  ExactPolygon rest_;
  ExactPolygon spare_;
  Sides sides_;
  std::vector<char> bites_;
};

}  // namespace navvi_nav::mesh
