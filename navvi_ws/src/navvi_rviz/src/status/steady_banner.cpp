#include "status/steady_banner.hpp"

namespace navvi_rviz::status {

Shown SteadyBanner::hold(Shown shown, double time) {
  constexpr double kLeast = 0.35;  // s
  const bool changed = !last_ || shown.banner != last_->banner || shown.tone != last_->tone;
  if (changed && last_ && time - since_ < kLeast) {
    shown.banner = last_->banner;
    shown.tone = last_->tone;
  } else if (changed) {
    since_ = time;
    last_ = shown;
  }
  return shown;
}

}  // namespace navvi_rviz::status
