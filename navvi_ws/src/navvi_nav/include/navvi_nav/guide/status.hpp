#pragma once

#include <optional>
#include <string>

#include "navvi_nav/guide/conflict_forecast.hpp"
#include "navvi_nav/guide/guidance.hpp"
#include "navvi_nav/plan/guidance_enums.hpp"

namespace navvi_nav::guide {

/// navvi_msgs/Guidance without ROS.
struct Status {
  plan::State state = plan::State::no_map;
  plan::Refusal refusal = plan::Refusal::none;
  plan::Reason reason = plan::Reason::none;  ///< of the last plan
  unsigned plans = 0;
  double plan_time = 0.0;  ///< s
  std::size_t nodes_expanded = 0;
  unsigned reroutes = 0;                             ///< of this goal
  plan::Reason reroute_reason = plan::Reason::none;  ///< of the last of them
  double churn = 0.0;                                ///< m/min
  std::optional<double> mesh_age;                    ///< s
  std::optional<double> map_age;                     ///< s
  std::optional<Blocker> blocked;                    ///< what the robot waits for, or yields to
  Point goal;
  Heading heading;               ///< valid while following, blocked or make_room, like all below
  double eta = 0.0;              ///< s
  double shortest_length = 0.0;  ///< m
  double smoothing_price = 0.0;  ///< m
  std::string detail;
};

}  // namespace navvi_nav::guide
