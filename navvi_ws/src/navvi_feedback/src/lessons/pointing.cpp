#include "lessons/pointing.hpp"

#include <cmath>

#include "cues/clock_face.hpp"

namespace navvi_feedback::lessons {
namespace {

constexpr double kPushed = 0.6;                  // of the stick
constexpr double kRest = 0.3;                    // it is at rest again
constexpr double kStray = 10.0 * cues::kDegree;  // rad
constexpr double kHeld = 0.5;                    // s
constexpr double kSlack = 1e-9;                  // s, of rounding

}  // namespace

std::optional<Pointing::Direction> Pointing::update(const drive::Stick& stick, double time) {
  const double out = std::hypot(stick.x, stick.y);
  if (out < kRest) {
    pushed_.reset();
    taken_ = false;
  }
  if (out < kPushed) {
    since_ = time;
    return std::nullopt;
  }
  const double angle = std::atan2(stick.x, stick.y);
  const bool first = !pushed_;
  if (first) pushed_ = time;
  if (first || std::abs(std::remainder(angle - angle_, 2.0 * M_PI)) > kStray) {
    angle_ = angle;
    since_ = time;
  }
  if (taken_ || time - since_ < kHeld - kSlack) return std::nullopt;
  taken_ = true;
  const int degrees = static_cast<int>(std::lround(angle / cues::kDegree));
  return Direction{degrees == -180 ? 180 : degrees, *pushed_};
}

}  // namespace navvi_feedback::lessons
