#pragma once

#include <octomap/OcTree.h>

#include "navvi_floor/octomap_reader.hpp"

namespace navvi_floor {

/// The occupied leaves of octomap's own tree, by its own iterator.
inline Voxels voxels_of(const octomap::OcTree& tree) {
  Voxels out;
  out.resolution = tree.getResolution();
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const octomap::OcTreeKey low = leaf.getIndexKey();
    const int level = kMapDepth - static_cast<int>(leaf.getDepth());
    const int away = ~((2 << level) - 1);
    const int bit =
        ((low[0] >> level) & 1) | ((low[1] >> level) & 1) << 1 | ((low[2] >> level) & 1) << 2;
    out.octets.push_back({static_cast<std::uint16_t>(low[0] & away),
                          static_cast<std::uint16_t>(low[1] & away),
                          static_cast<std::uint16_t>(low[2] & away),
                          static_cast<std::uint8_t>(level), static_cast<std::uint8_t>(1 << bit)});
  }
  return out;
}

}  // namespace navvi_floor
