#pragma once

#include <Eigen/Core>
#include <navvi_types/trial.hpp>
#include <string>

namespace navvi_feedback::menu {

struct NamedPlace {
  std::string name;                              ///< as cues::is_place_name() allows
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< m, in map
  navvi_types::TrialState::Task task = navvi_types::TrialState::Task::drive;  ///< of a job, there
};

}  // namespace navvi_feedback::menu
