#pragma once

#include "mesh/cut_mesh.hpp"

namespace navvi_nav::mesh {

/// The mesh of `polygons`. Two of them have a portal where their edges overlap over some length,
/// whether or not they share corners; where a portal ends within an edge, its vertex is made a
/// corner of the polygon. So each edge between consecutive corners is a whole portal or a wall.
inline Mesh join(const std::vector<GridPolygon>& polygons, double cell_size) {
  return CutMesh(polygons, cell_size).mesh();
}

}  // namespace navvi_nav::mesh
