#pragma once

#include <navvi_types/cue_kind.hpp>
#include <navvi_types/motion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "navvi_feedback/drive/button.hpp"
#include "navvi_feedback/drive/input_state.hpp"

namespace navvi_feedback::senses {

/// State of a stream of messages, or of a device.
enum class Link { never, alive, lost };

/// The devices of a person at one instant, and the robot's place.
struct Devices {
  drive::InputState hands;
  bool keyboard = false;                     ///< the hands are on the arrow keys
  Link audio = Link::alive;                  ///< the sound device
  std::string ears;                          ///< the sound device, by a word; empty: it is none of ours
  bool words = true;                         ///< words are wanted; false: none is ever heard
  bool sounds = true;                        ///< short sounds reach somebody
  bool voice = true;                         ///< and so do words that begin now
  bool heard = true;                         ///< and so did the last ones, to their end
  bool motors = true;                        ///< false if our own pad is not connected, or silent
  bool felt = true;                          ///< there are motors that somebody feels
  std::string pad;                           ///< identifies the motors, without spaces
  bool speaking = false;                     ///< the voice still speaks the last text
  std::optional<navvi_types::Pose2> robot;   ///< base_link in map, if known
  std::vector<drive::Button> asked;          ///< by other means than the hands, since the last beat
  std::vector<navvi_types::Content> states;  ///< said when they begin, such as no_rumble
  std::string person;                        ///< whose settings are used, if anybody's
};

}  // namespace navvi_feedback::senses
