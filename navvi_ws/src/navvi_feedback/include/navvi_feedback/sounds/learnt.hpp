#pragma once

namespace navvi_feedback::sounds {

/// Of a person and a robot, from the turns that a sound has led so far.
struct Learnt {
  double stopping_delay = 0.0;  ///< s, from the sound to stop at until the robot stands
  double turn_error = 0.0;      ///< rad, what is left of a turn then, mean of the latest
};

}  // namespace navvi_feedback::sounds
