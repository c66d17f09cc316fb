/// What the plain uses of Recast and Detour in these benchmarks share.

#pragma once

#include <DetourNavMesh.h>
#include <DetourNavMeshQuery.h>
#include <DetourTileCache.h>
#include <DetourTileCacheBuilder.h>
#include <Recast.h>
#include <octomap/OcTree.h>

#include <array>
#include <memory>
#include <vector>

#include "geometry.hpp"

namespace navvi_nav::plain {

template <typename Type, void (*release)(Type*)>
struct Release {
  void operator()(Type* pointer) const { release(pointer); }
};
using HeightField = std::unique_ptr<rcHeightfield, Release<rcHeightfield, rcFreeHeightField>>;
using CompactField =
    std::unique_ptr<rcCompactHeightfield, Release<rcCompactHeightfield, rcFreeCompactHeightfield>>;
using NavMesh = std::unique_ptr<dtNavMesh, Release<dtNavMesh, dtFreeNavMesh>>;

constexpr unsigned short kWalk = 1;  // polygons' flag

void require(bool done, const char* step);

/// The occupied voxels of a map as columns of spans, ready for Recast.
class Columns {
 public:
  explicit Columns(const octomap::OcTree& tree);

  [[nodiscard]] int width() const { return width_; }    ///< cells, along x
  [[nodiscard]] int height() const { return height_; }  ///< cells, along map's y
  [[nodiscard]] double cell() const { return cell_; }   ///< m, cell and level
  [[nodiscard]] std::array<float, 3> low() const;       ///< m, Recast's axes
  /// The spans of a window; cells outside the map are empty. Map's z is Recast's y, map's y its z.
  [[nodiscard]] HeightField window(rcContext& context, int x, int y, int columns, int rows) const;

 private:
  [[nodiscard]] HeightField field(rcContext& context, int x, int y, int columns, int rows) const;

  double cell_;
  std::array<double, 3> low_{};
  int width_ = 0;
  int height_ = 0;
  int levels_ = 0;
  HeightField all_;
};

/// Walkable, eroded, with distances not yet made.
[[nodiscard]] CompactField walkable(rcContext& context, HeightField heights, double robot_radius,
                                    double robot_height);

/// Detour's own A* on edge midpoints and its own funnel, with as many nodes as it can count.
class Query {
 public:
  explicit Query(const dtNavMesh& mesh);

  /// Sets where the next search() runs: findNearestPoly for both ends.
  /// \returns false if either is off the mesh
  bool locate(Point start, Point goal);
  /// findPath and findStraightPath. \returns empty if there is no path or only a part of one
  [[nodiscard]] Path search();

 private:
  std::unique_ptr<dtNavMeshQuery, Release<dtNavMeshQuery, dtFreeNavMeshQuery>> query_;
  dtQueryFilter filter_;
  std::array<dtPolyRef, 2> ends_{};
  std::array<std::array<float, 3>, 2> points_{};
  std::vector<dtPolyRef> corridor_;
  std::vector<float> corners_;
};

/// DetourTileCache used as its sample does: tiles of height field layers, rebuilt where obstacles
/// come and go, without packing them, and with memory from an arena.
class TileCache {
 public:
  /// \param tile  cells along a tile, at most 240
  TileCache(const Columns& columns, double robot_radius, double robot_height, int tile);
  ~TileCache();

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
