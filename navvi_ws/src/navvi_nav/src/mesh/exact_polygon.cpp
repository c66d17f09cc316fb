#include "mesh/exact_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace navvi_nav::mesh {
namespace {

using Wide = Intersection::Wide;

constexpr double kSlack = 1.5;  // steps: centre and corner of a hole are both rounded

double divide(Wide numerator, std::int64_t denominator) {
  Wide whole = numerator / denominator;
  auto rest = static_cast<std::int64_t>(numerator % denominator);
  if (rest < 0) {
    rest += denominator;
    whole -= 1;
  }
  return static_cast<double>(static_cast<std::int64_t>(whole)) +
         static_cast<double>(rest) / static_cast<double>(denominator);
}

void measure(ExactPolygon& polygon) {
  for (std::size_t i = 0; i < polygon.edges.size(); ++i) {
    const Intersection& at = polygon.edges[i].begin;
    const auto w = static_cast<double>(at.w);
    const Point place{static_cast<double>(at.x) / w, static_cast<double>(at.y) / w};
    if (i == 0) polygon.low = polygon.high = place;
    polygon.low = {std::min(polygon.low.x, place.x), std::min(polygon.low.y, place.y)};
    polygon.high = {std::max(polygon.high.x, place.x), std::max(polygon.high.y, place.y)};
  }
  polygon.low = polygon.low - Point{1.0, 1.0};
  polygon.high = polygon.high + Point{1.0, 1.0};
}

bool boxes_overlap(const ExactPolygon& a, const ExactPolygon& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

/// The part of `whole` on the side of the line where side * side_of() is positive.
/// \param sides  of the line, for each edge's begin
void keep_part(const ExactPolygon& whole, const std::vector<signed char>& sides, int side,
               const HalfPlane& line, int number, ExactPolygon& part) {
  part.edges.clear();
  const std::size_t count = whole.edges.size();
  for (std::size_t i = 0; i < count; ++i) {
    const int here = side * sides[i];
    const int there = side * sides[i + 1 < count ? i + 1 : 0];
    if (here <= 0 && there <= 0) continue;
    const ExactPolygon::Edge& edge = whole.edges[i];
    part.edges.push_back(edge);
    if (here < 0) part.edges.back().begin = intersect(edge.line, line);
    if (there > 0) continue;
    const Intersection leaves =
        there == 0 ? whole.edges[i + 1 < count ? i + 1 : 0].begin : intersect(edge.line, line);
    part.edges.push_back({side > 0 ? line : line.opposite(), leaves, number});
  }
}

bool separates(const ExactPolygon::Edge& edge, const ExactPolygon& other) {
  return std::none_of(other.edges.begin(), other.edges.end(),
                      [&edge](const auto& corner) { return side_of(edge.line, corner.begin) > 0; });
}

}  // namespace

HalfPlane left_of(LatticePoint from, LatticePoint to) {
  const std::int64_t dx = to.x - from.x;
  const std::int64_t dy = to.y - from.y;
  const std::int64_t divisor = std::gcd(dx, dy);
  const std::int64_t a = -dy / divisor;
  const std::int64_t b = dx / divisor;
  return {a, b, -(a * from.x + b * from.y)};
}

Intersection intersect(const HalfPlane& p, const HalfPlane& q) {
  Intersection out;
  out.x = static_cast<Wide>(p.b) * q.c - static_cast<Wide>(q.b) * p.c;
  out.y = static_cast<Wide>(p.c) * q.a - static_cast<Wide>(q.c) * p.a;
  out.w = p.a * q.b - q.a * p.b;
  if (out.w < 0) return {-out.x, -out.y, -out.w};
  return out;
}

int side_of(const HalfPlane& half, const Intersection& at) {
  const Wide value = half.a * at.x + half.b * at.y + static_cast<Wide>(half.c) * at.w;
  return (value > 0) - (value < 0);
}

Point place_of(const Intersection& at) { return {divide(at.x, at.w), divide(at.y, at.w)}; }

ExactPolygon exact_polygon(const std::vector<LatticePoint>& corners) {
  ExactPolygon out;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const HalfPlane line = left_of(corners[i], corners[(i + 1) % count]);
    const HalfPlane before = left_of(corners[(i + count - 1) % count], corners[i]);
    if (line == before) continue;
    out.edges.push_back({line, {corners[i].x, corners[i].y, 1}, static_cast<int>(i)});
  }
  measure(out);
  return out;
}

void Hole::place(Point center, double radius, int sides) {
  const auto far = static_cast<double>(kFarthestStep);
  const double reach = radius + kSlack;
  const double nearest = std::max(std::abs(center.x), std::abs(center.y)) - reach;
  const bool inside = nearest + 2 * reach < far;
  if (!inside || 2.0 * reach >= static_cast<double>(kLongestEdge)) {
    sides_ = 0;
    shape.edges.clear();
    order.clear();
    if (nearest < far) build_square(center, reach);
    return;
  }
  const LatticePoint middle{std::llround(center.x), std::llround(center.y)};
  if (sides != sides_ || radius != radius_) build({0, 0}, reach, sides);
  const std::int64_t dx = middle.x - middle_.x;
  const std::int64_t dy = middle.y - middle_.y;
  for (ExactPolygon::Edge& edge : shape.edges) {
    edge.line.c -= edge.line.a * dx + edge.line.b * dy;
    edge.begin.x += dx;
    edge.begin.y += dy;
  }
  measure(shape);
  middle_ = middle;
  radius_ = radius;
  sides_ = sides;
}

void Hole::build(LatticePoint middle, double reach, int sides) {
  const double outer = reach / std::cos(kPi / sides);
  std::vector<LatticePoint> corners;
  for (int k = 0; k < sides; ++k) {
    const double angle = (2 * k - 1) * kPi / sides;
    corners.push_back({middle.x + std::llround(outer * std::cos(angle)),
                       middle.y + std::llround(outer * std::sin(angle))});
  }
  shape = exact_polygon(corners);
  middle_ = middle;
  find_order(sides);
}

void Hole::build_square(Point center, double reach) {
  const auto bounded = [](double value) {
    const auto far = static_cast<double>(kFarthestStep);
    return static_cast<std::int64_t>(std::clamp(value, -far, far));
  };
  const std::int64_t x0 = bounded(center.x - reach), x1 = bounded(center.x + reach);
  const std::int64_t y0 = bounded(center.y - reach), y1 = bounded(center.y + reach);
  shape = exact_polygon({{x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}});
  find_order(4);
}

/// Edge k faces 2 pi k / sides. The four along the axes come first, then those between, the ones in
/// the middle of a quarter before those at its ends.
void Hole::find_order(int sides) {
  std::vector<double> late;
  order.clear();
  for (std::size_t k = 0; k < shape.edges.size(); ++k) {
    const double quarter = 4.0 * shape.edges[k].number / sides;
    const double aside = std::abs(quarter - std::round(quarter));
    late.push_back(aside < 2.0 / sides * (1.0 - 1e-9) ? 0.0 : 1.0 - aside);
    order.push_back(static_cast<int>(k));
  }
  std::stable_sort(order.begin(), order.end(), [&late](int i, int j) {
    return late[static_cast<std::size_t>(i)] < late[static_cast<std::size_t>(j)];
  });
}

bool overlap(const ExactPolygon& a, const ExactPolygon& b) {
  if (a.edges.empty() || b.edges.empty() || !boxes_overlap(a, b)) return false;
  return std::none_of(a.edges.begin(), a.edges.end(),
                      [&b](const auto& edge) { return separates(edge, b); }) &&
         std::none_of(b.edges.begin(), b.edges.end(),
                      [&a](const auto& edge) { return separates(edge, a); });
}

void Cutter::Sides::look(const ExactPolygon& polygon, const HalfPlane& line) {
  each.resize(polygon.edges.size());
  inside = outside = false;
  for (std::size_t i = 0; i < each.size(); ++i) {
    const int side = side_of(line, polygon.edges[i].begin);
    each[i] = static_cast<signed char>(side);
    inside = inside || side > 0;
    outside = outside || side < 0;
  }
}

ExactPolygon& Cutter::Pool::add() {
  if (count == items.size()) items.emplace_back();
  return items[count++];
}

void Cutter::cut(const ExactPolygon& polygon, const std::vector<const Hole*>& holes) {
  pieces_.count = 0;
  pieces_.add() = polygon;
  for (const Hole* hole : holes) {
    next_.count = 0;
    for (std::size_t i = 0; i < pieces_.count; ++i) {
      ExactPolygon& piece = pieces_.items[i];
      if (boxes_overlap(piece, hole->shape) && bite(piece, *hole)) continue;
      std::swap(next_.add(), piece);
    }
    std::swap(pieces_, next_);
  }
}

/// Adds what is left of the piece. \returns false if the hole does not reach into it
bool Cutter::bite(const ExactPolygon& piece, const Hole& hole) {
  if (!find_biting_edges(piece, hole)) return false;
  rest_ = piece;
  for (const int k : hole.order) {
    if (bites_[static_cast<std::size_t>(k)] == 0) continue;
    const HalfPlane line = hole.shape.edges[static_cast<std::size_t>(k)].line;
    sides_.look(rest_, line);
    if (!sides_.outside) continue;
    ExactPolygon& cut_off = next_.add();
    keep_part(rest_, sides_.each, -1, line, ExactPolygon::kCut, cut_off);
    measure(cut_off);
    keep_part(rest_, sides_.each, 1, line, ExactPolygon::kCut, spare_);
    std::swap(rest_, spare_);
  }
  return true;
}

/// Finds the edges of the hole that bound its intersection with the piece.
bool Cutter::find_biting_edges(const ExactPolygon& piece, const Hole& hole) {
  constexpr int kFirst = 1 << 20;
  rest_ = piece;
  for (std::size_t k = 0; k < hole.shape.edges.size(); ++k) {
    const HalfPlane line = hole.shape.edges[k].line;
    sides_.look(rest_, line);
    if (!sides_.inside) return false;
    if (!sides_.outside) continue;
    keep_part(rest_, sides_.each, 1, line, kFirst + static_cast<int>(k), spare_);
    std::swap(rest_, spare_);
  }
  bites_.assign(hole.shape.edges.size(), 0);
  for (const ExactPolygon::Edge& edge : rest_.edges) {
    if (edge.number >= kFirst) bites_[static_cast<std::size_t>(edge.number - kFirst)] = 1;
  }
  return true;
}

}  // namespace navvi_nav::mesh
