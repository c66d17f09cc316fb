#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "navvi_feedback/guidance.hpp"
#include "navvi_feedback/link.hpp"
#include "navvi_feedback/nearby.hpp"

namespace navvi_feedback {

/// Everything that is known at one instant and may have to be said. Every number is finite.
struct Situation {
  struct Motion {
    double linear = 0.0;   ///< m/s, forward
    double angular = 0.0;  ///< rad/s, counter-clockwise
  };
  struct Contact {
    ThingClass thing_class = ThingClass::other;
    Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< m, in base_link
    std::uint32_t id = 0;                             ///< of the thing
  };
  /// The last stage before the wheels, as navvi_msgs/DriveState.
  enum class Gate { unknown, waiting, running, stopped };

  std::optional<Guidance> guidance;  ///< the latest
  std::optional<double> goal_angle;  ///< rad, clockwise from the nose to the goal, if it is known
  std::vector<Nearby> nearby;        ///< the latest; empty if stale
  std::vector<Contact> contacts;     ///< begun since the last update
  Motion commanded;                  ///< what was last sent to the robot
  bool stick_held_unarmed = false;   ///< held since before it was neutral, so nothing is sent
  std::optional<Motion> measured;    ///< nullopt while the odometry is missing or stale
  Gate gate = Gate::unknown;

  Link guidance_link = Link::never;
  Link proximity_link = Link::never;
  Link simulator_link = Link::never;  ///< /clock or, on a robot, the odometry
  Link pad_link = Link::never;
  Link audio_link = Link::never;

  bool repeat_pressed = false;  ///< the button went down since the last update
  bool goal_pressed = false;
  bool voice_busy = false;  ///< something is being spoken or waits for it

  std::vector<std::string> notices;  ///< kinds to be said once each, such as no_rumble
};

}  // namespace navvi_feedback
