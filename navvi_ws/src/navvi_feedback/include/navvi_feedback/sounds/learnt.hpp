#pragma once

namespace navvi_feedback::sounds {

/// Of a person and a robot, from the turns that a sound has led so far.
struct Learnt {
  double stopping_delay = 0.0;   ///< s, from the sound to stop at until the robot stands, mean
  double stopping_spread = 0.0;  ///< s, its standard deviation, from turn to turn
  double turn_error = 0.0;       ///< rad, what is left of a turn then, mean of the latest
  bool words_lead = false;       ///< as turns by sounds have left too much, or for their sides
  bool sides_wrong = false;      ///< the person takes sounds for those of the other side
};

}  // namespace navvi_feedback::sounds
