#pragma once

#include <optional>

#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// The words for a stick that is lost, or whose messages come too late.
[[nodiscard]] Content lost_stick(const Observation& now);
/// The words for a robot that is silent: of the connection, the simulator, or its odometry.
[[nodiscard]] Content lost_robot(const Observation& now);

/// A device that comes and goes: its loss counts at once, its return too, unless it flaps; then it
/// counts as lost until it has been steady, so that its loss is told once.
class Flapping {
 public:
  /// \param now  as it is \param time  s \return as it counts
  [[nodiscard]] Link judge(Link now, double time);

 private:
  Link last_ = Link::never;  ///< as it was
  Link counts_ = Link::never;
  double back_ = -1e9;  ///< s, when it was alive again last
  bool flaps_ = false;
};

/// Tells which link is lost, and which is back. A loss that follows from that of the simulator or
/// the pad has no cue of its own.
class LinkCues {
 public:
  /// \param patience  s, after which a link that never lived counts as lost
  explicit LinkCues(double patience) : patience_(patience) {}

  /// Call it once a tick, first. \param time  s, monotonic \return the links as judged
  const Links& judge(const Observation& now, double time);
  [[nodiscard]] Utterances update(const Observation& now);

  /// Without a stick no path can be followed; its return is said first, then the direction.
  [[nodiscard]] bool steered() const { return links_.pad != Link::lost && last_.pad != Link::lost; }
  /// s, since the first tick
  [[nodiscard]] double age(double time) const { return time - first_.value_or(time); }

 private:
  double patience_;
  std::optional<double> first_;  ///< s, of the first tick
  bool cut_off_ = false;         ///< as the robot was last lost
  double sensed_ = 0.0;          ///< s, when proximity was last not lost
  Flapping pad_, proximity_, audio_;
  Links links_;                                 ///< now
  Links last_;                                  ///< a tick before
  std::optional<DriveState::State> last_gate_;  ///< that was known
};

}  // namespace navvi_feedback::cues
