#include "navvi_people/people/pulses.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace navvi_people::people {
namespace {

constexpr double kFelt = 0.02;      // of a motor; each person's threshold was applied before
constexpr double kHard = 0.8;       // of both motors: a pattern
constexpr double kStrong = 0.5;     // of one motor
constexpr double kSlight = 0.27;    // rad, a weak pulse
constexpr double kAmple = 0.55;     // rad, a strong one
constexpr double kOnTheSpot = 0.9;  // rad, one without a break
constexpr double kUnbroken = 0.25;  // s
constexpr double kGone = 1.6;       // times the interval: there is no further pulse
constexpr double kLongest = 1.2;    // s, between two pulses

struct Pace {
  double interval;  ///< s, up to which
  double speed;     ///< share of the full speed
};
constexpr std::array<Pace, 3> kPaces = {{{0.4, 1.0}, {0.7, 0.5}, {kLongest, 0.17}}};

double speed_of(double interval) {
  for (const Pace& pace : kPaces)
    if (interval > 0.0 && interval <= pace.interval) return pace.speed;
  return kPaces.back().speed;
}

}  // namespace

void Pulses::feel(const Felt& felt, double time) {
  const bool was = std::max(last_.left, last_.right) > kFelt;
  const bool is = std::max(felt.left, felt.right) > kFelt;
  last_ = felt;
  on_ = is;
  if (!is || was) return;
  interval_ = begun_ && time - *begun_ <= kLongest ? time - *begun_ : 0.0;
  begun_ = time;
  pattern_ = std::min(felt.left, felt.right) >= kHard;
  const double lean = felt.right - felt.left;
  const bool both = std::min(felt.left, felt.right) > kFelt;
  const double size = std::max(felt.left, felt.right) > kStrong ? kAmple : kSlight;
  aim_ = {both ? 0.0 : std::copysign(size, lean), speed_of(interval_)};
}

std::optional<Aim> Pulses::update(double time) {
  if (!begun_ || pattern_) return std::nullopt;
  const bool one_side = std::min(last_.left, last_.right) <= kFelt;
  if (on_ && one_side && time - *begun_ > kUnbroken)
    return Aim{std::copysign(kOnTheSpot, aim_.turn), 0.0};
  const double next = interval_ > 0.0 ? kGone * interval_ : kLongest;
  if (!on_ && time - *begun_ > next) return std::nullopt;
  return aim_;
}

}  // namespace navvi_people::people
