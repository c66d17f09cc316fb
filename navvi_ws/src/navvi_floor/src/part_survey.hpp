#pragma once

#include <optional>

#include "floor_rules.hpp"
#include "navvi_floor/floor.hpp"
#include "navvi_floor/survey.hpp"
#include "survey_record.hpp"

namespace navvi_floor {

/// Surveys what differs from the map before. \returns nothing if all must be surveyed
/// \param changed  columns outside of which both maps are the same
/// \param floor  of the map before \param record  of the new map
[[nodiscard]] std::optional<MapSurvey> survey_part(const Area& changed, const FloorRules& rules,
                                                   const SurveyRecord& before, const Floor& floor,
                                                   SurveyRecord& record);

}  // namespace navvi_floor
