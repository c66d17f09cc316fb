#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace navvi_sim::occupancy {

/// An occupied cube of an octree. Voxel (0, 0, 0) has its lower corner at the origin of map.
struct OccupiedCube {
  int x = 0;  ///< voxels, lower corner
  int y = 0;
  int z = 0;
  int side = 1;  ///< voxels
};

/// A pruned octree of occupied space as octomap writes it in binary (OcTree::writeBinaryData),
/// which is what octomap_msgs/Octomap carries: from the root down, for each inner node two bits a
/// child, the first child in the lowest bits, then its inner children in order. 00 is unknown, 01
/// as a number (low bit) free, 10 occupied, 11 inner.
class OccupancyMap {
 public:
  static constexpr int kDepth = 16;                  ///< levels of octomap's trees
  static constexpr int kCenter = 1 << (kDepth - 1);  ///< voxels from the tree's lowest corner to
                                                     ///< the origin of map

  /// \param resolution  m, edge of a voxel
  /// \param stream  well-formed; empty if nothing is occupied
  OccupancyMap(double resolution, std::vector<std::int8_t> stream)
      : resolution_(resolution), stream_(std::move(stream)) {}

  [[nodiscard]] double resolution() const { return resolution_; }  ///< m
  [[nodiscard]] const std::vector<std::int8_t>& stream() const { return stream_; }

  /// The number of nodes, free ones too, as OcTree::size() gives it.
  [[nodiscard]] std::size_t nodes() const {
    std::size_t count = stream_.empty() ? 0 : 1;
    for (const std::int8_t children : stream_)
      for (unsigned bits = static_cast<std::uint8_t>(children); bits != 0; bits >>= 2U)
        count += (bits & 3U) != 0 ? 1 : 0;
    return count;
  }

  /// Calls visit(OccupiedCube, whole) for each node below the root that is not free, a node before
  /// its children: `whole` if all of the cube is occupied, and else a part.
  template <typename Visit>
  void for_each_node(const Visit& visit) const {
    std::size_t at = 0;
    if (!stream_.empty()) walk({-kCenter, -kCenter, -kCenter, 2 * kCenter}, at, visit);
  }

  /// Calls visit(OccupiedCube) for all that is occupied, in octomap's order of leaves.
  /// \param finest  voxels, a power of two: a cube of this side that is occupied in part is visited
  ///                as a whole
  template <typename Visit>
  void for_each_cube(const Visit& visit, int finest = 1) const {
    for_each_node([&](const OccupiedCube& cube, bool whole) {
      if (cube.side == finest || (whole && cube.side > finest)) visit(cube);
    });
  }

 private:
  /// \param at  where the cube's node stands in the stream; is moved to what follows its last one
  template <typename Visit>
  void walk(const OccupiedCube& cube, std::size_t& at, const Visit& visit) const {
    const unsigned bits = static_cast<std::uint8_t>(stream_[at]) |
                          static_cast<unsigned>(static_cast<std::uint8_t>(stream_[at + 1])) << 8;
    at += 2;
    const int half = cube.side / 2;
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned kind = bits >> (2 * i) & 3U;
      if (kind < 2) continue;
      const OccupiedCube child{cube.x + ((i & 1U) ? half : 0), cube.y + ((i & 2U) ? half : 0),
                               cube.z + ((i & 4U) ? half : 0), half};
      visit(child, kind == 2);
      if (kind == 3) walk(child, at, visit);
    }
  }

  double resolution_;
  std::vector<std::int8_t> stream_;
};

}  // namespace navvi_sim::occupancy
