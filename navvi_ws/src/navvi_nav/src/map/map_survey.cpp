#include "map/map_survey.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "map/floor_rules.hpp"

namespace navvi_nav::map {
namespace {

MapSurvey refused(std::string why) {
  MapSurvey out;
  out.error = std::move(why);
  return out;
}

/// The least area that holds both.
Area hull(const Area& a, const Area& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

/// Columns of a cube.
Area columns_of(int x, int y, int side) {
  const Cell low{x - kMapCenter, y - kMapCenter};
  return {low, {low.x + side, low.y + side}};
}
Area columns_of(const Block& block) {
  return columns_of(block.low[0], block.low[1], 1 << kBlockLevel);
}

bool overlap(const Area& a, const Area& b) {
  const Area both = clipped(a, b);
  return both.columns() > 0 && both.rows() > 0;
}

bool contains(const Area& area, Cell at) {
  return at.x >= area.low.x && at.y >= area.low.y && at.x < area.high.x && at.y < area.high.y;
}

double size_of(const Area& area) { return static_cast<double>(area.columns()) * area.rows(); }

/// x, y, z and side, in voxels, of the occupied leaves that are in no block.
using Leaf = std::array<int, 4>;
std::vector<Leaf> large_leaves(const Voxels& voxels) {
  std::vector<Leaf> out;
  for (const Octet& octet : voxels.octets) {
    const int side = 1 << octet.level;
    for (int child = 0; octet.level >= kBlockLevel && child < 8; ++child) {
      if ((octet.mask >> child & 1) != 0)
        out.push_back({octet.x + side * (child & 1), octet.y + side * (child >> 1 & 1),
                       octet.z + side * (child >> 2), side});
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

/// What is kept of a map until the next one was surveyed.
struct SurveyRecord {
  std::vector<std::int8_t> data;  // the map's own, to which `bytes` points
  MapBytes bytes;
  std::vector<Block> blocks;
  std::vector<Leaf> leaves;
  HeightField::Extent extent;
  Places places;
  int floor_level = 0;
  std::vector<bool> climbed;  // columns of the extent, row by row: floor that was spread to
};

namespace {

MapSurvey survey_all(const Voxels& voxels, const FloorRules& rules, SurveyRecord& record) {
  const HeightField field(voxels, rules.threads());
  if (!field.error().empty()) return refused(field.error());
  record.places.clear();
  rules.count(field, 1, record.places);
  const std::optional<int> level = rules.floor_level(record.places);
  if (!level) return refused(rules.no_floor(record.places));
  FloorRules::Shown shown = rules.ground_of(field, *level);
  record.extent = field.extent();
  record.floor_level = *level;
  record.climbed.assign(shown.grid.ground.size(), false);
  for (const int column : shown.climbed) record.climbed[static_cast<std::size_t>(column)] = true;
  return resample(std::move(shown.grid), rules.config());
}

MapSurvey completed(MapSurvey survey, const FloorRules& rules, const SurveyRecord& record) {
  if (!survey.error.empty()) return refused(std::move(survey.error));
  survey.levels = rules.largest_levels(record.places);
  survey.floor_height = record.floor_level * rules.voxel();
  return survey;
}

Area columns_of(const HeightField::Extent& extent) {
  return {{extent.low[0], extent.low[1]}, {extent.high[0], extent.high[1]}};
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
  const auto at = [](auto& survey, int x, int y) {
    return survey.ground.begin() + std::ptrdiff_t{y - survey.low.y} * survey.columns + x -
           survey.low.x;
  };
  const int from = first(columns.low.x), to = end(columns.high.x);
  for (int y = first(columns.low.y); y < end(columns.high.y); ++y)
    std::copy(at(part, from, y), at(part, to, y), at(out, from, y));
}

/// The voxels of some columns, and of leaves that are larger than a block.
Voxels voxels_in(const Area& columns, const SurveyRecord& record) {
  return read_voxels(record.bytes, [&](const Block& block) {
    return overlap(columns_of(block), columns) ? 0 : find_block(record.blocks, block.low)->size;
  });
}

/// Surveys what differs from the map before. \returns nothing if all must be surveyed
/// \param changed  columns outside of which both maps are the same
/// \param record  of the new map
std::optional<MapSurvey> survey_part(const Area& changed, const FloorRules& rules,
                                     const SurveyRecord& before, const Floor& floor,
                                     SurveyRecord& record) {
  const Area all = columns_of(before.extent);
  const Area inside{{std::clamp(changed.low.x, all.low.x, all.high.x),
                     std::clamp(changed.low.y, all.low.y, all.high.y)},
                    {std::clamp(changed.high.x, all.low.x, all.high.x),
                     std::clamp(changed.high.y, all.low.y, all.high.y)}};
  if (2.0 * size_of(inside) > size_of(all)) return std::nullopt;
  const HeightField was(voxels_in(changed, before), rules.threads(), inside);
  const HeightField is(voxels_in(changed, record), rules.threads(), inside);
  if (!was.error().empty() || !is.error().empty() ||
      !same_columns(before.extent, was.extent(), is.extent()))
    return std::nullopt;
  record.extent = before.extent;  // what is gone may have been the highest: it counts all the same
  record.extent.low[2] = std::min(before.extent.low[2], is.extent().low[2]);
  record.extent.high[2] = std::max(before.extent.high[2], is.extent().high[2]);
  if (record.extent.high[2] - record.extent.low[2] > HeightField::kMaxLevels) return std::nullopt;
  record.places = before.places;
  rules.count(was, -1, record.places);
  rules.count(is, 1, record.places);
  record.floor_level = before.floor_level;
  if (rules.floor_level(record.places) != before.floor_level) return std::nullopt;
  const int edge = rules.climbing().steep_reach() + 2 +
                   static_cast<int>(std::ceil(floor.cell_size() / rules.voxel()));
  const int ahead = std::max(rules.climbing().ramp_reach(), edge) + 1;
  const auto bit = [&all](std::vector<bool>& columns, Cell at) {
    return columns.begin() + std::ptrdiff_t{at.y - all.low.y} * all.columns() + at.x - all.low.x;
  };
  // No climbed floor lies within `edge` of the part's sides, before or now: none spreads across.
  Area part = widened(clipped(grown(inside, ahead), all), all, before.climbed, edge);
  while (2.0 * size_of(part) <= size_of(all)) {
    const Area around = clipped(grown(part, ahead), all);
    const HeightField now(voxels_in(around, record), rules.threads(), around);
    if (!now.error().empty()) return std::nullopt;
    FloorRules::Shown shown = rules.ground_of(now, before.floor_level);
    record.climbed = before.climbed;
    const auto place = [&around](int column) -> Cell {
      return {around.low.x + column % around.columns(), around.low.y + column / around.columns()};
    };
    for (const int column : shown.climbed) *bit(record.climbed, place(column)) = true;
    const Area wider = widened(part, all, record.climbed, edge);
    if (!(wider == part)) {
      part = wider;
      continue;
    }
    record.climbed = before.climbed;
    for (int y = part.low.y; y < part.high.y; ++y)
      std::fill(bit(record.climbed, {part.low.x, y}), bit(record.climbed, {part.high.x, y}), false);
    for (const int column : shown.climbed) {
      const Cell at = place(column);
      if (contains(part, at)) *bit(record.climbed, at) = true;
    }
    SurveyConfig same_cells = rules.config();
    same_cells.cell_size = floor.cell_size();
    MapSurvey out;
    out.in_part = true;
    out.cell_size = floor.cell_size();
    out.low = floor.origin();
    out.columns = floor.columns();
    out.rows = floor.rows();
    out.ground = floor.all_ground();
    put(resample(std::move(shown.grid), same_cells), part, rules.voxel(), out);
    return out;
  }
  return std::nullopt;
}

}  // namespace

MapSurvey survey_map(const Voxels& voxels, const SurveyConfig& config) {
  if (!voxels.error.empty()) return refused(voxels.error);
  SurveyRecord record;
  const FloorRules rules(config, voxels.resolution);
  return completed(survey_all(voxels, rules, record), rules, record);
}

MapSurvey survey_map(const MapBytes& bytes, const SurveyConfig& config, const SurveyRecord* before,
                     const Floor* floor) {
  if (floor == nullptr) before = nullptr;
  if (before != nullptr && (before->bytes.resolution != bytes.resolution ||
                            before->bytes.binary != bytes.binary || before->bytes.id != bytes.id))
    before = nullptr;
  std::optional<Area> changed;
  const auto change = [&](const Area& area) { changed = hull(changed.value_or(area), area); };
  const auto same = [&](const Block& block) -> std::size_t {
    const Block* was = find_block(before->blocks, block.low);
    const bool same =
        was != nullptr && bytes.size - block.begin >= was->size &&
        std::memcmp(bytes.data + block.begin, before->data.data() + was->begin, was->size) == 0;
    if (same) return was->size;
    change(columns_of(block));
    return 0;
  };
  Voxels voxels = before != nullptr ? read_voxels(bytes, same) : read_voxels(bytes);
  if (!voxels.error.empty()) return refused(voxels.error);
  const FloorRules rules(config, bytes.resolution);
  auto record = std::make_shared<SurveyRecord>();
  record->data.assign(bytes.data, bytes.data + bytes.size);
  record->bytes = bytes;
  record->bytes.data = record->data.data();
  record->blocks = voxels.blocks;
  record->leaves = large_leaves(voxels);
  std::optional<MapSurvey> out;
  if (before != nullptr) {
    for (const Block& block : before->blocks)
      if (find_block(voxels.blocks, block.low) == nullptr) change(columns_of(block));
    std::vector<Leaf> leaves;
    std::set_symmetric_difference(before->leaves.begin(), before->leaves.end(),
                                  record->leaves.begin(), record->leaves.end(),
                                  std::back_inserter(leaves));
    for (const Leaf& leaf : leaves) change(columns_of(leaf[0], leaf[1], leaf[3]));
    const Cell low = columns_of(before->extent).low;
    out = survey_part(changed.value_or(Area{low, low}), rules, *before, *floor, *record);
    if (!out) voxels = read_voxels(bytes);
  }
  if (!out) out = survey_all(voxels, rules, *record);
  out->record = record;
  return completed(*std::move(out), rules, *record);
}

}  // namespace navvi_nav::map
