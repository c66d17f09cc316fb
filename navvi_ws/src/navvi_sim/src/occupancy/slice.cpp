#include "navvi_sim/occupancy/slice.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_sim::occupancy {

Slice slice_of(const OccupancyMap& map, double floor, double height) {
  const double side = map.resolution();
  const int ground = static_cast<int>(std::round(floor / side)) - 1;
  const int plane = ground + 1 + static_cast<int>(height / side);
  const auto in = [](const OccupiedCube& cube, int z) {
    return cube.z <= z && z < cube.z + cube.side;
  };
  int low_x = OccupancyMap::kCenter, low_y = low_x, high_x = -low_x, high_y = -low_x;
  map.for_each_cube([&](const OccupiedCube& cube) {
    if (!in(cube, ground) && !in(cube, plane)) return;
    low_x = std::min(low_x, cube.x);
    low_y = std::min(low_y, cube.y);
    high_x = std::max(high_x, cube.x + cube.side);
    high_y = std::max(high_y, cube.y + cube.side);
  });
  Slice out{side, {low_x * side, low_y * side}, high_x - low_x, high_y - low_y, {}};
  if (out.width <= 0) return {};
  out.cells.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height), -1);
  map.for_each_cube([&](const OccupiedCube& cube) {
    const bool occupied = in(cube, plane);
    if (!occupied && !in(cube, ground)) return;
    for (int y = cube.y - low_y; y < cube.y - low_y + cube.side; ++y)
      for (int x = cube.x - low_x; x < cube.x - low_x + cube.side; ++x) {
        std::int8_t& cell =
            out.cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width) +
                      static_cast<std::size_t>(x)];
        cell = std::max(cell, static_cast<std::int8_t>(occupied ? 100 : 0));
      }
  });
  return out;
}

}  // namespace navvi_sim::occupancy
