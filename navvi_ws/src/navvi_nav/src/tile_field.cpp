#include "navvi_nav/tile_field.hpp"

#include <Recast.h>

#include <stdexcept>
#include <string>

namespace navvi_nav {
namespace {

template <typename Type, void (*free)(Type*)>
struct Free {
  void operator()(Type* pointer) const { free(pointer); }
};
using HeightField = std::unique_ptr<rcHeightfield, Free<rcHeightfield, rcFreeHeightField>>;
using CompactField =
    std::unique_ptr<rcCompactHeightfield, Free<rcCompactHeightfield, rcFreeCompactHeightfield>>;
using ContourSet = std::unique_ptr<rcContourSet, Free<rcContourSet, rcFreeContourSet>>;
using PolyMesh = std::unique_ptr<rcPolyMesh, Free<rcPolyMesh, rcFreePolyMesh>>;

constexpr int kColours = 62;  // areas that Recast leaves to the user

void require(bool done, const char* step) {
  if (!done) throw std::runtime_error(std::string("Recast ran out of memory in ") + step);
}

/// An area of its own for each region: Recast then keeps the border between two regions as near to
/// the cells as it keeps a wall. By default it draws it straight, through whatever stands there.
void colour_regions(rcCompactHeightfield& field) {
  for (int i = 0; i < field.spanCount; ++i) {
    const unsigned short region = field.spans[i].reg;
    if (field.areas[i] == RC_NULL_AREA || region == 0 || (region & RC_BORDER_REG) != 0) continue;
    field.areas[i] = static_cast<unsigned char>(1 + region % kColours);
  }
}

std::int64_t twice_area(const GridPolygon& triangle) {
  const auto& c = triangle.corners;
  return static_cast<std::int64_t>(c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) -
         static_cast<std::int64_t>(c[1][1] - c[0][1]) * (c[2][0] - c[0][0]);
}

}  // namespace

struct TileField::Recast {
  rcContext context{false};
  HeightField heights{rcAllocHeightfield()};
  CompactField compact;
};

TileField::TileField(Cell origin, int size, int border, int levels, double cell_size,
                     double level_height)
    : origin_(origin),
      size_(size),
      border_(border),
      cell_size_(cell_size),
      level_height_(level_height),
      recast_(std::make_unique<Recast>()) {
  const int side = size + 2 * border;
  const auto extent = static_cast<float>(side * cell_size);
  const float low[3] = {0.0F, 0.0F, 0.0F};
  const float high[3] = {extent, static_cast<float>(levels * level_height), extent};
  require(recast_->heights &&
              rcCreateHeightfield(&recast_->context, *recast_->heights, side, side, low, high,
                                  static_cast<float>(cell_size), static_cast<float>(level_height)),
          "rcCreateHeightfield");
}

TileField::~TileField() = default;
TileField::TileField(TileField&&) noexcept = default;
TileField& TileField::operator=(TileField&&) noexcept = default;

void TileField::add_span(Cell cell, int bottom, int top) {
  require(rcAddSpan(&recast_->context, *recast_->heights, cell.x - origin_.x + border_,
                    cell.y - origin_.y + border_, static_cast<unsigned short>(bottom),
                    static_cast<unsigned short>(top), RC_WALKABLE_AREA, 0),
          "rcAddSpan");
}

void TileField::count_tops(int headroom, std::map<int, int>& counts) const {
  const rcHeightfield& field = *recast_->heights;
  for (int y = border_; y < border_ + size_; ++y) {
    for (int x = border_; x < border_ + size_; ++x) {
      for (const rcSpan* span = field.spans[x + y * field.width]; span; span = span->next) {
        const int top = static_cast<int>(span->smax);
        if (!span->next || static_cast<int>(span->next->smin) - top >= headroom) ++counts[top];
      }
    }
  }
}

std::vector<Ground> TileField::settle(int floor_top, int headroom) {
  rcHeightfield& field = *recast_->heights;
  std::vector<Ground> ground(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_),
                             Ground::none);
  for (int y = 0; y < field.height; ++y) {
    for (int x = 0; x < field.width; ++x) {
      Ground found = Ground::none;
      for (rcSpan* span = field.spans[x + y * field.width]; span; span = span->next) {
        const int bottom = static_cast<int>(span->smin);
        const int top = static_cast<int>(span->smax);
        const bool free = !span->next || static_cast<int>(span->next->smin) - floor_top >= headroom;
        span->area = RC_NULL_AREA;
        if (top == floor_top && free) {
          span->area = RC_WALKABLE_AREA;
          found = Ground::floor;
        } else if (top >= floor_top && bottom < floor_top + headroom && found != Ground::floor) {
          found = Ground::obstacle;
        }
      }
      const int column = x - border_;
      const int row = y - border_;
      if (column < 0 || row < 0 || column >= size_ || row >= size_) continue;
      ground[static_cast<std::size_t>(row) * static_cast<std::size_t>(size_) +
             static_cast<std::size_t>(column)] = found;
    }
  }
  recast_->compact.reset(rcAllocCompactHeightfield());
  if (rcGetHeightFieldSpanCount(&recast_->context, field) > 0) {
    require(recast_->compact &&
                rcBuildCompactHeightfield(&recast_->context, headroom, 0, field, *recast_->compact),
            "rcBuildCompactHeightfield");
  }
  recast_->heights.reset();
  return ground;
}

std::vector<GridPolygon> TileField::build(const std::function<bool(Cell)>& open,
                                          const Contours& contours) {
  rcCompactHeightfield& field = *recast_->compact;
  if (field.spanCount == 0) return {};
  bool any = false;
  for (int y = 0; y < field.height; ++y) {
    for (int x = 0; x < field.width; ++x) {
      const rcCompactCell& column = field.cells[x + y * field.width];
      const bool walk =
          column.count > 0 && open({origin_.x + x - border_, origin_.y + y - border_});
      any = any || walk;
      const auto first = static_cast<unsigned int>(column.index);
      const auto count = static_cast<unsigned int>(column.count);
      for (unsigned int i = first; i < first + count; ++i)
        field.areas[i] = walk ? RC_WALKABLE_AREA : RC_NULL_AREA;
    }
  }
  return any ? triangulate(contours) : std::vector<GridPolygon>{};
}

std::vector<GridPolygon> TileField::triangulate(const Contours& contours) {
  rcContext* context = &recast_->context;
  rcCompactHeightfield& field = *recast_->compact;
  require(rcBuildDistanceField(context, field), "rcBuildDistanceField");
  require(rcBuildRegions(context, field, border_, 0, contours.merge_region), "rcBuildRegions");
  colour_regions(field);
  const ContourSet set(rcAllocContourSet());
  require(set && rcBuildContours(context, field, static_cast<float>(contours.max_error),
                                 contours.max_edge, *set),
          "rcBuildContours");
  if (set->nconts == 0) return {};
  const PolyMesh mesh(rcAllocPolyMesh());
  require(mesh && rcBuildPolyMesh(context, *set, 3, *mesh), "rcBuildPolyMesh");

  std::vector<GridPolygon> triangles;
  triangles.reserve(static_cast<std::size_t>(mesh->npolys));
  for (int i = 0; i < mesh->npolys; ++i) {
    GridPolygon triangle;
    triangle.corners.resize(3);
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned short* vertex = &mesh->verts[3 * mesh->polys[6 * i + static_cast<int>(k)]];
      triangle.corners[k] = {origin_.x + vertex[0], origin_.y + vertex[2]};
    }
    const std::int64_t area = twice_area(triangle);
    if (area == 0) continue;
    if (area < 0) std::swap(triangle.corners[1], triangle.corners[2]);
    triangles.push_back(std::move(triangle));
  }
  return triangles;
}

}  // namespace navvi_nav
