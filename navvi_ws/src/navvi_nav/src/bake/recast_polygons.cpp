#include "bake/recast_polygons.hpp"

#include <Recast.h>
#include <RecastAlloc.h>

#include <algorithm>
#include <memory>
#include <navvi_floor/pieces.hpp>
#include <stdexcept>
#include <string>

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

/// A compact height field with a span for each cell, of which open cells have theirs and no cell
/// is joined to one that is not open: as rcBuildCompactHeightfield would make it of a single level.
CompactField compact_field(const TileCells& cells) {
  CompactField out(rcAllocCompactHeightfield());
  require(out != nullptr, "rcAllocCompactHeightfield");
  const int side = cells.size + 2 * kBorder, stride = side + 2, count = side * side;
  out->width = out->height = side;
  out->borderSize = 0;
  out->walkableHeight = 1;
  out->cs = out->ch = 1.0F;
  out->bmax[0] = out->bmax[2] = static_cast<float>(side);
  out->bmax[1] = 1.0F;
  out->cells = allocate<rcCompactCell>(count);
  out->spanCount = count;
  out->spans = allocate<rcCompactSpan>(count);
  out->areas = allocate<unsigned char>(count);
  std::fill_n(out->areas, count, RC_WALKABLE_AREA);
  std::vector<std::uint8_t> framed(static_cast<std::size_t>(stride * stride), 0);
  for (int y = 0; y < side; ++y)
    std::copy_n(&cells.open[static_cast<std::size_t>(y * side)], side,
                &framed[static_cast<std::size_t>((y + 1) * stride + 1)]);
  for (int y = 0, at = 0; y < side; ++y) {
    const std::uint8_t* here = &framed[static_cast<std::size_t>((y + 1) * stride + 1)];
    for (int x = 0; x < side; ++x, ++at, ++here) {
      out->cells[at] = {static_cast<unsigned>(at) & 0xffffffU, *here};
      // A direction has 6 bits, all of RC_NOT_CONNECTED: they are cleared where it is open.
      const unsigned open = here[-1] | unsigned{here[stride]} << 6 | unsigned{here[1]} << 12 |
                            unsigned{here[-stride]} << 18;
      out->spans[at] = {0, 0, (0xffffffU - RC_NOT_CONNECTED * open) & 0xffffffU, 255};
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
  for (int y = 0; y < side; ++y) std::copy_n(row_of(y), side, field.dist + y * side);
  field.maxDistance = *std::max_element(field.dist, field.dist + field.spanCount);
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

/// As rcBuildLayerRegions, which on a single level makes one region of what hangs together, and one
/// of each side of the border, but ten times as fast. Cells amid their region keep their index and
/// connections, for what looks at neighbours, and are counted out: no contour begins there.
void build_layers(rcCompactHeightfield& field, std::vector<std::uint8_t> open) {
  const int side = field.width, last = side - 1;
  const auto at = [side](int x, int y) { return static_cast<std::size_t>(x + y * side); };
  for (int i = 0; i < side; ++i)
    open[at(i, 0)] = open[at(i, last)] = open[at(0, i)] = open[at(last, i)] = 0;
  const auto pieces = map::pieces_of(static_cast<std::size_t>(side), static_cast<std::size_t>(side),
                                     0, [&open](std::size_t cell) { return open[cell] != 0; });
  std::vector<std::uint8_t> amid(open.size(), 0);
  for (std::size_t i = at(1, 1); i < at(last, last - 1); ++i) {
    const std::uint8_t* const above = &open[i + at(0, 1)];
    const std::uint8_t* const below = &open[i - at(0, 1)];
    amid[i] = open[i - 1] & open[i] & open[i + 1] & above[-1] & above[0] & above[1] & below[-1] &
              below[0] & below[1];
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    field.spans[i].reg = static_cast<unsigned short>(pieces[i]);
    if (amid[i] != 0) field.cells[i].count = 0;
  }
  for (int i = 0; i < side; ++i) {
    field.spans[at(0, i)].reg = RC_BORDER_REG | 1;
    field.spans[at(last, i)].reg = RC_BORDER_REG | 2;
  }
  for (int i = 0; i < side; ++i) {
    field.spans[at(i, 0)].reg = RC_BORDER_REG | 3;
    field.spans[at(i, last)].reg = RC_BORDER_REG | 4;
  }
  field.maxRegions =
      static_cast<unsigned short>(*std::max_element(pieces.begin(), pieces.end()));
  field.borderSize = kBorder;
}

bool build_regions(rcContext& context, const TileCells& cells, const BakeConfig& config,
                   rcCompactHeightfield& field) {
  if (!config.watershed) {
    build_layers(field, cells.open);
    return true;
  }
  measure_distances(field, cells);
  return rcBuildRegions(&context, field, kBorder, 0, config.merge_region);
}

}  // namespace

std::optional<std::vector<mesh::GridPolygon>> recast_polygons(const TileCells& cells,
                                                              const TileCells& rest,
                                                              const BakeConfig& config) {
  rcContext context(false);
  const CompactField field = compact_field(rest);
  if (build_regions(context, rest, config, *field)) {
    for (const Try& how : kTries) {
      if (auto polygons = try_bake(context, cells, rest.count_open(), *field, config, how))
        return polygons;
    }
  }
  return {};
}

}  // namespace navvi_nav::bake
