#include "drive/stick_age.hpp"

#include <cmath>

namespace navvi_feedback::drive {

StickAge::Late StickAge::late(double time) const {
  constexpr double kSlow = 0.3;     // s
  constexpr double kTooLate = 1.0;  // s
  constexpr double kSilent = 0.25;  // s, as a stick is lost that is silent for so long
  if (time - time_ > kSilent) return Late::no;
  if (!(std::abs(age_) <= kTooLate)) return Late::too_late;
  return age_ > kSlow ? Late::slow : Late::no;
}

}  // namespace navvi_feedback::drive
