#include "navvi_nav/windows.hpp"

#include <algorithm>
#include <utility>

namespace navvi_nav {
namespace {

double extent(Point a) { return std::abs(a.x) + std::abs(a.y); }

}  // namespace

void Windows::measure(const Mesh& mesh) {
  Sight sight;
  std::vector<Sight::Glimpse> glimpses;
  windows_.clear();
  corners_.assign(mesh.vertices.size(), Corner{});
  known_ = false;
  for (std::size_t i = 0; i < mesh.polygons.size() && windows_.size() < most_; ++i) {
    for (const int vertex : mesh.polygons[i].corners) {
      Corner& corner = corners_[static_cast<std::size_t>(vertex)];
      if (corner.polygon >= 0 || !mesh.vertices[static_cast<std::size_t>(vertex)].corner) continue;
      glimpses.clear();
      corner.walls = sight.survey(mesh, vertex, static_cast<int>(i), glimpses);
      corner.polygon = static_cast<int>(i);
      for (const Sight::Glimpse& glimpse : glimpses) add(mesh, vertex, glimpse);
    }
  }
  known_ = windows_.size() < most_;
  if (!known_) windows_.clear();
  sort(mesh.polygons.size());
}

/// Where a path can not turn, or only to one side, in both directions of a window's borders, it is
/// so between them: what a wall's side decides is a half-plane.
void Windows::add(const Mesh& mesh, int corner, const Sight::Glimpse& glimpse) {
  Window window{corner, glimpse.right, glimpse.left};
  const Sight::Walls& walls = corners_[static_cast<std::size_t>(corner)].walls;
  if (glimpse.right != Sight::kAll && walls.known) {
    const auto [right_in, right_out] = walls.sides(mesh.at(glimpse.right) - mesh.at(corner));
    const auto [left_in, left_out] = walls.sides(mesh.at(glimpse.left) - mesh.at(corner));
    if (right_in == left_in && right_out == left_out && right_in * right_out != 0) {
      if (right_in != right_out) return;
      window.turned = right_in;
    }
  }
  windows_.push_back(window);
  polygons_.push_back(glimpse.polygon);
}

void Windows::sort(std::size_t polygons) {
  polygons_.resize(windows_.size());
  first_.assign(polygons + 1, 0);
  for (const int polygon : polygons_) ++first_[static_cast<std::size_t>(polygon) + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  std::vector<Window> sorted(windows_.size());
  for (std::size_t i = 0; i < windows_.size(); ++i)
    sorted[next[static_cast<std::size_t>(polygons_[i])]++] = windows_[i];
  windows_ = std::move(sorted);
  polygons_ = {};
}

const std::vector<Sight::Corner>& Windows::look(const Mesh& mesh, const Mesh::Place& place) {
  seen_.clear();
  surround(mesh, place, around_);
  for (const int polygon : around_) {
    const auto index = static_cast<std::size_t>(polygon);
    for (std::uint32_t i = first_[index]; i < first_[index + 1]; ++i) {
      const Window& window = windows_[i];
      const Point from = mesh.at(window.corner);
      const Point to = place.point - from;
      if (window.right != Sight::kAll) {
        const Point right = mesh.at(window.right) - from;
        const Point left = mesh.at(window.left) - from;
        if (std::min(cross(right, to), cross(to, left)) < 0.0 &&
            (side_of(right, extent(right), to, extent(to)) < 0 ||
             side_of(left, extent(left), to, extent(to)) > 0))
          continue;
      } else if (extent(to) == 0.0) {
        continue;
      }
      const Corner& corner = corners_[static_cast<std::size_t>(window.corner)];
      int turned = window.turned;
      if (turned == kAsk) {
        const std::optional<int> told = corner.walls.turn(to);
        if (!told) continue;
        turned = *told;
      }
      seen_.push_back({-1.0 * to, norm(to), window.corner, corner.polygon,
                       static_cast<std::int8_t>(-turned), 0});
    }
  }
  return seen_;
}

}  // namespace navvi_nav
