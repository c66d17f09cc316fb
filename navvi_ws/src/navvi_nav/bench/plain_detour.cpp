#include "plain_detour.hpp"

#include <DetourNavMeshBuilder.h>

#include <algorithm>
#include <cmath>

namespace navvi_nav::plain {
namespace {

constexpr int kCorners = 6;  // of a polygon
// As in Recast's own samples; areas in cells.
constexpr int kMinRegion = 8 * 8;
constexpr int kMergeRegion = 20 * 20;
constexpr float kMaxError = 1.3F;  // cells
constexpr double kMaxEdge = 12.0;  // m
constexpr unsigned short kNone = 0xFFFF;

using ContourSet = std::unique_ptr<rcContourSet, Release<rcContourSet, rcFreeContourSet>>;
using PolyMesh = std::unique_ptr<rcPolyMesh, Release<rcPolyMesh, rcFreePolyMesh>>;

PolyMesh bake(const Columns& columns, double robot_radius, double robot_height) {
  rcContext context(false);
  const CompactField field =
      walkable(context, columns.window(context, 0, 0, columns.width(), columns.height()),
               robot_radius, robot_height);
  require(rcBuildDistanceField(&context, *field), "rcBuildDistanceField");
  require(rcBuildRegions(&context, *field, 0, kMinRegion, kMergeRegion), "rcBuildRegions");
  const ContourSet contours(rcAllocContourSet());
  require(contours && rcBuildContours(&context, *field, kMaxError,
                                      static_cast<int>(kMaxEdge / columns.cell()), *contours),
          "rcBuildContours");
  PolyMesh mesh(rcAllocPolyMesh());
  require(mesh && rcBuildPolyMesh(&context, *contours, kCorners, *mesh), "rcBuildPolyMesh");
  std::fill_n(mesh->flags, mesh->npolys, kWalk);
  return mesh;
}

}  // namespace

Detour::Detour(const Columns& columns, double robot_radius, double robot_height)
    : mesh_(dtAllocNavMesh()) {
  const PolyMesh mesh = bake(columns, robot_radius, robot_height);
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
  require(dtStatusSucceed(mesh_->init(data, size, DT_TILE_FREE_DATA)), "dtNavMesh::init");

  const double cell = columns.cell();
  const auto low_x = static_cast<int>(std::lround(static_cast<double>(mesh->bmin[0]) / cell));
  const auto low_y = static_cast<int>(std::lround(static_cast<double>(mesh->bmin[2]) / cell));
  for (int i = 0; i < mesh->npolys; ++i) {
    std::vector<std::array<int, 2>> corners;
    for (int k = 0; k < mesh->nvp; ++k) {
      const unsigned short vertex = mesh->polys[2 * mesh->nvp * i + k];
      if (vertex == kNone) break;
      corners.push_back({low_x + mesh->verts[3 * vertex], low_y + mesh->verts[3 * vertex + 2]});
    }
    // Recast's polygons run clockwise where its z is map's y.
    std::int64_t twice_area = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto& a = corners[k];
      const auto& b = corners[(k + 1) % corners.size()];
      twice_area += static_cast<std::int64_t>(a[0]) * b[1] - static_cast<std::int64_t>(a[1]) * b[0];
    }
    if (twice_area < 0) std::reverse(corners.begin(), corners.end());
    if (twice_area != 0) polygons_.push_back(std::move(corners));
  }
}

}  // namespace navvi_nav::plain
