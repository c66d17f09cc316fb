#pragma once

#include <Eigen/Core>
#include <navvi_types/cue_event.hpp>
#include <navvi_types/motion.hpp>
#include <navvi_types/trial.hpp>
#include <optional>
#include <string>
#include <vector>

#include "navvi_feedback/cues/voice_order.hpp"
#include "navvi_feedback/haptics/rumble.hpp"
#include "navvi_feedback/menu/named_place.hpp"
#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::core {

/// What goes to the wheels, to the person and to other nodes after one beat.
struct Output {
  std::optional<navvi_types::Velocity> command;  ///< nullopt: nothing is sent
  double lag = 0.0;    ///< s, of a simulated connection: the age of what the command answers
  /// m, in map, where the robot will stand if the stick is let go now; nullopt without a delay
  std::optional<Eigen::Vector2d> stops_at;

  haptics::Rumble rumble;                     ///< of the motors, now
  bool rumble_due = false;                    ///< other drivers are to be sent it
  bool rumble_moved = false;                  ///< and it has changed
  std::optional<navvi_types::CueEvent> felt;  ///< worth a row of the record
  haptics::Rumble flow;  ///< shares of both ears of the sound that lasts, as lead::flow_of()
  double flow_gain = 0.0;  ///< [0, 1]
  std::optional<navvi_types::CueEvent> flowed;  ///< worth a row of the record

  bool alarm_begins = false;                  ///< the motors begin to report that there is no sound

  cues::VoiceOrder voice;
  bool answers = false;                     ///< a button's question among the words
  std::vector<navvi_types::CueEvent> said;  ///< of the words, in order
  std::vector<sounds::Play> plays;          ///< short sounds that begin now

  std::optional<navvi_types::TrialRequest::Kind> request;
  std::optional<Eigen::Vector2d> goal;    ///< m, in map, that the person has chosen
  std::optional<menu::NamedPlace> place;  ///< to be remembered
  std::string change;  ///< that the person has made, such as "speaker/rate:=240"; empty: none

  bool lesson_over = false;
  std::string record;                 ///< how the lesson went so far, as a table in CSV
  std::vector<std::string> settings;  ///< that it has found, such as haptics/enabled:=true
};

}  // namespace navvi_feedback::core
