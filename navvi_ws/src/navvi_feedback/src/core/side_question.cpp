#include "core/side_question.hpp"

#include <cmath>

namespace navvi_feedback::core {

std::optional<bool> SideQuestion::end(std::optional<bool> right) {
  over_ = true;
  asks_ = false;
  return right;
}

std::optional<bool> SideQuestion::update(bool may, bool quiet, double aside, double time) {
  constexpr double kEvery = 1.2;      // s, between two sounds
  constexpr double kPatience = 12.0;  // s
  constexpr double kAside = 0.5;      // of the stick
  sounds_.reset();
  asks_ = may && !over_;
  // Whoever begins the trial does not want to be asked again.
  if (!asks_) return told_ ? end(std::nullopt) : std::nullopt;
  if (!told_) return std::nullopt;
  if (side_ == 0.0) {
    side_ = std::fmod(time, 0.2) < 0.1 ? 1.0 : -1.0;  // by chance
    since_ = time;
    last_ = time - kEvery;
  }
  if (quiet && time - last_ >= kEvery) {
    last_ = time;
    sounds_ = side_;
  }
  neutral_ = neutral_ || std::abs(aside) < 0.1;
  if (neutral_ && std::abs(aside) > kAside) return end(aside * side_ > 0.0);
  return time - since_ > kPatience ? end(std::nullopt) : std::nullopt;
}

}  // namespace navvi_feedback::core
