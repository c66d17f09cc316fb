#pragma once

namespace navvi_feedback::haptics {

/// What the two motors of the pad do, each in [0, 1].
struct Rumble {
  double left = 0.0;   ///< the strong motor
  double right = 0.0;  ///< the weak motor
  bool sides = false;  ///< the sides matter: felt at the triggers, too, where these have motors
};

}  // namespace navvi_feedback::haptics
