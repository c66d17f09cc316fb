#include "navvi_nav/tile_bake.hpp"

#include <Recast.h>
#include <RecastAlloc.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

#include "outline.hpp"

namespace navvi_nav {
namespace {

template <typename Type, void (*free)(Type*)>
struct Free {
  void operator()(Type* pointer) const { free(pointer); }
};
using CompactField =
    std::unique_ptr<rcCompactHeightfield, Free<rcCompactHeightfield, rcFreeCompactHeightfield>>;
using ContourSet = std::unique_ptr<rcContourSet, Free<rcContourSet, rcFreeContourSet>>;
using PolyMesh = std::unique_ptr<rcPolyMesh, Free<rcPolyMesh, rcFreePolyMesh>>;

constexpr int kBorder = 1;    // cells
constexpr int kColours = 62;  // areas that Recast leaves to the user

void require(bool done, const char* step) {
  if (!done) throw std::runtime_error(std::string("Recast ran out of memory in ") + step);
}

template <typename Type>
Type* allocate(int count) {
  auto* out =
      static_cast<Type*>(rcAlloc(sizeof(Type) * static_cast<std::size_t>(count), RC_ALLOC_PERM));
  require(out != nullptr, "rcAlloc");
  std::fill_n(out, count, Type{});
  return out;
}

/// A compact height field with one span for each open cell, as rcBuildCompactHeightfield would make
/// it of a single level.
CompactField compact_field(const TileCells& cells) {
  CompactField out(rcAllocCompactHeightfield());
  require(out != nullptr, "rcAllocCompactHeightfield");
  const int side = cells.size + 2 * kBorder;
  out->width = out->height = side;
  out->borderSize = 0;
  out->walkableHeight = 1;
  out->cs = out->ch = 1.0F;
  out->bmax[0] = out->bmax[2] = static_cast<float>(side);
  out->bmax[1] = 1.0F;
  out->cells = allocate<rcCompactCell>(side * side);
  int count = 0;
  for (int at = 0; at < side * side; ++at) {
    out->cells[at].index = static_cast<unsigned>(count) & 0xffffffU;
    out->cells[at].count = cells.open[static_cast<std::size_t>(at)];
    count += cells.open[static_cast<std::size_t>(at)];
  }
  out->spanCount = count;
  out->spans = allocate<rcCompactSpan>(count);
  out->areas = allocate<unsigned char>(count);
  std::fill_n(out->areas, count, RC_WALKABLE_AREA);
  rcCompactSpan* span = out->spans;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (out->cells[x + y * side].count == 0) continue;
      for (int direction = 0; direction < 4; ++direction) {
        const int nx = x + rcGetDirOffsetX(direction);
        const int ny = y + rcGetDirOffsetY(direction);
        const bool joined =
            nx >= 0 && ny >= 0 && nx < side && ny < side && out->cells[nx + ny * side].count > 0;
        rcSetCon(*span, direction, joined ? 0 : RC_NOT_CONNECTED);
      }
      span->h = 255;
      ++span;
    }
  }
  return out;
}

/// An area of its own for each region: Recast then keeps the border between two regions on the
/// cells, as it keeps a wall. By default it draws it straight, through whatever stands there.
void colour_regions(rcCompactHeightfield& field) {
  for (int i = 0; i < field.spanCount; ++i) {
    const unsigned short region = field.spans[i].reg;
    if (region == 0 || (region & RC_BORDER_REG) != 0) continue;
    field.areas[i] = static_cast<unsigned char>(1 + region % kColours);
  }
}

/// How a tile's contours are turned into polygons; each try is plainer than the one before.
struct Try {
  bool coloured;
  bool smoothed;
};
constexpr Try kTries[] = {{false, true}, {true, true}, {true, false}};

std::vector<OutlineCorner> outline_of(const rcContour& contour) {
  std::vector<OutlineCorner> out;
  out.reserve(static_cast<std::size_t>(contour.nverts));
  for (int k = 0; k < contour.nverts; ++k) {
    const int* corner = &contour.verts[4 * k];
    out.push_back({corner[0], corner[2], (corner[3] & RC_CONTOUR_REG_MASK) == 0});
  }
  return out;
}

/// Corners on the tile's border stay where they are, too: neighbours match without their removal.
void put_back(const std::vector<OutlineCorner>& outline, rcContour& contour) {
  contour.nverts = static_cast<int>(outline.size());
  for (std::size_t k = 0; k < outline.size(); ++k) {
    contour.verts[4 * k] = outline[k].x;
    contour.verts[4 * k + 2] = outline[k].y;
    contour.verts[4 * k + 3] = 0;
  }
}

std::int64_t count_open(const TileCells& cells) {
  const auto size = static_cast<std::ptrdiff_t>(cells.size);
  std::int64_t count = 0;
  for (std::ptrdiff_t y = kBorder; y < kBorder + size; ++y) {
    const auto row = cells.open.begin() + y * (size + 2 * kBorder) + kBorder;
    count += std::accumulate(row, row + size, std::int64_t{0});
  }
  return count;
}

/// Twice its area if the polygon is convex and turns as an outline does, else -1.
std::int64_t twice_convex_area(const GridPolygon& polygon) {
  const std::size_t count = polygon.corners.size();
  const auto cross = [&](std::size_t i, std::size_t j, std::size_t k) {
    const auto& a = polygon.corners[i];
    const auto& b = polygon.corners[j];
    const auto& c = polygon.corners[k];
    return static_cast<std::int64_t>(b[0] - a[0]) * (c[1] - a[1]) -
           static_cast<std::int64_t>(b[1] - a[1]) * (c[0] - a[0]);
  };
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (cross(i, (i + 1) % count, (i + 2) % count) > 0) return -1;
    if (i >= 2) sum -= cross(0, i - 1, i);
  }
  return sum;
}

GridPolygon polygon_of(const rcPolyMesh& mesh, int index) {
  GridPolygon out;
  for (int k = 0; k < mesh.nvp; ++k) {
    const unsigned short corner = mesh.polys[2 * mesh.nvp * index + k];
    if (corner == RC_MESH_NULL_IDX) break;
    out.corners.push_back({mesh.verts[3 * corner], mesh.verts[3 * corner + 2]});
  }
  return out;
}

/// \returns nothing unless the two sums in the header hold
std::optional<std::vector<GridPolygon>> try_contours(rcContext& context, const TileCells& cells,
                                                     const rcContourSet& set, std::int64_t drawn,
                                                     int max_corners) {
  const PolyMesh mesh(rcAllocPolyMesh());
  require(mesh != nullptr, "rcAllocPolyMesh");
  if (!rcBuildPolyMesh(&context, const_cast<rcContourSet&>(set), max_corners, *mesh)) return {};
  std::vector<GridPolygon> out;
  out.reserve(static_cast<std::size_t>(mesh->npolys));
  for (int i = 0; i < mesh->npolys; ++i) {
    GridPolygon polygon = polygon_of(*mesh, i);
    const std::int64_t area = twice_convex_area(polygon);
    if (area == 0) continue;
    if (area < 0) return {};
    drawn -= area;
    std::reverse(polygon.corners.begin(), polygon.corners.end());
    for (auto& corner : polygon.corners) {
      corner[0] += cells.origin.x * kStepsPerCellSide;
      corner[1] += cells.origin.y * kStepsPerCellSide;
    }
    out.push_back(std::move(polygon));
  }
  if (drawn != 0) return {};
  return out;
}

std::optional<std::vector<GridPolygon>> try_bake(rcContext& context, const TileCells& cells,
                                                 rcCompactHeightfield& field,
                                                 const BakeConfig& config, const Try& how) {
  if (how.coloured) colour_regions(field);
  const ContourSet set(rcAllocContourSet());
  require(set != nullptr, "rcAllocContourSet");
  if (!rcBuildContours(&context, field, 0.0F, config.max_edge, *set)) return {};
  std::int64_t outlined = 0, drawn = 0;
  for (int i = 0; i < set->nconts; ++i) {
    std::vector<OutlineCorner> outline = outline_of(set->conts[i]);
    outlined += twice_area(outline);
    grow_walls(outline, cells, how.smoothed ? config.grow : 0);
    if (how.smoothed && config.contour_error > 0.0)
      fill_notches(outline, config.contour_error * kStepsPerCellSide);
    drawn += twice_area(outline);
    put_back(outline, set->conts[i]);
  }
  if (outlined != 2 * count_open(cells)) return {};
  return try_contours(context, cells, *set, drawn, config.max_corners);
}

/// Rows of open cells, each as tall as it stays the same.
std::vector<GridPolygon> rectangles(const TileCells& cells) {
  std::vector<GridPolygon> out;
  std::vector<std::array<int, 3>> growing, next;  // from, to, first row
  const auto close = [&](const std::array<int, 3>& run, int row) {
    const auto at = [&](int x, int y) -> std::array<int, 2> {
      return {(cells.origin.x + x) * kStepsPerCellSide, (cells.origin.y + y) * kStepsPerCellSide};
    };
    out.push_back({{at(run[0], run[2]), at(run[1], run[2]), at(run[1], row), at(run[0], row)}});
  };
  for (int y = 0; y <= cells.size; ++y) {
    next.clear();
    for (int x = 0; y < cells.size && x < cells.size; ++x) {
      const auto row =
          static_cast<std::size_t>((y + kBorder) * (cells.size + 2 * kBorder) + kBorder);
      const int from = x;
      while (x < cells.size && cells.open[row + static_cast<std::size_t>(x)] != 0) ++x;
      if (x > from) next.push_back({from, x, y});
    }
    for (const auto& run : growing) {
      const auto same = std::find_if(next.begin(), next.end(), [&run](const auto& other) {
        return other[0] == run[0] && other[1] == run[1];
      });
      if (same != next.end()) {
        (*same)[2] = run[2];
      } else {
        close(run, y);
      }
    }
    growing.swap(next);
  }
  return out;
}

}  // namespace

std::vector<GridPolygon> bake_tile(const TileCells& cells, const BakeConfig& config) {
  if (count_open(cells) == 0) return {};
  rcContext context(false);
  const CompactField field = compact_field(cells);
  if (rcBuildDistanceField(&context, *field) &&
      rcBuildRegions(&context, *field, kBorder, 0, config.merge_region)) {
    for (const Try& how : kTries) {
      if (auto polygons = try_bake(context, cells, *field, config, how)) return *polygons;
    }
  }
  return rectangles(cells);
}

}  // namespace navvi_nav
