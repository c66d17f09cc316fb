#include "navvi_nav/parts.hpp"

namespace navvi_nav {
namespace {

std::size_t slot(int index) { return static_cast<std::size_t>(index); }

}  // namespace

int Forest::root(int node) {
  while (parents_[slot(node)] != node) {
    parents_[slot(node)] = parents_[slot(parents_[slot(node)])];
    node = parents_[slot(node)];
  }
  return node;
}

void Parts::number(Mesh& mesh) {
  next_ = 0;
  for (Polygon& polygon : mesh.polygons) polygon.part = -1;
  for (std::size_t seed = 0; seed < mesh.polygons.size(); ++seed) {
    if (mesh.polygons[seed].part >= 0) continue;
    mesh.polygons[seed].part = next_;
    waiting_.push_back(static_cast<int>(seed));
    while (!waiting_.empty()) {
      const auto at = static_cast<std::size_t>(waiting_.back());
      waiting_.pop_back();
      for (const Link& link : mesh.polygons[at].links) {
        Polygon& next = mesh.polygons[static_cast<std::size_t>(link.to)];
        if (next.part >= 0) continue;
        next.part = next_;
        waiting_.push_back(link.to);
      }
    }
    ++next_;
  }
}

void Parts::update(Mesh& mesh, const std::vector<Changed>& changed) {
  bool kept = false;
  if (3 * changed.size() <= mesh.polygons.size()) {
    groups_.grow(mesh.polygons.size());
    for (const Changed& here : changed) groups_.add(here.polygon);
    for (const Changed& here : changed) {
      for (const Link& link : mesh.polygon(here.polygon).links) {
        if (groups_.has(link.to)) groups_.unite(here.polygon, link.to);
      }
    }
    kept = label(mesh, changed);
    for (const Changed& here : changed) groups_.remove(here.polygon);
  }
  if (!kept) number(mesh);
}

/// \returns false if a part may have been split or joined
bool Parts::label(Mesh& mesh, const std::vector<Changed>& changed) {
  witnesses_.clear();
  labels_.resize(mesh.polygons.size());
  for (const Changed& here : changed) {
    labels_[slot(here.polygon)] = -1;
    if (!here.fresh)
      witnesses_.push_back(
          {here.region, mesh.polygon(here.polygon).part, groups_.root(here.polygon)});
  }
  std::sort(witnesses_.begin(), witnesses_.end(), [](const Witness& a, const Witness& b) {
    return a.region != b.region ? a.region < b.region : a.part < b.part;
  });
  for (std::size_t i = 0; i < witnesses_.size(); ++i) {
    const Witness& here = witnesses_[i];
    if (i > 0 && witnesses_[i - 1].region == here.region && witnesses_[i - 1].part == here.part &&
        witnesses_[i - 1].group != here.group)
      return false;  // perhaps split
    int& part = labels_[slot(here.group)];
    if (part >= 0 && part != here.part) return false;  // joined
    part = here.part;
  }
  for (const Changed& here : changed) {
    if (!here.fresh) continue;
    int& part = labels_[slot(groups_.root(here.polygon))];
    if (part < 0) part = next_++;
    mesh.polygons[slot(here.polygon)].part = part;
  }
  return true;
}

}  // namespace navvi_nav
