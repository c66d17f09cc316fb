#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "senses/observation.hpp"

namespace navvi_feedback::senses {

/// What a person is told is true when their answer arrives at the wheels: a robot at the other end
/// of a connection obeys, until then, the commands that are under way. Times are s of one clock
/// that does not run backwards.
class Foresight {
 public:
  /// Each beat. \param command  that is sent now
  void sent(const Velocity& command, double time);
  /// The robot's place after that. \param over  s, the round trip
  [[nodiscard]] navvi_types::Pose2 place(const navvi_types::Pose2& robot, double over,
                                         double time) const;
  /// What was seen of the robot, of what is near it and of its way, likewise.
  /// \param robot  as it was seen; nullopt: unknown
  void look_ahead(Observation& now, const std::optional<navvi_types::Pose2>& robot, double over,
                  double time) const;

 private:
  /// In base_link as it was last seen.
  [[nodiscard]] navvi_types::Pose2 moved(double over, double time) const;
  [[nodiscard]] Velocity at(double time) const;

  std::deque<std::pair<double, Velocity>> sent_;  ///< s, and what holds from then on
};

}  // namespace navvi_feedback::senses
