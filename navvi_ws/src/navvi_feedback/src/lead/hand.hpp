#pragma once

#include <optional>

#include "lead/course.hpp"
#include "navvi_feedback/haptics/rumble.hpp"

namespace navvi_feedback::lead {

/// A course as pulses of the two motors: both softly is straight on, one is the side to turn to,
/// softly a little, strongly more, without a break on the spot. The quicker they come the faster to
/// drive. No pulse is to stand: a pad that fails leads nobody on.
class HandPulses {
 public:
  /// \param course  nullopt: to stand \param dt  s since the last call, >= 0
  [[nodiscard]] haptics::Rumble update(std::optional<Course> course, double dt);

 private:
  std::optional<double> since_;  ///< s, since the last pulse began
  haptics::Rumble pulse_;
  bool unbroken_ = false;
};

}  // namespace navvi_feedback::lead
