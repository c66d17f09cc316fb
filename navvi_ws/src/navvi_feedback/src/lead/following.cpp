#include "lead/following.hpp"

#include <cmath>
#include <utility>

namespace navvi_feedback::lead {

void Following::update(std::optional<double> off, const navvi_types::Velocity& motion,
                       double time) {
  constexpr double kMuch = 0.5;      // rad, to be turned
  constexpr double kAway = 0.8;      // rad, turned away in one go
  constexpr double kTurns = 0.15;    // rad/s
  constexpr double kPatience = 6.0;  // s
  const double dt = time - std::exchange(time_, time);
  if (!off || std::abs(*off) < kMuch) {
    since_.reset();
    away_ = 0.0;
    return;
  }
  const bool turns = std::abs(motion.angular) > kTurns;
  // What lies clockwise is turned to by a negative rate.
  const bool towards = turns && motion.angular * *off < 0.0;
  away_ = turns && !towards ? away_ + std::abs(motion.angular) * dt : 0.0;
  if (towards || !since_) since_ = time;
  if (away_ <= kAway && time - *since_ <= kPatience) return;
  ++missed_;
  since_.reset();
  away_ = 0.0;
}

}  // namespace navvi_feedback::lead
