#include "bake/tile_bake.hpp"

#include <Recast.h>
#include <RecastAlloc.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

#include "bake/merge_convex.hpp"
#include "bake/outline.hpp"

namespace navvi_nav::bake {
namespace {

template <typename Type, void (*free)(Type*)>
struct Free {
  void operator()(Type* pointer) const { free(pointer); }
};
using CompactField =
    std::unique_ptr<rcCompactHeightfield, Free<rcCompactHeightfield, rcFreeCompactHeightfield>>;
using ContourSet = std::unique_ptr<rcContourSet, Free<rcContourSet, rcFreeContourSet>>;
using PolyMesh = std::unique_ptr<rcPolyMesh, Free<rcPolyMesh, rcFreePolyMesh>>;

constexpr int kBorder = 1;     // cells
constexpr int kCrowded = 400;  // corners
constexpr int kLeastPart = 8;  // cells
constexpr int kColours = 62;   // areas that Recast leaves to the user

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

/// rcBuildDistanceField's distances, without its blur and only up to 15 cells: beyond, a wide place
/// is one basin to the watershed, which has fewer levels to climb.
void measure_distances(rcCompactHeightfield& field, const TileCells& cells) {
  constexpr int kStraight = 2, kDiagonal = 3, kFarthest = 30;  // half cells
  const int side = field.width;
  const int stride = side + 2;  // a frame of zeros
  std::vector<std::uint8_t> near(static_cast<std::size_t>(stride * stride), 0);
  const auto row_of = [&near, stride](int y) { return near.data() + (y + 1) * stride + 1; };
  const auto nearer = [](int a, int b) { return static_cast<std::uint8_t>(std::min(a, b)); };
  const auto sweep = [&](int y, int step) {
    std::uint8_t* row = row_of(y);
    const std::uint8_t* beside = row_of(y - step);
    for (int x = 0; x < side; ++x) {
      const int least =
          nearer(nearer(beside[x - 1], beside[x + 1]) + kDiagonal, beside[x] + kStraight);
      row[x] = nearer(row[x], least);
    }
    const int first = step > 0 ? 0 : side - 1;
    for (int x = first; x >= 0 && x < side; x += step)
      row[x] = nearer(row[x], row[x - step] + kStraight);
  };
  for (int y = 0; y < side; ++y) {
    const std::uint8_t* open = cells.open.data() + static_cast<std::size_t>(y * side);
    for (int x = 0; x < side; ++x) row_of(y)[x] = static_cast<std::uint8_t>(open[x] * kFarthest);
    sweep(y, 1);
  }
  for (int y = side - 1; y >= 0; --y) sweep(y, -1);
  field.dist = allocate<unsigned short>(field.spanCount);
  field.maxDistance = 0;
  unsigned short* out = field.dist;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (cells.open[static_cast<std::size_t>(y * side + x)] == 0) continue;
      *out = near[static_cast<std::size_t>((y + 1) * stride + x + 1)];
      field.maxDistance = std::max(field.maxDistance, *out);
      ++out;
    }
  }
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
std::int64_t twice_convex_area(const std::vector<OutlineCorner>& polygon) {
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (turn(polygon[i], polygon[(i + 1) % count], polygon[(i + 2) % count]) > 0) return -1;
  }
  return twice_area(polygon);
}

std::vector<OutlineCorner> polygon_of(const rcPolyMesh& mesh, int index) {
  std::vector<OutlineCorner> out;
  for (int k = 0; k < mesh.nvp; ++k) {
    const unsigned short corner = mesh.polys[2 * mesh.nvp * index + k];
    if (corner == RC_MESH_NULL_IDX) break;
    out.push_back({mesh.verts[3 * corner], mesh.verts[3 * corner + 2], false});
  }
  return out;
}

/// In steps of map, and counter-clockwise.
template <typename Corners>
mesh::GridPolygon placed(const Corners& clockwise, const TileCells& cells) {
  mesh::GridPolygon out;
  out.corners.reserve(clockwise.size());
  for (auto corner = clockwise.rbegin(); corner != clockwise.rend(); ++corner)
    out.corners.push_back({cells.origin.x * map::kStepsPerCellSide + corner->x,
                           cells.origin.y * map::kStepsPerCellSide + corner->y});
  return out;
}

/// \returns nothing unless the two sums in the header hold
std::optional<std::vector<mesh::GridPolygon>> try_contours(rcContext& context,
                                                           const TileCells& cells,
                                                           const rcContourSet& set,
                                                           std::int64_t drawn) {
  const PolyMesh mesh(rcAllocPolyMesh());
  require(mesh != nullptr, "rcAllocPolyMesh");
  if (!rcBuildPolyMesh(&context, const_cast<rcContourSet&>(set), 3, *mesh)) return {};
  std::vector<mesh::GridPolygon> out;
  out.reserve(static_cast<std::size_t>(mesh->npolys));
  for (int i = 0; i < mesh->npolys; ++i) {
    const std::vector<OutlineCorner> polygon = polygon_of(*mesh, i);
    const std::int64_t area = twice_convex_area(polygon);
    if (area < 0) return {};
    if (area > 0) out.push_back(placed(polygon, cells));
    drawn -= area;
  }
  if (drawn != 0) return {};
  return out;
}

std::optional<std::vector<mesh::GridPolygon>> try_bake(rcContext& context, const TileCells& cells,
                                                       std::int64_t open,
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
      fill_notches(outline, config.contour_error * map::kStepsPerCellSide);
    drawn += twice_area(outline);
    put_back(outline, set->conts[i]);
  }
  if (outlined != 2 * open) return {};
  return try_contours(context, cells, *set, drawn);
}

/// Rows of open cells, each as tall as it stays the same.
std::vector<mesh::GridPolygon> rectangles(const TileCells& cells) {
  std::vector<mesh::GridPolygon> out;
  std::vector<std::array<int, 3>> growing, next;  // from, to, first row
  const auto close = [&](const std::array<int, 3>& run, int row) {
    const auto at = [&](int x, int y) -> std::array<int, 2> {
      return {(cells.origin.x + x) * map::kStepsPerCellSide,
              (cells.origin.y + y) * map::kStepsPerCellSide};
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

/// Recast draws no contour around a lone cell. They are taken out of `cells`, a square each.
std::vector<mesh::GridPolygon> take_lone_cells(TileCells& cells, int grow) {
  const int side = cells.size + 2 * kBorder;
  const auto open = [&](int x, int y) -> std::uint8_t& {
    return cells.open[static_cast<std::size_t>((y + kBorder) * side + x + kBorder)];
  };
  std::vector<map::Cell> lone;
  for (int y = 0; y < cells.size; ++y) {
    for (int x = 0; x < cells.size; ++x) {
      const bool alone = open(x, y) != 0 && !(x > 0 && open(x - 1, y) != 0) &&
                         !(x + 1 < cells.size && open(x + 1, y) != 0) &&
                         !(y > 0 && open(x, y - 1) != 0) &&
                         !(y + 1 < cells.size && open(x, y + 1) != 0);
      if (alone) lone.push_back({x, y});
    }
  }
  std::vector<mesh::GridPolygon> out;
  for (const map::Cell& cell : lone) {
    std::vector<OutlineCorner> outline{{cell.x, cell.y, true},
                                       {cell.x, cell.y + 1, true},
                                       {cell.x + 1, cell.y + 1, true},
                                       {cell.x + 1, cell.y, true}};
    grow_walls(outline, cells, grow);
    out.push_back(placed(outline, cells));
  }
  for (const map::Cell& cell : lone) open(cell.x, cell.y) = 0;
  return out;
}

/// \param cells  that walls grow away from \param rest  those to cover
std::vector<mesh::GridPolygon> bake_regions(const TileCells& cells, const TileCells& rest,
                                            const BakeConfig& config) {
  rcContext context(false);
  const CompactField field = compact_field(rest);
  measure_distances(*field, rest);
  if (rcBuildRegions(&context, *field, kBorder, 0, config.merge_region)) {
    for (const Try& how : kTries) {
      if (auto polygons = try_bake(context, cells, count_open(rest), *field, config, how))
        return *polygons;
    }
  }
  return rectangles(rest);
}

/// Corners of the open cells' border.
int count_corners(const TileCells& cells) {
  const int side = cells.size + 2 * kBorder;
  int count = 0;
  for (int y = 1; y < side; ++y) {
    const std::uint8_t* below = cells.open.data() + static_cast<std::size_t>((y - 1) * side);
    const std::uint8_t* above = below + side;
    for (int x = 1; x < side; ++x)
      count += (below[x - 1] ^ below[x] ^ above[x - 1] ^ above[x]) |
               (below[x - 1] & ~below[x] & ~above[x - 1] & above[x]) |
               (~below[x - 1] & below[x] & above[x - 1] & ~above[x] & 1);
  }
  return count;
}

TileCells part_of(const TileCells& cells, map::Cell low, int size) {
  TileCells out{{cells.origin.x + low.x, cells.origin.y + low.y}, size, {}, {}};
  const int side = cells.size + 2 * kBorder;
  for (int y = 0; y < size + 2 * kBorder; ++y) {
    const auto row = cells.open.begin() + (low.y + y) * side + low.x;
    out.open.insert(out.open.end(), row, row + size + 2 * kBorder);
  }
  const auto lies_in = [size](int fine, int parts, int from) {
    return fine >= from * parts && fine < (from + size) * parts;
  };
  for (const TileCells& fine : cells.fine) {
    const int parts = fine.size / smallest_part(cells.size);
    if (lies_in(fine.origin.x, parts, out.origin.x) && lies_in(fine.origin.y, parts, out.origin.y))
      out.fine.push_back(fine);
  }
  return out;
}

bool can_be_quartered(int size) { return size % 2 == 0 && size / 2 >= kLeastPart; }

void bake_part(const TileCells& cells, const BakeConfig& config,
               std::vector<mesh::GridPolygon>& out);

/// A smallest part, of which `fine` are the finer cells.
void bake_fine(const TileCells& fine, int parts, BakeConfig config,
               std::vector<mesh::GridPolygon>& out) {
  config.max_edge *= parts;
  config.merge_region *= parts * parts;
  config.grow = 0;
  const std::size_t before = out.size();
  bake_part(fine, config, out);
  for (std::size_t i = before; i < out.size(); ++i)
    for (std::array<int, 2>& corner : out[i].corners)
      for (int& steps : corner) steps /= parts;  // whole cells: a step of the tile, or some
}

/// Recast's work on one region grows with the cube of its corners, so crowded tiles are quartered.
void bake_part(const TileCells& cells, const BakeConfig& config,
               std::vector<mesh::GridPolygon>& out) {
  const int half = cells.size / 2;
  const bool fine = !cells.fine.empty();
  if (fine && !can_be_quartered(cells.size)) {
    bake_fine(cells.fine[0], cells.fine[0].size / cells.size, config, out);
    return;
  }
  if (can_be_quartered(cells.size) && (fine || count_corners(cells) > kCrowded)) {
    for (const map::Cell low :
         {map::Cell{0, 0}, map::Cell{half, 0}, map::Cell{0, half}, map::Cell{half, half}})
      bake_part(part_of(cells, low, half), config, out);
    return;
  }
  TileCells rest = cells;
  std::vector<mesh::GridPolygon> polygons = take_lone_cells(rest, config.grow);
  out.insert(out.end(), polygons.begin(), polygons.end());
  if (count_open(rest) == 0) return;
  polygons = bake_regions(cells, rest, config);
  out.insert(out.end(), polygons.begin(), polygons.end());
}

}  // namespace

int smallest_part(int size) {
  while (can_be_quartered(size)) size /= 2;
  return size;
}

std::vector<mesh::GridPolygon> bake_tile(const TileCells& cells, const BakeConfig& config) {
  std::vector<mesh::GridPolygon> out;
  bake_part(cells, config, out);
  if (config.max_corners <= 3) return out;
  return merge_convex(std::move(out), config.max_corners);
}

}  // namespace navvi_nav::bake
