#include "plan/escape.hpp"

#include <limits>

namespace navvi_nav::plan {
namespace {

constexpr int kDirections = 32;
constexpr double kStep = 0.1;       // m
constexpr double kLongest = 4.0;    // m
constexpr double kOnMesh = 0.02;    // m
constexpr double kRounding = 1e-6;  // m
constexpr double kDearer = 3.0;     // price of a metre of the leg, in metres to `towards`
constexpr double kMoves = 0.2;      // m/s
constexpr double kBefore = 0.7;     // cosine, to its heading: a leg leads on in front of it
constexpr double kLast = 1e6;       // price of such a leg: only if there is no other

bool comes_no_nearer(Point start, Point end, const Cylinder& cylinder, double radius) {
  const double now = distance(start, cylinder.center);
  const double least = distance(nearest_on_segment(cylinder.center, start, end), cylinder.center);
  return least >= std::min(now, cylinder.radius + radius) - kRounding;
}

bool leads_before(Point start, Point ahead, const Cylinder& cylinder, double radius) {
  const double speed = norm(cylinder.velocity);
  return speed > kMoves && distance(start, cylinder.center) < cylinder.radius + radius &&
         dot(ahead, cylinder.velocity) > kBefore * speed;
}

}  // namespace

bool in_a_hole(Point place, const map::Space& space, double radius) {
  return std::any_of(space.cylinders->begin(), space.cylinders->end(), [&](const Cylinder& one) {
    return distance(place, one.center) < one.radius + radius - kRounding;
  });
}

std::optional<mesh::Mesh::Place> escape(const mesh::Mesh& mesh, const map::Space& space,
                                        Point start, double radius, std::optional<int> part,
                                        Point towards) {
  std::optional<mesh::Mesh::Place> best;
  double best_cost = std::numeric_limits<double>::infinity();
  const double room = std::min(radius, space.floor->clearance(start) - kRounding);
  if (!(room > 0.0)) return best;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * kPi * i / kDirections;
    const Point ahead{std::cos(angle), std::sin(angle)};
    const bool before =
        std::any_of(space.cylinders->begin(), space.cylinders->end(),
                    [&](const Cylinder& one) { return leads_before(start, ahead, one, radius); });
    for (double length = kStep; length <= kLongest; length += kStep) {
      const Point end = start + length * ahead;
      const double cost = kDearer * length + distance(end, towards) + (before ? kLast : 0.0);
      if (cost >= best_cost) break;
      const bool never_nearer = std::all_of(
          space.cylinders->begin(), space.cylinders->end(),
          [&](const Cylinder& one) { return comes_no_nearer(start, end, one, radius); });
      if (!never_nearer || !space.floor->segment_clear(start, end, room)) break;
      const std::optional<mesh::Mesh::Place> place = mesh.locate(end, kOnMesh, part);
      if (!place) continue;
      best = place;
      best_cost = cost;
      break;
    }
  }
  return best;
}

}  // namespace navvi_nav::plan
