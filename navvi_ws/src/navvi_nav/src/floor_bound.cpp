#include "navvi_nav/floor_bound.hpp"

namespace navvi_nav {

void FloorBound::aim(const Mesh& mesh, const Landmarks& landmarks) {
  mesh_ = &mesh;
  landmarks_ = &landmarks;
  if (known_.size() < mesh.vertices.size()) known_.resize(mesh.vertices.size());
  if (floor_known_.size() < mesh.floor->vertices.size())
    floor_known_.resize(mesh.floor->vertices.size());
  if (++query_ == 0) {
    std::fill(known_.begin(), known_.end(), Known{});
    std::fill(floor_known_.begin(), floor_known_.end(), Known{});
    query_ = 1;
  }
}

/// From a point of the link, one end or the other can be gone to first: from neither is it farther
/// to the goal than from the point and along the link together. That binds least where both say the
/// same.
double FloorBound::through(int polygon, int link_right, int link_left, Point right, Point left) {
  const double of_right = find(link_right, polygon);
  const double of_left = find(link_left, polygon);
  const Point from = mesh_->at(link_right);
  const double width = distance(from, mesh_->at(link_left));
  const double first = distance(from, right);  // along the link
  const double last = distance(from, left);
  const double same = 0.5 * (of_right - of_left + width);
  if (same < first) return of_left - (width - first);
  return of_right - std::min(same, last);
}

double FloorBound::find(int vertex, int polygon) {
  Known& known = known_[static_cast<std::size_t>(vertex)];
  if (known.query == query_) return known.least;
  double least = of_floor(vertex);
  if (least <= 0.0) {
    // A corner of a hole lies within a polygon of the floor, and sees all of that one's corners.
    const Point here = mesh_->at(vertex);
    for (const int corner : mesh_->floor->polygon(mesh_->polygon(polygon).ground).corners)
      least = std::max(least, of_floor(corner) - distance(here, mesh_->floor->at(corner)));
  }
  known = {least, query_};
  return least;
}

double FloorBound::of_floor(int vertex) {
  if (static_cast<std::size_t>(vertex) >= mesh_->floor->vertices.size()) return 0.0;
  Known& known = floor_known_[static_cast<std::size_t>(vertex)];
  if (known.query == query_) return known.least;
  if (!mesh_->floor->vertices[static_cast<std::size_t>(vertex)].corner) return 0.0;
  known = {std::max(0.0, landmarks_->at_least(vertex)), query_};
  return known.least;
}

}  // namespace navvi_nav
