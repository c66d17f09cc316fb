#include "mesh/components.hpp"

#include <algorithm>

namespace navvi_nav::mesh {

void Components::number(Mesh& mesh) {
  next_ = 0;
  for (Polygon& polygon : mesh.polygons) polygon.component = -1;
  for (std::size_t seed = 0; seed < mesh.polygons.size(); ++seed) {
    if (mesh.polygons[seed].component >= 0) continue;
    mesh.polygons[seed].component = next_;
    waiting_.push_back(static_cast<int>(seed));
    while (!waiting_.empty()) {
      const auto at = static_cast<std::size_t>(waiting_.back());
      waiting_.pop_back();
      for (const Portal& portal : mesh.polygons[at].portals) {
        Polygon& next = mesh.polygons[static_cast<std::size_t>(portal.to)];
        if (next.component >= 0) continue;
        next.component = next_;
        waiting_.push_back(portal.to);
      }
    }
    ++next_;
  }
}

void Components::update(Mesh& mesh, const std::vector<Changed>& changed) {
  bool kept = false;
  if (3 * changed.size() <= mesh.polygons.size()) {
    groups_.grow(mesh.polygons.size());
    for (const Changed& here : changed) groups_.add(here.polygon);
    for (const Changed& here : changed) {
      for (const Portal& portal : mesh.polygon(here.polygon).portals) {
        if (groups_.has(portal.to)) groups_.unite(here.polygon, portal.to);
      }
    }
    kept = label(mesh, changed);
    for (const Changed& here : changed) groups_.remove(here.polygon);
  }
  if (!kept) number(mesh);
}

/// \returns false if a component may have been split or joined
bool Components::label(Mesh& mesh, const std::vector<Changed>& changed) {
  kept_.clear();
  labels_.resize(mesh.polygons.size());
  for (const Changed& here : changed) {
    labels_[slot(here.polygon)] = -1;
    if (!here.fresh)
      kept_.push_back(
          {here.region, mesh.polygon(here.polygon).component, groups_.root(here.polygon)});
  }
  std::sort(kept_.begin(), kept_.end());
  kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const auto [region, component, group] = kept_[i];
    if (i > 0 && kept_[i - 1][0] == region && kept_[i - 1][1] == component)
      return false;  // perhaps split
    int& label = labels_[slot(group)];
    if (label >= 0 && label != component) return false;  // joined
    label = component;
  }
  for (const Changed& here : changed) {
    if (!here.fresh) continue;
    int& component = labels_[slot(groups_.root(here.polygon))];
    if (component < 0) component = next_++;
    mesh.polygons[slot(here.polygon)].component = component;
  }
  return true;
}

}  // namespace navvi_nav::mesh
