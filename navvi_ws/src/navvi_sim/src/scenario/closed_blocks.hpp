#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "scenario/floor_grid.hpp"

namespace navvi_sim::scenario {

/// Floor that a closed mesh encloses, though the map shows it free: meshes that are wide or have
/// many triangles are surfaces there, since they may be buildings. What encloses other things, or
/// is a floor or a wall, is no block. A hollow in a block, as between a building's outer and inner
/// walls, is not in it.
class ClosedBlocks {
 public:
  /// \param grid  of the floor of `world` \param clear  m, of places that matter
  ClosedBlocks(const WorldDescription& world, const FloorGrid& grid, double clear);

  [[nodiscard]] bool holds(std::size_t cell) const { return !marks_.empty() && marks_[cell] != 0; }
  /// The name of the thing that a cell is enclosed by; empty if it is not.
  [[nodiscard]] std::string name_at(std::size_t cell) const {
    return holds(cell) ? names_[marks_[cell] - 1U] : "";
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::uint32_t> marks_;  ///< by cell: 0, or 1 + the index of a name; empty: all 0
};

}  // namespace navvi_sim::scenario
