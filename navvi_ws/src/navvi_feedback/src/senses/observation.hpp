#pragma once

#include <optional>
#include <string>
#include <vector>

#include "navvi_feedback/drive/button.hpp"
#include "navvi_feedback/drive/input_state.hpp"
#include "navvi_feedback/senses/devices.hpp"
#include "types.hpp"

namespace navvi_feedback::senses {

/// What leads a person along the way.
enum class Lead {
  words,
  ticks,  ///< a sound that counts turns down, and words
  flow,   ///< a sound that lasts: its side where to steer, its pitch how fast
  hand,   ///< pulses of the motors, likewise
};
/// It leads while the person drives, without a stop before a turn.
[[nodiscard]] constexpr bool lasts(Lead lead) { return lead == Lead::flow || lead == Lead::hand; }

/// s, since when something has been so; nullopt: it is not. \param since  likewise, a moment ago
[[nodiscard]] inline std::optional<double> since_when(bool so, std::optional<double> since,
                                                      double time) {
  return so ? std::optional(since.value_or(time)) : std::nullopt;
}

/// All that a person depends on.
struct Links {
  Link pad = Link::never;
  Link simulator = Link::never;  ///< /clock or, on a robot, the odometry
  Link proximity = Link::never;
  Link guidance = Link::never;
  Link audio = Link::never;
};

/// Which sounds are heard, and do the work of words.
struct Sounds {
  bool shelf = false;  ///< a shelf or a wall that is near
  bool near = false;   ///< any other thing that is near
};

/// All that is known at one instant. It is built once a tick, and every decision of that tick is
/// made from it. Every number is finite.
struct Observation {
  // The person
  Devices devices;
  std::vector<drive::Button> pressed;  ///< since the last tick
  drive::Stick stick;                  ///< without its dead zone; neutral where there is none
  bool stick_disabled = false;         ///< pushed without the button of hold-to-drive
  bool stick_held_unarmed = false;     ///< held since before it was neutral, so nothing is sent
  bool voice_busy = false;             ///< something is being spoken or waits for it
  std::vector<std::string> begun;      ///< texts of a lesson that began to be heard since then

  // What reaches the person: the device is there, and it is wanted
  bool motors = true;   ///< anything by the motors
  bool touch = false;   ///< what is said is felt, too, and so may do without the words
  bool audible = true;  ///< short sounds
  bool side_asked = false;  ///< the person is asked which side a sound comes from
  Sounds sounds;
  Lead lead = Lead::words;  ///< what leads, as far as it reaches the person

  // The robot
  Links links;
  double stops_in = 0.0;                  ///< m, ahead or back, if the stick is let go now
  LinkState connection;                   ///< as the robot's side measures it
  std::string zone;                       ///< that is told in notices; empty: none
  bool cut_off = false;                   ///< all that comes by it is silent
  bool simulated = false;                 ///< there is a simulator, whose world is known
  bool menu_open = false;                 ///< the person chooses from it
  bool robotless = false;                 ///< a lesson that wants no robot: none of it is missed
  Velocity commanded;                     ///< what was last sent to it
  static constexpr Velocity kNeutral{0.02, 0.05};  ///< m/s, rad/s; a command below is neutral
  std::optional<Velocity> measured;       ///< nullopt while the odometry is missing or stale
  Velocity last_measured;                 ///< the latest, however old
  std::optional<DriveState::State> gate;  ///< of the last stage before the wheels, if it is known
  DriveState::Assistance assistance = DriveState::Assistance::nothing;  ///< likewise
  std::vector<NearThing> nearby;          ///< the latest; empty if stale
  std::vector<Contact> contacts;          ///< begun since the last tick

  // The way
  std::optional<Guidance> guidance;         ///< the latest, however old
  double turned = 0.0;                      ///< rad, counter-clockwise, since that came
  std::optional<double> goal_angle;         ///< rad, clockwise from the nose, if it is known
  double goal_straight = 0.0;               ///< m, as the crow flies, where that is known
  std::optional<navvi_types::Place> place;  ///< the smallest that the robot is in
  TrialState::State trial = TrialState::State::free;
  TrialState::Task task = TrialState::Task::drive;  ///< of a job, where the robot is
  std::string reached;                              ///< that place
  std::vector<Content> notices;  ///< to be said when they come, such as no_rumble

  /// At rest as far as nothing else is known.
  [[nodiscard]] Velocity motion() const { return measured.value_or(Velocity{}); }
  [[nodiscard]] bool arrived() const {
    return guidance && guidance->state == Guidance::State::arrived;
  }
};

}  // namespace navvi_feedback::senses

namespace navvi_feedback {
using senses::Lead;
using senses::Link;
using senses::Links;
using senses::Observation;
using senses::since_when;
using senses::Sounds;
}  // namespace navvi_feedback
