#pragma once

#include <vector>

#include "navvi_nav/mesh.hpp"

namespace navvi_nav {

/// Numbers the connected components of a mesh from 0. Keeps its memory.
class Components {
 public:
  /// Sets the component of each polygon.
  void number(Mesh& mesh);

 private:
  std::vector<int> waiting_;
};

}  // namespace navvi_nav
