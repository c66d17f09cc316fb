#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "navvi_feedback/haptics/rumble.hpp"
#include "types.hpp"

namespace navvi_feedback::lead {

/// What a person who drives is to do now: what a continuous display shows them.
struct Course {
  double turn = 0.0;   ///< rad, clockwise, from the nose to where to steer
  double speed = 0.0;  ///< share of the full speed, [0, 1]; 0: turn on the spot
};

/// The way that is to be shown.
struct Way {
  double off = 0.0;  ///< rad, clockwise, from the nose to where to steer
  double corner = std::numeric_limits<double>::infinity();  ///< m, to the next one
  double turn = 0.0;                                        ///< rad, there
};

/// Says how fast the way ahead may be driven: slower into a turn and before a corner, and towards
/// what stands or moves ahead; nothing where the robot is to stand. Past what waits beside the lane
/// it creeps, and up to what does not go away. A person steers late, by what was shown before: the
/// turn that this has yet to bring is not shown again (Smith's predictor, 1957).
class Pilot {
 public:
  /// Call it at 50 Hz or more.
  /// \param way  nullopt: nothing leads
  /// \param beside  m, gap to what stands beside the robot, within which it is led away, and
  /// slowly; with kBesideByHand also slowly towards what the nose points at beside the lane
  /// \param speed  m/s, of the robot
  /// \param full  m/s, at full stick
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::optional<Course> update(const std::optional<Way>& way,
                                             const std::vector<NearThing>& nearby, double beside,
                                             double speed, double full, double time);

 private:
  /// rad, clockwise, that what was shown is still to turn the robot by
  [[nodiscard]] double pending(double time);

  std::deque<std::pair<double, double>> shown_;  ///< s; rad
  std::optional<double> went_;  ///< s, when the way was last free to drive, or there was none
};

/// `beside`, as pulses show a turn later and more coarsely than a sound does.
constexpr double kBesideBySound = 0.3, kBesideByHand = 0.4;  // m
/// rad; more is turned on the spot, and less than kWorthTurning is not worth a turn on the spot.
constexpr double kOnTheSpot = 0.8, kWorthTurning = 0.35;

/// A course as one sound between the ears: its place is the angle to steer, its pitch the speed.
/// Silence is to stand, so that a dead voice leads nobody on.
/// \return shares of the left and the right ear; their sum is the speed, from kSlowest to 1
[[nodiscard]] haptics::Rumble flow_of(const Course& course);

/// Of the sum, where the robot is to turn on the spot.
constexpr double kSlowest = 0.1;
/// rad, that sounds in one ear alone.
constexpr double kFullTurn = 0.7;

}  // namespace navvi_feedback::lead
