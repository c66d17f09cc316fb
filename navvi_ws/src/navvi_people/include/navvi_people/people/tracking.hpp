#pragma once

#include <cstdint>
#include <deque>
#include <navvi_types/random.hpp>
#include <optional>

#include "navvi_people/people/heard.hpp"

namespace navvi_people::people {

using navvi_types::Random;

/// What a continuous display asks of the hand.
struct Aim {
  double turn = 0.0;   ///< rad, clockwise, still to be turned
  double speed = 0.0;  ///< share of the full speed, [0, 1]
};

/// How late a hand follows a display, s, and how wrongly.
struct Lag {
  double steer = 0.3;  ///< from the side that is shown to the stick
  double speed = 0.45; ///< from more speed that is shown to the stick
  double stop = 0.3;   ///< from less speed, or from the display's end
  double noise = 0.15; ///< remnant, standard deviation as a share of what is shown
  double lapses = 0.0; ///< 1/s, times that a turn is taken for a smaller one, for a second
};

struct TrackingConfig {
  bool faults = true;
  double delay = 0.3;        ///< s, from a sound's place between the ears to the stick
  double speed_delay = 0.45; ///< s, from its pitch to the stick
  double noise = 0.15;       ///< standard deviation of what is followed, as a share of it
};

/// Follows a continuous display as the crossover model has it (McRuer and Jex 1967): with a delay,
/// with the gain that keeps the loop stable at that delay, and with a remnant in proportion to what
/// is shown (Levison, Baron and Kleinman 1969). Times are s, not going back.
class Tracking {
 public:
  Tracking(const Lag& lag, bool faults, std::uint64_t seed)
      : lag_(lag), faults_(faults), random_(seed) {}

  /// From now on. \param aim  nullopt: nothing is shown
  void show(std::optional<Aim> aim, double time);
  /// What the hand follows now; nullopt: nothing.
  /// \param distracted  s, that words or another task add to each delay
  [[nodiscard]] std::optional<Aim> update(double time, double dt, double distracted);
  /// s, since when something is followed; nullopt: nothing is
  [[nodiscard]] std::optional<double> since() const { return since_; }
  /// 1/s, turn rate over the angle that is shown: a phase margin of some 55 degrees
  [[nodiscard]] double gain() const;

 private:
  struct Shown {
    double time = 0.0;  ///< s
    std::optional<Aim> aim;
  };
  [[nodiscard]] std::optional<Aim> shown(double time) const;
  [[nodiscard]] Aim mistaken(Aim aim, double time, double dt);

  Lag lag_;
  bool faults_;
  Random random_;
  std::deque<Shown> shown_;
  std::optional<double> since_;
  double turn_error_ = 0.0, speed_error_ = 0.0;  ///< of one standard deviation
  double lapses_until_ = -1e9;                   ///< s
};

/// Reads pulses of the motors as the lesson on the way by hand teaches them: the side is where to
/// turn, weak or strong how far, both sides straight on; the quicker the pulses the faster to
/// drive; one side without a break: turn on the spot; no pulse: stand. Two hard motors are a
/// pattern, and no pulse of the way.
class Pulses {
 public:
  /// The motors, from now on.
  void feel(const Felt& felt, double time);
  /// What they ask for now; nullopt: to stand.
  [[nodiscard]] std::optional<Aim> update(double time);

 private:
  Felt last_;
  std::optional<double> begun_;  ///< s, of the last pulse
  bool on_ = false;
  bool pattern_ = false;         ///< the last pulse is part of one
  double interval_ = 0.0;        ///< s, between the last two; 0: there was one
  Aim aim_;
};

}  // namespace navvi_people::people
