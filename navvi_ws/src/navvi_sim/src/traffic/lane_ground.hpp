#pragma once

#include <functional>
#include <string>
#include <vector>

#include "traffic/lanes.hpp"

namespace navvi_sim::traffic {

/// A thing's name for sentences.
[[nodiscard]] inline std::string quoted(const Thing& thing) { return "'" + thing.name + "'"; }

/// The ground that a body sweeps between two places of its track, a little wider in curves.
[[nodiscard]] Polygon swept(const Track& track, const Footprint& print, double from, double to);

/// The ground of each block of a lane.
[[nodiscard]] std::vector<Polygon> ground_of(const Lane& lane);

/// What stands, seen from above: a polygon a shape or triangle, with its heights.
struct Standing {
  std::size_t thing;  ///< index in WorldDescription::things
  double bottom;      ///< m, in map
  double top;         ///< m
  Polygon polygon;
};

/// Shows all that stands higher than `least` m above the floor, piece by piece: meshes are large.
void for_each_standing(const WorldDescription& world, double least,
                       const std::function<void(const Standing&)>& visit);

}  // namespace navvi_sim::traffic
