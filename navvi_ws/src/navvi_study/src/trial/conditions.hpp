#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "record/row.hpp"
#include "trial/trial_monitor.hpp"
#include "trial/trial_node_config.hpp"

namespace navvi_study::trial {

/// What this processor calls itself; n/a where the system does not tell.
[[nodiscard]] std::string processor();
/// On what the last bits of a result depend, by the names of TRIAL_START's fields.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> computer();
/// The GNU build IDs of this program and of the libraries that it has loaded: programs with the
/// same ones compute the same on the same processor. nullopt if one of them has none.
[[nodiscard]] std::optional<std::string> build_ids();

/// The parameters that nodes were given, by names such as nav/mesh/climb.
using Settings = std::map<std::string, std::string>;

/// Adds to the fields of TRIAL_START what a trial is, whoever drives: world, parameters, computer,
/// study, goal and limits.
/// \param phrases  name of the file of the spoken phrases; empty where it is not known
void add_conditions(record::Fields& fields, const TrialNodeConfig& config,
                    const std::optional<Scenario>& scenario, const Settings& settings,
                    const TrialStart& start, const std::string& phrases);

}  // namespace navvi_study::trial
