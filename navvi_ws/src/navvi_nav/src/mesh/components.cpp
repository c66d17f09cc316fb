#include "navvi_nav/mesh/components.hpp"

namespace navvi_nav::mesh {

void Components::number(Mesh& mesh) {
  int next_component = 0;
  for (Polygon& polygon : mesh.polygons) polygon.component = -1;
  for (std::size_t seed = 0; seed < mesh.polygons.size(); ++seed) {
    if (mesh.polygons[seed].component >= 0) continue;
    mesh.polygons[seed].component = next_component;
    waiting_.push_back(static_cast<int>(seed));
    while (!waiting_.empty()) {
      const auto at = static_cast<std::size_t>(waiting_.back());
      waiting_.pop_back();
      for (const Portal& portal : mesh.polygons[at].portals) {
        Polygon& next = mesh.polygons[static_cast<std::size_t>(portal.to)];
        if (next.component >= 0) continue;
        next.component = next_component;
        waiting_.push_back(portal.to);
      }
    }
    ++next_component;
  }
}

}  // namespace navvi_nav::mesh
