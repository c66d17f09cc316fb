#pragma once

#include <cstdint>

#include "navvi_types/names.hpp"

namespace navvi_types {

/// Patterns of the pad's motors, felt besides what is near; the most urgent last.
enum class Pattern : std::uint8_t {
  sample,        ///< one long pulse: how strong the motors are set
  ready,         ///< two light taps: a trial waits for the person, or for a goal
  begun,         ///< one light tap: it runs
  assisted,      ///< a soft pulse, on the side to which the robot steers by itself
  rerouted,      ///< a light tap on the left, then on the right
  arrived,       ///< three pulses that rise
  no_sound,      ///< three soft pulses: what the voice cannot say
  answer,        ///< a long pulse on the side of the goal, then a tap for each 5 m to it
  stuck,         ///< four quick taps
  halt,          ///< a short and a long pulse: the word is to stop, or to wait
  stopped,       ///< two long pulses: the robot was stopped, or the trial
  hit_obstacle,  ///< two hard knocks, on its side
  hit_shelf,     ///< one long hard pulse, on its side: a shelf or a wall
};

/// Short sounds, each recognisably its own.
enum class Earcon : std::uint8_t {
  turn,       ///< the heading is off, to that side; the faster, the less
  turn_stop,  ///< no further
  on_course,  ///< straight on
  hit_shelf,  ///< or a wall
  hit_obstacle,
  shelf_near,  ///< or a wall
  shelf_close,
  worker_near,
  worker_close,
  forklift_near,
  forklift_close,
  pallet_robot_near,
  pallet_robot_close,
  thing_near,  ///< anything else
  thing_close,
  arrived,
  beacon,      ///< from the next way-point; the faster, the nearer
  turn_click,  ///< as turn, while words are spoken: short, and above them
  unsaid,      ///< instead of words: the voice was lost twice over them
  flow,        ///< all the time, not short: to where to steer, and how fast
};

}  // namespace navvi_types
