#include "mesh/mesh.hpp"

namespace navvi_nav::mesh {

std::vector<Point> Mesh::outline(int index) const {
  std::vector<Point> out;
  out.reserve(polygon(index).corners.size());
  for (const int corner : polygon(index).corners) out.push_back(at(corner));
  return out;
}

double Mesh::angle_at(const Polygon& polygon, std::size_t k) const {
  const std::size_t count = polygon.corners.size();
  const Point here = at(polygon.corners[k]);
  const Point a = at(polygon.corners[(k + 1) % count]) - here;
  const Point b = at(polygon.corners[(k + count - 1) % count]) - here;
  return std::abs(std::atan2(cross(a, b), dot(a, b)));  // a straight one may come as -pi
}

Point Mesh::centroid(int index) const {
  const auto& corners = polygon(index).corners;
  const Point origin = at(corners[0]);
  Point sum;
  double area = 0.0;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Point a = at(corners[k - 1]) - origin;
    const Point b = at(corners[k]) - origin;
    const double twice = cross(a, b);
    sum = sum + twice * (a + b);
    area += twice;
  }
  return area > 0.0 ? origin + (1.0 / (3.0 * area)) * sum : origin;
}

std::optional<Mesh::Place> Mesh::locate(Point point, double within,
                                        std::optional<int> component) const {
  std::optional<Place> best;
  double best_distance = within;
  const auto corner_at = [this](int corner) { return at(corner); };
  const auto look = [&](int index) {
    const Polygon& candidate = polygon(index);
    if (component && candidate.component != *component) return;
    const Point nearest = nearest_in_convex(point, candidate.corners, corner_at);
    const double away = distance(nearest, point);
    if (!(away <= best_distance)) return;
    if (best && away == best_distance && index >= best->polygon) return;
    best = Place{index, nearest};
    best_distance = away;
  };
  double reach = 0.0;
  while (finite(point)) {
    grid.visit(point - Point{reach, reach}, point + Point{reach, reach}, look);
    if ((best && best_distance <= reach) || !(reach < within)) break;
    reach = std::min(within, std::max(2 * reach, grid.square() / 8));
  }
  return best;
}

}  // namespace navvi_nav::mesh
