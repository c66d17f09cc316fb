#include "guide/informed_set.hpp"

namespace navvi_nav::guide {

bool InformedSet::better_path(Point from, Point to, double length,
                              const std::vector<Cylinder>& obstacles, double moved,
                              double margin) const {
  if (distance(from, to) >= length) return false;
  return std::any_of(seen_.begin(), seen_.end(), [&](const Cylinder& hole) {
    const double reach = hole.radius + margin;
    if (distance(from, hole.center) + distance(hole.center, to) - 2.0 * reach >= length)
      return false;
    return std::none_of(obstacles.begin(), obstacles.end(), [&](const Cylinder& obstacle) {
      return obstacle.id == hole.id && obstacle.radius >= hole.radius &&
             distance(obstacle.center, hole.center) < moved;
    });
  });
}

}  // namespace navvi_nav::guide
