#pragma once

#include <navvi_types/drive_state.hpp>
#include <navvi_types/guidance.hpp>
#include <navvi_types/scenario.hpp>
#include <navvi_types/trial.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cues/phrases.hpp"
#include "navvi_feedback/cues/link.hpp"

namespace navvi_feedback {
using navvi_types::Contact;
using navvi_types::DriveState;
using navvi_types::Guidance;
using navvi_types::NearThing;
using navvi_types::TrialState;
using navvi_types::Velocity;
}  // namespace navvi_feedback

namespace navvi_feedback::cues {

/// What a person asks by a button, in the order of drive::Button.
enum class Question {
  way,     ///< the last direction again
  goal,    ///< where it is
  around,  ///< what is near, and on which side
  where,   ///< in which part of the world the robot is, and the goal from there
  turn,    ///< the next one
  help,    ///< what the buttons do
};

/// Which sounds are heard, and do the work of words.
struct Sounds {
  bool turn = false;   ///< to where to steer
  bool shelf = false;  ///< a shelf or a wall that is near
  bool near = false;   ///< any other thing that is near
};

/// All that cues are decided from, at one instant. Every number is finite.
struct Situation {
  std::optional<Guidance> guidance;  ///< the latest
  std::optional<double> goal_angle;  ///< rad, clockwise from the nose to the goal, if it is known
  double goal_straight = 0.0;        ///< m, to the goal as the crow flies, where that is known
  std::optional<navvi_types::Place> place;  ///< the smallest that the robot is in
  std::vector<NearThing> nearby;            ///< the latest; empty if stale
  std::vector<Contact> contacts;            ///< begun since the last update
  Velocity commanded;                       ///< what was last sent to the robot
  TrialState::State trial = TrialState::State::free;
  bool stick_held_unarmed = false;        ///< held since before it was neutral, so nothing is sent
  std::optional<Velocity> measured;       ///< nullopt while the odometry is missing or stale
  std::optional<DriveState::State> gate;  ///< of the last stage before the wheels, if it is known
  Links links;
  bool keyboard = false;             ///< the stick is the arrow keys
  std::optional<Utterance> menu;     ///< what the menu answers to a button
  std::optional<Question> question;  ///< whose button went down since the last update
  bool voice_busy = false;           ///< something is being spoken or waits for it

  Sounds sounds;
  bool touch = false;  ///< what is said is felt, too, and so may do without the words

  std::vector<CueKind> notices;  ///< to be said when they come, such as no_rumble
  std::string person;            ///< whose settings are used
};

}  // namespace navvi_feedback::cues
