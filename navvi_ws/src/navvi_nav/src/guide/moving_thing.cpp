#include "navvi_nav/guide/moving_thing.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kRounding = 1e-3;  // m, by which a rectangle may stick out of its cylinder

}  // namespace

bool MovingThing::sound() const {
  if (length == 0.0 && width == 0.0) return true;
  return length > 0.0 && width > 0.0 &&
         std::hypot(length, width) / 2.0 <= cylinder.radius + kRounding;
}

std::vector<Cylinder> cylinders_of(const std::vector<MovingThing>& things, int most) {
  std::vector<Cylinder> out;
  out.reserve(things.size());
  for (const MovingThing& thing : things) {
    const double longer = std::max(thing.length, thing.width);
    const double slimmer = std::min(thing.length, thing.width);
    const int count =
        slimmer > 0.0 ? static_cast<int>(std::min(std::ceil(longer / slimmer), 1.0 * most)) : 1;
    Cylinder one = thing.cylinder;
    const double piece = longer / count;
    const double radius = std::hypot(slimmer, piece) / 2.0;
    if (count < 2 || radius >= one.radius) {
      out.push_back(one);
      continue;
    }
    one.radius = radius;
    const double along = thing.yaw + (thing.length >= thing.width ? 0.0 : M_PI / 2);
    const Point step = piece * Point{std::cos(along), std::sin(along)};
    for (int i = 0; i < count; ++i) {
      one.center = thing.cylinder.center + (0.5 * (count - 1) - i) * step;
      out.push_back(one);
    }
  }
  return out;
}

}  // namespace navvi_nav::guide
