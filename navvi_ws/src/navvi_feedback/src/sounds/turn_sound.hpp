#pragma once

#include <navvi_types/motion.hpp>
#include <optional>

#include "navvi_feedback/sounds/earcon.hpp"
#include "navvi_feedback/sounds/learnt.hpp"
#include "sounds/sounds_config.hpp"

namespace navvi_feedback {
using navvi_types::Velocity;
}  // namespace navvi_feedback

namespace navvi_feedback::sounds {

/// Counts a rotation down: while the heading is off, ticks from the side to turn to, the faster the
/// less is left; then a sound to stop at, early by what this person and robot take to stop. A soft
/// one now and then while the robot drives where it should: silence could be a fault.
class TurnSound {
 public:
  explicit TurnSound(const TurnConfig& config)
      : config_(config), learnt_{config.stopping_delay, 0.0} {}

  /// From now on.
  void use(const TurnConfig& config) { config_ = config; }

  /// Call it at 50 Hz.
  /// \param off  rad, clockwise from the nose to where to steer; nullopt: nowhere
  /// \param fine  a turn of half as much as usual counts
  /// \param motion  the robot's
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::optional<Play> update(std::optional<double> off, bool fine,
                                           const Velocity& motion, double time);

  /// It is counting now.
  [[nodiscard]] bool sounds() const { return counting_; }
  /// rad/s, that the robot is to turn at most, so that a late hand does little; nullopt: no limit
  [[nodiscard]] std::optional<double> most_rate() const;
  [[nodiscard]] const Learnt& learnt() const { return learnt_; }

 private:
  /// The turn that was told to end.
  struct Stopping {
    double since = 0.0;  ///< s
    double rate = 0.0;   ///< rad/s, at that moment
    double angle = 0.0;  ///< rad, turned since then
  };

  [[nodiscard]] std::optional<Play> on_course(const Velocity& motion, double time);
  void learn(std::optional<double> off, double rate, double time);

  TurnConfig config_;
  Learnt learnt_;
  bool counting_ = false;
  std::optional<double> ticked_;  ///< s
  double heard_ = 0.0;            ///< s, when any of its sounds began last
  std::optional<double> off_since_;
  std::optional<Stopping> stopping_;
  int turns_ = 0;      ///< that it has led
  double left_ = 0.0;  ///< rad, of the turn that is counted down
  double time_ = 0.0;  ///< s, of the last update
};

}  // namespace navvi_feedback::sounds
