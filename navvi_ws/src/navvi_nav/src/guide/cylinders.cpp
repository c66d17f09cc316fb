#include "guide/cylinders.hpp"

namespace navvi_nav::guide {

std::vector<Eigen::Vector2d> to_vectors(const Path& path) {
  std::vector<Eigen::Vector2d> out;
  for (const Point point : path) out.emplace_back(point.x, point.y);
  return out;
}

std::vector<Cylinder> cylinders_of(const MovingThing& thing, int most) {
  Cylinder one{thing.id, to_point(thing.pose.position), thing.radius, to_point(thing.velocity)};
  const auto [slimmer, longer] = std::minmax({thing.length, thing.width});
  if (!(slimmer > 0.0)) return {one};
  const int count = static_cast<int>(std::min(std::ceil(longer / slimmer), 1.0 * most));
  const double piece = longer / count;
  const double radius = navvi_floor::norm({slimmer, piece}) / 2.0;
  if (count < 2 || radius >= one.radius) return {one};
  const Point middle = one.center;
  const double along = thing.pose.yaw + (thing.length >= thing.width ? 0.0 : kPi / 2);
  const Point step = piece * Point{std::cos(along), std::sin(along)};
  std::vector<Cylinder> out;
  one.radius = radius;
  for (int i = 0; i < count; ++i) {
    one.center = middle + (0.5 * (count - 1) - i) * step;
    out.push_back(one);
  }
  return out;
}

}  // namespace navvi_nav::guide
