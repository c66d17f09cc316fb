#pragma once

#include <navvi_types/cue_event.hpp>
#include <optional>
#include <vector>

#include "record/row.hpp"

namespace navvi_study::batch {

/// Judges how well a robot is turned to where it is led, whatever leads it.
class TurnFigures {
 public:
  /// Call it at a steady rate. \param rate  rad/s, counter-clockwise \param forward  m/s
  /// \param off  rad, clockwise from the nose to where to steer; nullopt: nowhere
  void watch(double rate, double forward, std::optional<double> off, double time);
  /// A sentence or a sound that asks for a turn begins.
  void ask(double time);

  /// Adds `led_turns`, turns on the spot of more than 15 deg that ended while there was somewhere
  /// to steer; `residual`, deg, the median of what they left; `residual_90`, deg, which a tenth of
  /// them exceed; and `cue_to_action`, s, the median from a cue that asks for a turn to a robot
  /// that did not turn and now does. n/a where there was none.
  void add_to(record::Fields& row) const;

 private:
  double turned_ = 0.0;                ///< rad, of this turn
  std::optional<double> still_since_;  ///< s, no faster than a robot that stands
  std::optional<double> asked_;        ///< s, and not acted upon
  bool turns_ = false;
  double time_ = 0.0;         ///< s, of the last look
  std::vector<double> left_;  ///< rad
  std::vector<double> late_;  ///< s
};

}  // namespace navvi_study::batch
