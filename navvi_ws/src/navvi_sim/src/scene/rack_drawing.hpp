#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scene/painter.hpp"

namespace navvi_sim::scene {

/// m, the longest block in a list: RViz leaves out a list of blocks of which it sees no centre, and
/// darkens blocks towards their ends.
constexpr double kLongestBlock = 1.25;

struct ColoredBlock {
  Eigen::AlignedBox3d block;  ///< m, about the centre of the box that it is drawn for
  Color color;
};

/// How a box of a shelf is drawn, so that the shelf is seen into: a large block as an open rack of
/// uprights and boards, the highest board as a rim. No block is longer than kLongestBlock.
/// \param size     m, of the box
/// \param highest  nothing of the shelf is above it
[[nodiscard]] std::vector<ColoredBlock> shelf_parts(const Eigen::Vector3d& size, bool highest);

}  // namespace navvi_sim::scene
