#pragma once

#include <navvi_floor/floor.hpp>
#include <string>
#include <vector>

#include "geometry.hpp"
#include "mesh/mesh.hpp"

namespace navvi_nav::tool {

/// What is drawn besides the floor and its mesh.
struct PictureOf {
  const map::Floor* floor = nullptr;
  const mesh::Mesh* mesh = nullptr;  ///< null: not drawn
  std::vector<Cylinder> cylinders;
  Path path;                 ///< the guide path; may be empty
  std::vector<Point> turns;  ///< of it, as they are announced
};

/// An SVG picture, x to the right and y up, a metre 20 units wide: obstacles dark, floor light, the
/// mesh in cyan with each component in a shade of its own and its polygons outlined, cylinders
/// orange, the guide path purple with a dot at each turn, start green and goal red; with a legend,
/// a scale and a cross at the origin of map.
[[nodiscard]] std::string svg_of(const PictureOf& what);

}  // namespace navvi_nav::tool
