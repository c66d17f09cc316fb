#pragma once

#include <optional>

#include "cues/clock_face.hpp"
#include "cues/cue_config.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// After "straight ahead" a person drives on along the robot's heading. If that leads into a thing,
/// along one that is all but touched, or along one that the path leaves, the hour on the path's
/// side is nearer to the truth, however small the angle; unless something blocks that side, too.
/// \param now  with a guidance whose angle to steer to lies within the hour 12
/// \param in_the_way  m, gap; a thing farther ahead need not be passed yet
/// \param held  the last answer led off, so that it takes more to lead ahead again
/// \return 12, or 1 or 11
[[nodiscard]] int lead_off(const Observation& now, double in_the_way, bool held);

/// Where to steer, as an hour seen from the robot's nose, and what the robot does about it.
class Bearing {
 public:
  explicit Bearing(const RouteConfig& config);

  /// Call it at each look. \param now  with a guidance
  /// \param halted  the person waits for "go on", and is led off a thing sooner
  /// \param time  s, monotonic
  void observe(const Observation& now, bool halted, double time);
  /// What was held was the direction to another corner.
  void begin_leg() { steady_.reset(); }
  /// The path is gone.
  void reset();

  /// To where to steer; held against trembling. \return nullopt: unknown
  [[nodiscard]] std::optional<int> hour() const { return hour_; }
  /// The hour is not 12 only for the sake of a thing that is near.
  [[nodiscard]] bool leads_off() const { return leads_off_; }
  /// The robot turns on the spot, or has not settled yet.
  [[nodiscard]] bool turns(double time) const;
  /// The person has not moved the stick for some seconds.
  [[nodiscard]] bool idle(double time) const { return time - last_commanded_ > config_.kIdle; }
  [[nodiscard]] Rounding rounding() const { return rounding_; }

 private:
  RouteConfig config_;
  Rounding rounding_;
  SteadyHour steady_;
  std::optional<int> hour_;
  bool leads_off_ = false;
  std::optional<double> last_turning_;  ///< s
  double last_commanded_ = 0.0;         ///< s
};

}  // namespace navvi_feedback::cues
