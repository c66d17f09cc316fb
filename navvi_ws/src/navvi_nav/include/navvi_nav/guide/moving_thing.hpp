#pragma once

#include <vector>

#include "navvi_nav/geometry.hpp"

namespace navvi_nav::guide {

/// A moving thing as reported: the cylinder about it and, where it is known, the rectangle that
/// it fills of that.
struct MovingThing {
  Cylinder cylinder;
  double yaw = 0.0;  ///< rad, of its heading in map
  double length =
      0.0;  ///< m, along the heading; 0, like the width, where only the cylinder is known
  double width = 0.0;  ///< m

  /// True if the rectangle is none, or has two sides and lies within the cylinder.
  [[nodiscard]] bool sound() const;
};

/// The things as cylinders, which is all that navigation knows of them (R-NAV-4): a long one as a
/// row that covers its rectangle, from front to back, each with the thing's id. So the cylinders of
/// one thing follow each other, as many at each instant.
/// \param most  cylinders for one thing; 1: always the one about it
[[nodiscard]] std::vector<Cylinder> cylinders_of(const std::vector<MovingThing>& things, int most);

}  // namespace navvi_nav::guide
