#include "plain_detour.hpp"

#include <DetourNavMesh.h>
#include <DetourNavMeshBuilder.h>
#include <DetourNavMeshQuery.h>
#include <Recast.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace navvi_nav {
namespace {

constexpr int kMaxNodes = 65535;    // the most that Detour can count
constexpr int kMaxPolygons = 4096;  // of one path
constexpr int kCorners = 6;         // of a polygon
constexpr unsigned short kWalk = 1;
// As in Recast's own samples; areas in cells.
constexpr int kMinRegion = 8 * 8;
constexpr int kMergeRegion = 20 * 20;
constexpr float kMaxError = 1.3F;               // cells
constexpr double kMaxEdge = 12.0;               // m
constexpr double kRounding = 1e-6;              // of a cell
constexpr float kFloor = 0.0F;                  // m, Recast's y
constexpr float kNear[3] = {0.5F, 0.3F, 0.5F};  // m, findNearestPoly's half extents

void require(bool done, const char* step) {
  if (!done) throw std::runtime_error(std::string("the plain bake failed in ") + step);
}

template <typename Type, void (*release)(Type*)>
struct Release {
  void operator()(Type* pointer) const { release(pointer); }
};
using HeightField = std::unique_ptr<rcHeightfield, Release<rcHeightfield, rcFreeHeightField>>;
using CompactField =
    std::unique_ptr<rcCompactHeightfield, Release<rcCompactHeightfield, rcFreeCompactHeightfield>>;
using ContourSet = std::unique_ptr<rcContourSet, Release<rcContourSet, rcFreeContourSet>>;
using PolyMesh = std::unique_ptr<rcPolyMesh, Release<rcPolyMesh, rcFreePolyMesh>>;

/// map's z is Recast's y, map's y is Recast's z.
HeightField rasterize(rcContext& context, const octomap::OcTree& tree) {
  double x0, y0, z0, x1, y1, z1;
  tree.getMetricMin(x0, y0, z0);
  tree.getMetricMax(x1, y1, z1);
  const double cell = tree.getResolution();
  const auto cells = [cell](double length) { return static_cast<int>(std::lround(length / cell)); };
  const float low[3] = {static_cast<float>(x0), static_cast<float>(z0), static_cast<float>(y0)};
  const float high[3] = {static_cast<float>(x1), static_cast<float>(z1), static_cast<float>(y1)};
  HeightField field(rcAllocHeightfield());
  require(field && rcCreateHeightfield(&context, *field, cells(x1 - x0), cells(y1 - y0), low, high,
                                       static_cast<float>(cell), static_cast<float>(cell)),
          "rcCreateHeightfield");
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const double half = leaf.getSize() / 2.0;
    const int x = cells(leaf.getX() - half - x0), y = cells(leaf.getY() - half - y0);
    const int bottom = cells(leaf.getZ() - half - z0), side = cells(leaf.getSize());
    for (int column = x; column < x + side; ++column)
      for (int row = y; row < y + side; ++row)
        rcAddSpan(&context, *field, column, row, static_cast<unsigned short>(bottom),
                  static_cast<unsigned short>(bottom + side), RC_WALKABLE_AREA, 0);
  }
  return field;
}

PolyMesh bake(const octomap::OcTree& tree, double robot_radius, double robot_height) {
  rcContext context(false);
  const double cell = tree.getResolution();
  const auto whole = [cell](double length) {
    return static_cast<int>(std::ceil(length / cell - kRounding));
  };
  HeightField heights = rasterize(context, tree);
  rcFilterWalkableLowHeightSpans(&context, whole(robot_height), *heights);
  const CompactField field(rcAllocCompactHeightfield());
  require(field && rcBuildCompactHeightfield(&context, whole(robot_height), 0, *heights, *field),
          "rcBuildCompactHeightfield");
  heights.reset();
  require(rcErodeWalkableArea(&context, whole(robot_radius), *field), "rcErodeWalkableArea");
  require(rcBuildDistanceField(&context, *field), "rcBuildDistanceField");
  require(rcBuildRegions(&context, *field, 0, kMinRegion, kMergeRegion), "rcBuildRegions");
  const ContourSet contours(rcAllocContourSet());
  require(contours && rcBuildContours(&context, *field, kMaxError, whole(kMaxEdge), *contours),
          "rcBuildContours");
  PolyMesh mesh(rcAllocPolyMesh());
  require(mesh && rcBuildPolyMesh(&context, *contours, kCorners, *mesh), "rcBuildPolyMesh");
  for (int i = 0; i < mesh->npolys; ++i) mesh->flags[i] = kWalk;
  return mesh;
}

}  // namespace

struct PlainDetour::Impl {
  std::unique_ptr<dtNavMesh, Release<dtNavMesh, dtFreeNavMesh>> mesh{dtAllocNavMesh()};
  std::unique_ptr<dtNavMeshQuery, Release<dtNavMeshQuery, dtFreeNavMeshQuery>> query{
      dtAllocNavMeshQuery()};
  dtQueryFilter filter;
  int polygons = 0;
  std::array<dtPolyRef, 2> ends{};
  std::array<std::array<float, 3>, 2> points{};
  std::vector<dtPolyRef> corridor = std::vector<dtPolyRef>(kMaxPolygons);
  std::vector<float> corners = std::vector<float>(3 * kMaxPolygons);
};

PlainDetour::PlainDetour(const octomap::OcTree& tree, double robot_radius, double robot_height)
    : impl_(std::make_unique<Impl>()) {
  const PolyMesh mesh = bake(tree, robot_radius, robot_height);
  dtNavMeshCreateParams params{};
  params.verts = mesh->verts;
  params.vertCount = mesh->nverts;
  params.polys = mesh->polys;
  params.polyFlags = mesh->flags;
  params.polyAreas = mesh->areas;
  params.polyCount = mesh->npolys;
  params.nvp = mesh->nvp;
  std::copy_n(mesh->bmin, 3, params.bmin);
  std::copy_n(mesh->bmax, 3, params.bmax);
  params.walkableHeight = static_cast<float>(robot_height);
  params.walkableRadius = static_cast<float>(robot_radius);
  params.walkableClimb = mesh->ch;
  params.cs = mesh->cs;
  params.ch = mesh->ch;
  params.buildBvTree = true;
  unsigned char* data = nullptr;
  int size = 0;
  require(dtCreateNavMeshData(&params, &data, &size), "dtCreateNavMeshData");
  require(dtStatusSucceed(impl_->mesh->init(data, size, DT_TILE_FREE_DATA)), "dtNavMesh::init");
  require(dtStatusSucceed(impl_->query->init(impl_->mesh.get(), kMaxNodes)),
          "dtNavMeshQuery::init");
  impl_->polygons = mesh->npolys;
}

PlainDetour::~PlainDetour() = default;

int PlainDetour::polygons() const { return impl_->polygons; }

bool PlainDetour::locate(Point start, Point goal) {
  const std::array<Point, 2> wanted{start, goal};
  for (std::size_t i = 0; i < 2; ++i) {
    const float center[3] = {static_cast<float>(wanted[i].x), kFloor,
                             static_cast<float>(wanted[i].y)};
    impl_->query->findNearestPoly(center, kNear, &impl_->filter, &impl_->ends[i],
                                  impl_->points[i].data());
  }
  return impl_->ends[0] != 0 && impl_->ends[1] != 0;
}

Path PlainDetour::search() {
  const float* from = impl_->points[0].data();
  const float* to = impl_->points[1].data();
  int polygons = 0;
  const dtStatus found =
      impl_->query->findPath(impl_->ends[0], impl_->ends[1], from, to, &impl_->filter,
                             impl_->corridor.data(), &polygons, kMaxPolygons);
  if (dtStatusFailed(found) || dtStatusDetail(found, DT_PARTIAL_RESULT)) return {};
  int count = 0;
  const dtStatus drawn =
      impl_->query->findStraightPath(from, to, impl_->corridor.data(), polygons,
                                     impl_->corners.data(), nullptr, nullptr, &count, kMaxPolygons);
  if (dtStatusFailed(drawn)) return {};
  Path path;
  for (int i = 0; i < count; ++i) {
    const float* corner = &impl_->corners[static_cast<std::size_t>(3 * i)];
    path.push_back({static_cast<double>(corner[0]), static_cast<double>(corner[2])});
  }
  return path;
}

}  // namespace navvi_nav
