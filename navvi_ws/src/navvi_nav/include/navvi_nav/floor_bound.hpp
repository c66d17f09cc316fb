#pragma once

#include <cstdint>
#include <vector>

#include "navvi_nav/landmarks.hpp"

namespace navvi_nav {

/// Lower bounds of the way to a goal on a mesh with holes, from landmarks of its floor. Holes only
/// take room away: whatever way is left was there without them, and no shorter. So what was
/// measured once on the floor holds whatever holes come, go and move.
class FloorBound {
 public:
  /// \param landmarks  of mesh.floor, aimed at the goal
  void aim(const Mesh& mesh, const Landmarks& landmarks);

  /// m, from a vertex; 0 for one that no link brought up yet.
  [[nodiscard]] double of(int vertex) const {
    const Known& known = known_[static_cast<std::size_t>(vertex)];
    return known.query == query_ ? known.least : 0.0;
  }
  /// m, at least, from any point between two of a link. \param polygon  that has the link
  [[nodiscard]] double through(int polygon, int link_right, int link_left, Point right, Point left);

 private:
  struct Known {
    double least = 0.0;
    std::uint32_t query = 0;
  };
  double find(int vertex, int polygon);
  double of_floor(int vertex);

  const Mesh* mesh_ = nullptr;
  const Landmarks* landmarks_ = nullptr;
  std::uint32_t query_ = 0;
  std::vector<Known> known_;  // of the mesh's vertices
  /// Of the floor's. The same number can stand for another side of a pinch there.
  std::vector<Known> floor_known_;
};

}  // namespace navvi_nav
