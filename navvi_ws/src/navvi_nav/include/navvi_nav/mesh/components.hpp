#pragma once

#include <vector>

#include "navvi_nav/mesh/mesh.hpp"

namespace navvi_nav::mesh {

/// Numbers the connected components of a mesh from 0. Keeps its memory.
class Components {
 public:
  /// Sets the component of each polygon.
  void number(Mesh& mesh);

 private:
  std::vector<int> waiting_;
};

}  // namespace navvi_nav::mesh
