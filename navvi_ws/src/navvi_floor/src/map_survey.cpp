#include "navvi_floor/map_survey.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <optional>
#include <utility>

#include "floor_rules.hpp"
#include "navvi_floor/resample.hpp"
#include "part_survey.hpp"

namespace navvi_floor {
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

/// The ground of all columns. \param record  of the map, as far as it is known
SeenGround seen_in(const HeightField& field, const FloorRules& rules, SurveyRecord record = {}) {
  SeenGround out{field.error(), rules.config(), std::move(record), {}};
  if (!out.error.empty()) return out;
  out.record.places.clear();
  rules.count(field, 1, out.record.places);
  const std::optional<int> level = rules.floor_level(out.record.places);
  if (!level) out.error = rules.no_floor(out.record.places);
  if (!level) return out;
  FloorRules::Shown shown = rules.ground_of(field, *level);
  out.record.extent = field.extent();
  out.record.floor_level = *level;
  out.record.climbed.assign(shown.grid.ground.size(), false);
  for (const int at : shown.climbed) out.record.climbed[static_cast<std::size_t>(at)] = true;
  out.grid = std::move(shown.grid);
  return out;
}

SeenGround seen_in(const Voxels& voxels, const FloorRules& rules) {
  const std::optional<Levels> levels = rules.levels();
  SeenGround out = seen_in(HeightField(voxels, rules.threads(), std::nullopt, levels), rules);
  if (levels && !rules.expected_level(out.record.places))
    out = seen_in(HeightField(voxels, rules.threads()), rules);
  return out;
}

MapSurvey completed(MapSurvey survey, const FloorRules& rules, const SurveyRecord& record) {
  if (!survey.error.empty()) return refused(std::move(survey.error));
  survey.levels = rules.largest_levels(record.places);
  survey.floor_height = record.floor_level * rules.voxel();
  return survey;
}

MapSurvey in_cells(const SeenGround& seen, const FloorRules& rules) {
  if (!seen.error.empty()) return refused(seen.error);
  return completed(resample(seen.grid, rules.config()), rules, seen.record);
}

}  // namespace

MapSurvey survey_map(const Voxels& voxels, const SurveyConfig& config) {
  if (!voxels.error.empty()) return refused(voxels.error);
  const FloorRules rules(config, voxels.resolution);
  if (voxels.seen && rules.see_the_same(*voxels.seen)) return in_cells(*voxels.seen, rules);
  return in_cells(seen_in(voxels, rules), rules);
}

void see_ground(Voxels& voxels, const SurveyConfig& config) {
  if (!voxels.error.empty()) return;
  voxels.seen = std::make_shared<const SeenGround>(
      seen_in(voxels, FloorRules(config, voxels.resolution)));
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
  if (!out) {
    SeenGround seen = seen_in(HeightField(voxels, rules.threads()), rules, std::move(*record));
    *record = std::move(seen.record);
    out = seen.error.empty() ? resample(seen.grid, config) : refused(seen.error);
  }
  out->record = record;
  return completed(*std::move(out), rules, *record);
}

}  // namespace navvi_floor
