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

MapSurvey survey_all(const HeightField& field, const FloorRules& rules, SurveyRecord& record) {
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

/// Those that were measured already, if all these levels are there.
std::shared_ptr<const HeightField> columns_for(const Voxels& voxels, const FloorRules& rules,
                                               const std::optional<Levels>& levels) {
  if (voxels.columns && voxels.columns->has(levels)) return voxels.columns;
  return std::make_shared<const HeightField>(voxels, rules.threads(), std::nullopt, levels);
}

MapSurvey completed(MapSurvey survey, const FloorRules& rules, const SurveyRecord& record) {
  if (!survey.error.empty()) return refused(std::move(survey.error));
  survey.levels = rules.largest_levels(record.places);
  survey.floor_height = record.floor_level * rules.voxel();
  return survey;
}

}  // namespace

MapSurvey survey_map(const Voxels& voxels, const SurveyConfig& config) {
  if (!voxels.error.empty()) return refused(voxels.error);
  SurveyRecord record;
  const FloorRules rules(config, voxels.resolution);
  const auto columns = columns_for(voxels, rules, rules.levels());
  MapSurvey out = survey_all(*columns, rules, record);
  if (!columns->has(std::nullopt) && !rules.expected_level(record.places))
    out = survey_all(HeightField(voxels, rules.threads()), rules, record);
  return completed(std::move(out), rules, record);
}

void measure_columns(Voxels& voxels, const SurveyConfig& config) {
  const FloorRules rules(config, voxels.resolution);
  if (voxels.error.empty()) voxels.columns = columns_for(voxels, rules, rules.levels());
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
  if (!out) out = survey_all(HeightField(voxels, rules.threads()), rules, *record);
  out->record = record;
  return completed(*std::move(out), rules, *record);
}

}  // namespace navvi_floor
