#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <navvi_floor/octomap_reader.hpp>
#include <vector>

#include "occupancy/closed_mesh.hpp"
#include "occupancy/solid.hpp"

namespace navvi_sim::occupancy {

/// A cube of 2^level voxels a side, in voxels from the lowest corner of the tree.
struct VoxelCube {
  std::array<int, 3> low;
  int level;
};

/// The eighth `i` of a cube of more than one voxel.
[[nodiscard]] inline VoxelCube octant(const VoxelCube& cube, unsigned i) {
  const int half = 1 << (cube.level - 1);
  return {{cube.low[0] + ((i & 1U) ? half : 0), cube.low[1] + ((i & 2U) ? half : 0),
           cube.low[2] + ((i & 4U) ? half : 0)},
          cube.level - 1};
}

/// 4 x 4 x 4 voxels, one a bit, in the order in which an octree has them: bit 8 i + k is the eighth
/// k of the eighth i.
using Brick = std::uint64_t;
inline constexpr int kBrickLevel = 2;

/// A box of voxels, and what a cube has of it.
struct VoxelBox : navvi_floor::VoxelBox {
  [[nodiscard]] Octants octants(const VoxelCube& cube) const {
    Octants all{0xFFU, 0xFFU};
    const int half = 1 << (cube.level - 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Along each axis alone: the eighths below the cube's middle, and those above it.
      constexpr std::array<unsigned, 3> kAbove{0b10101010U, 0b11001100U, 0b11110000U};
      const unsigned above = kAbove[axis];
      const int begin = cube.low[axis];
      const int middle = begin + half;
      const int end = middle + half;
      const auto pick = [above](bool lower, bool upper) {
        return (lower ? ~above : 0U) | (upper ? above : 0U);
      };
      all.touched &=
          pick(low[axis] < middle && high[axis] > begin, low[axis] < end && high[axis] > middle);
      all.full &= pick(low[axis] <= begin && high[axis] >= middle,
                       low[axis] <= middle && high[axis] >= end);
    }
    return all;
  }

  /// The axes along which all of the cube has the same of this box: bits 0, 1, 2 for x, y, z.
  [[nodiscard]] unsigned spans(const VoxelCube& cube) const {
    unsigned axes = 0;
    const int side = 1 << cube.level;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (low[axis] <= cube.low[axis] && high[axis] >= cube.low[axis] + side) axes |= 1U << axis;
    return axes;
  }

  /// What of a cube of kBrickLevel is in this box.
  [[nodiscard]] Brick brick(const VoxelCube& cube) const {
    // Of the voxels in each of the four layers along an axis, those of the layers below a bound.
    constexpr std::array<std::array<Brick, 5>, 3> kBelow{{
        {0, 0x0055005500550055U, 0x00FF00FF00FF00FFU, 0x55FF55FF55FF55FFU, ~Brick{0}},
        {0, 0x0000333300003333U, 0x0000FFFF0000FFFFU, 0x3333FFFF3333FFFFU, ~Brick{0}},
        {0, 0x000000000F0F0F0FU, 0x00000000FFFFFFFFU, 0x0F0F0F0FFFFFFFFFU, ~Brick{0}},
    }};
    Brick all = ~Brick{0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto bound = [&](int at) {
        return kBelow[axis][static_cast<std::size_t>(std::clamp(at - cube.low[axis], 0, 4))];
      };
      all &= bound(high[axis]) & ~bound(low[axis]);
    }
    return all;
  }
};

/// The shapes to put into a map, by how their voxels are found.
struct OccupiedShapes {
  /// A solid must reach into a voxel by this much on each side.
  struct Filled {
    Solid solid;
    double reach;  ///< m
  };
  std::vector<VoxelBox> boxes;  ///< nearly everything in most worlds
  std::vector<Filled> solids;
  std::vector<ClosedMesh> closed;
  std::vector<Triangle> triangles;
};

/// Writes the voxels that `shapes` occupy as a pruned octree in octomap's binary format
/// (occupancy_map.hpp), from the root down, with no tree in memory. That is why it is not octomap's
/// own: a session in `warehouse` would wait 3.8 s for the map, voxel by voxel, and not 0.01 s.
/// \param resolution  m, edge of a voxel
/// \throws WorldError if it comes to more than `most` bytes
[[nodiscard]] std::vector<std::int8_t> write_octree(const OccupiedShapes& shapes, double resolution,
                                                    std::size_t most);

}  // namespace navvi_sim::occupancy
