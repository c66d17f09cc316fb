#pragma once

#include <DetourTileCache.h>
#include <DetourTileCacheBuilder.h>

#include <memory>
#include <vector>

#include "plain_recast.hpp"

namespace navvi_nav::plain {

/// DetourTileCache used as its sample does: tiles of height field layers, rebuilt where obstacles
/// come and go, without packing them, and with memory from an arena.
class TileCache {
 public:
  /// \param tile  cells along a tile, at most 240
  TileCache(const Columns& columns, double robot_radius, double robot_height, int tile);
  ~TileCache();
  TileCache(const TileCache&) = delete;
  TileCache& operator=(const TileCache&) = delete;

  /// Takes the obstacles of the last call away, puts these, and rebuilds until all is done.
  void place(const std::vector<Cylinder>& cylinders);
  [[nodiscard]] const dtNavMesh& mesh() const { return *mesh_; }

 private:
  struct Arena;
  struct Copy;
  struct Flags;
  void add_tile(const Columns& columns, int tx, int ty, int tile, double robot_radius,
                double robot_height);
  void catch_up();

  std::unique_ptr<Arena> arena_;
  std::unique_ptr<Copy> copy_;
  std::unique_ptr<Flags> flags_;
  std::unique_ptr<dtTileCache, Release<dtTileCache, dtFreeTileCache>> cache_;
  NavMesh mesh_;
  double robot_radius_;
  double robot_height_;
  std::vector<dtObstacleRef> placed_;
};

}  // namespace navvi_nav::plain
