#pragma once

#include <string>

#include "cues/cue_config.hpp"
#include "drive/buttons.hpp"
#include "drive/drive.hpp"
#include "haptics/haptics.hpp"
#include "link/delay_line.hpp"
#include "navvi_feedback/core/guide.hpp"
#include "sounds/sounds_config.hpp"

namespace navvi_feedback::core {

/// The parameters of all that decides on the person's side.
struct GuideConfig::Values {
  /// s, guidance, proximity, odometry (wall clock) or the robot's pose (ROS time) older than this
  /// is lost
  static constexpr double kStale = 0.8;
  std::string lesson = "none";  ///< as Teacher takes it; of a run, not of a person, as the next two
  std::string questions;        ///< path, likewise
  bool locked = false;          ///< the menu offers neither goals nor settings
  std::string places;           ///< path of a file as menu::read_places() takes it; empty: none
  std::string lead = "ticks";   ///< as senses::Lead
  link::LinkConfig link;
  drive::DriveConfig drive;
  drive::ButtonsConfig buttons;
  haptics::HapticsConfig haptics;
  sounds::SoundsConfig sounds;
  cues::CuePolicyConfig cues;

  /// \param way  as `lead` \return whether what it leads by is on
  [[nodiscard]] bool may_lead(const std::string& way) const {
    return (way != "hand" || haptics.enabled) && (way != "flow" || sounds.enabled);
  }
};

}  // namespace navvi_feedback::core
