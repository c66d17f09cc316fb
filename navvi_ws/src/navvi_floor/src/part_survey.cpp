#include "part_survey.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_floor {
namespace {

bool overlap(const Area& a, const Area& b) {
  const Area both = clipped(a, b);
  return both.columns() > 0 && both.rows() > 0;
}

double size_of(const Area& area) { return static_cast<double>(area.columns()) * area.rows(); }

/// The area with each side moved to the nearest place in `to`.
Area clamped(const Area& area, const Area& to) {
  const auto into = [&to](Cell at) -> Cell {
    return {std::clamp(at.x, to.low.x, to.high.x), std::clamp(at.y, to.low.y, to.high.y)};
  };
  return {into(area.low), into(area.high)};
}

/// Whether the whole map takes up the same along x and y, if of its voxels `was` became `now`.
bool same_columns(const HeightField::Extent& all, const HeightField::Extent& was,
                  const HeightField::Extent& now) {
  for (int k = 0; k < 2; ++k) {
    const bool low = was.low[k] == now.low[k] || std::min(was.low[k], now.low[k] + 1) > all.low[k];
    const bool high =
        was.high[k] == now.high[k] || std::max(was.high[k], now.high[k] - 1) < all.high[k];
    if (!low || !high) return false;
  }
  return true;
}

/// A part of a map with its sides moved outwards until there is no climbed floor within `edge`
/// columns to both sides of them.
/// \param climbed  of all columns, row by row
Area widened(Area part, const Area& all, const std::vector<bool>& climbed, int edge) {
  const auto any = [&](const Area& area) {
    const Area strip = clipped(area, all);
    for (int y = strip.low.y; strip.columns() > 0 && y < strip.high.y; ++y) {
      const auto row = climbed.begin() + std::ptrdiff_t{y - all.low.y} * all.columns() - all.low.x;
      const auto end = row + strip.high.x;
      if (std::find(row + strip.low.x, end, true) != end) return true;
    }
    return false;
  };
  for (Area last; !(last == part);) {
    last = part;
    const Area out = grown(part, edge), in = grown(part, -edge);
    if (any({out.low, {in.low.x, out.high.y}})) part.low.x -= edge;
    if (any({out.low, {out.high.x, in.low.y}})) part.low.y -= edge;
    if (any({{in.high.x, out.low.y}, out.high})) part.high.x += edge;
    if (any({{out.low.x, in.high.y}, out.high})) part.high.y += edge;
    part = clipped(part, all);
  }
  return part;
}

/// Puts those cells of `part` that touch the columns into `out`.
void put(const MapSurvey& part, const Area& columns, double voxel, MapSurvey& out) {
  const double scale = voxel / out.cell_size;
  const auto first = [&](int column) {
    return static_cast<int>(std::floor(column * scale + 0.01));
  };
  const auto end = [&](int column) { return static_cast<int>(std::ceil(column * scale - 0.01)); };
  const int from = first(columns.low.x), to = end(columns.high.x);
  for (int y = first(columns.low.y); y < end(columns.high.y); ++y)
    std::copy_n(part.ground.row(y - part.low.y) + from - part.low.x, to - from,
                out.ground.own_row(y - out.low.y) + from - out.low.x);
}

/// The voxels of some columns, and of leaves that are larger than a block.
Voxels voxels_in(const Area& columns, const SurveyRecord& record) {
  return read_voxels(record.bytes, [&](const Block& block) {
    return overlap(columns_of(block), columns) ? 0 : find_block(record.blocks, block.low)->size;
  });
}

/// A map of which one part is surveyed, and the rest taken over from the map before.
class PartSurvey {
 public:
  PartSurvey(const FloorRules& rules, const SurveyRecord& before, const Floor& floor,
             SurveyRecord& record)
      : rules_(rules),
        before_(before),
        floor_(floor),
        record_(record),
        all_(columns_of(before.extent)),
        edge_(rules.climbing().steep_reach() + 2 +
              static_cast<int>(std::ceil(floor.cell_size() / rules.voxel()))),
        ahead_(std::max(rules.climbing().ramp_reach(), edge_) + 1) {}

  /// The part is widened until no climbed floor lies within `edge_` of its sides, before or now:
  /// then none spreads across. \returns nothing if all must be surveyed
  std::optional<MapSurvey> survey(const Area& changed) {
    const Area inside = clamped(changed, all_);
    if (!is_small(inside) || !keeps_extent_and_level(changed, inside)) return std::nullopt;
    Area part = widened(clipped(grown(inside, ahead_), all_), all_, before_.climbed, edge_);
    while (is_small(part)) {
      const Area around = clipped(grown(part, ahead_), all_);
      const HeightField now(voxels_in(around, record_), rules_.threads(), around);
      if (!now.error().empty()) return std::nullopt;
      FloorRules::Shown shown = rules_.ground_of(now, before_.floor_level);
      const std::vector<Cell> climbed = cells_of(shown.climbed, around);
      const Area wider = widened(part, all_, climbed_with(climbed), edge_);
      if (wider == part) {
        record_.climbed = climbed_within(part, climbed);
        return with(shown.grid, part);
      }
      part = wider;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_small(const Area& part) const {
    return 2.0 * size_of(part) <= size_of(all_);
  }
  /// Counts what the change took away and brought. \returns false if the map takes up more or less
  /// than before, or its floor lies on another level
  bool keeps_extent_and_level(const Area& changed, const Area& inside) {
    const HeightField was(voxels_in(changed, before_), rules_.threads(), inside);
    const HeightField is(voxels_in(changed, record_), rules_.threads(), inside);
    if (!was.error().empty() || !is.error().empty() ||
        !same_columns(before_.extent, was.extent(), is.extent()))
      return false;
    HeightField::Extent& extent = record_.extent;
    extent = before_.extent;  // what is gone may have been the highest: it counts all the same
    extent.low[2] = std::min(before_.extent.low[2], is.extent().low[2]);
    extent.high[2] = std::max(before_.extent.high[2], is.extent().high[2]);
    if (extent.high[2] - extent.low[2] > HeightField::kMaxLevels) return false;
    record_.places = before_.places;
    rules_.count(was, -1, record_.places);
    rules_.count(is, 1, record_.places);
    record_.floor_level = before_.floor_level;
    return rules_.floor_level(record_.places) == before_.floor_level;
  }
  /// \param columns  of an area, by number
  static std::vector<Cell> cells_of(const std::vector<int>& columns, const Area& area) {
    std::vector<Cell> out;
    out.reserve(columns.size());
    for (const int column : columns)
      out.push_back({area.low.x + column % area.columns(), area.low.y + column / area.columns()});
    return out;
  }
  [[nodiscard]] std::ptrdiff_t index(Cell at) const {
    return std::ptrdiff_t{at.y - all_.low.y} * all_.columns() + at.x - all_.low.x;
  }
  /// The climbed floor before and now.
  [[nodiscard]] std::vector<bool> climbed_with(const std::vector<Cell>& cells) const {
    std::vector<bool> out = before_.climbed;
    for (const Cell at : cells) *(out.begin() + index(at)) = true;
    return out;
  }
  /// The climbed floor now: in `part` that of `cells`, elsewhere as before.
  [[nodiscard]] std::vector<bool> climbed_within(const Area& part,
                                                 const std::vector<Cell>& cells) const {
    std::vector<bool> out = before_.climbed;
    for (int y = part.low.y; y < part.high.y; ++y)
      std::fill(out.begin() + index({part.low.x, y}), out.begin() + index({part.high.x, y}), false);
    for (const Cell at : cells)
      if (part.contains(at)) *(out.begin() + index(at)) = true;
    return out;
  }
  /// The floor before, with this ground in `part`.
  [[nodiscard]] MapSurvey with(const GroundGrid& ground, const Area& part) const {
    SurveyConfig same_cells = rules_.config();
    same_cells.cell_size = floor_.cell_size();
    MapSurvey out;
    out.in_part = true;
    out.cell_size = floor_.cell_size();
    out.low = floor_.origin();
    out.columns = floor_.columns();
    out.rows = floor_.rows();
    out.ground = floor_.all_ground();
    put(resample(ground, same_cells), part, rules_.voxel(), out);
    return out;
  }

  const FloorRules& rules_;
  const SurveyRecord& before_;
  const Floor& floor_;
  SurveyRecord& record_;
  const Area all_;   // columns of the map before
  const int edge_;   // columns, from a side of a part to climbed floor that may spread across
  const int ahead_;  // columns, round a part, by which its ground is judged
};

}  // namespace

std::optional<MapSurvey> survey_part(const Area& changed, const FloorRules& rules,
                                     const SurveyRecord& before, const Floor& floor,
                                     SurveyRecord& record) {
  return PartSurvey(rules, before, floor, record).survey(changed);
}

}  // namespace navvi_floor
