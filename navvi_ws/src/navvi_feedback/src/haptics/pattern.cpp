#include "haptics/pattern.hpp"

#include <array>
#include <cmath>
#include <navvi_types/angles.hpp>
#include <vector>

namespace navvi_feedback::haptics {
namespace {

struct Beat {
  double seconds;
  double left;
  double right;
  bool soft = false;  ///< half a sine wave: no jolt at either end
};

constexpr double kTap = 0.4;  // s, a tap of an answer and the pause after it
constexpr Beat kRest = {0.1, 0.0, 0.0};

const std::vector<Beat>& beats(Pattern pattern) {
  static const std::array<std::vector<Beat>, 13> all = {{
      {{0.5, 1.0, 1.0}, kRest},
      {{0.1, 0.5, 0.5}, kRest, {0.1, 0.5, 0.5}, kRest},
      {{0.2, 0.5, 0.5}, kRest},
      {{0.4, 0.6, 0.6, true}, kRest},
      {{0.12, 0.6, 0.0}, {0.06, 0.0, 0.0}, {0.12, 0.0, 0.6}, kRest},
      {{0.15, 0.3, 0.3}, kRest, {0.15, 0.6, 0.6}, kRest, {0.3, 1.0, 1.0}, kRest},
      {{0.25, 0.5, 0.5, true},
       {0.25, 0.0, 0.0},
       {0.25, 0.5, 0.5, true},
       {0.25, 0.0, 0.0},
       {0.25, 0.5, 0.5, true},
       {0.25, 0.0, 0.0}},
      {{0.6, 0.7, 0.7}, {0.4, 0.0, 0.0}},
      {{0.08, 0.8, 0.8},
       {0.08, 0.0, 0.0},
       {0.08, 0.8, 0.8},
       {0.08, 0.0, 0.0},
       {0.08, 0.8, 0.8},
       {0.08, 0.0, 0.0},
       {0.08, 0.8, 0.8},
       kRest},
      {{0.1, 1.0, 1.0}, kRest, {0.3, 1.0, 1.0}, kRest},
      {{0.35, 0.9, 0.9}, {0.15, 0.0, 0.0}, {0.35, 0.9, 0.9}, kRest},
      {{0.15, 1.0, 1.0}, kRest, {0.15, 1.0, 1.0}, kRest},
      {{0.5, 1.0, 1.0}, kRest},
  }};
  return all.at(static_cast<std::size_t>(pattern));
}

}  // namespace

void PatternPlayer::begin(Pattern pattern, Zone side, int taps) {
  if (playing_ && *playing_ > pattern) return;
  taps_ = taps;
  playing_ = pattern;
  side_ = side;
  since_ = 0.0;
}

std::optional<Rumble> PatternPlayer::update(double dt) {
  if (!playing_) return std::nullopt;
  double begins = 0.0;
  for (const Beat& beat : beats(*playing_)) {
    const double within = since_ - begins;
    begins += beat.seconds;
    if (within >= beat.seconds) continue;
    since_ += dt;
    const double force = beat.soft ? std::sin(navvi_types::kPi * within / beat.seconds) : 1.0;
    return Rumble{side_ == Zone::right ? 0.0 : force * beat.left,
                  side_ == Zone::left ? 0.0 : force * beat.right};
  }
  if (const double tap = (since_ - begins) / kTap; tap < taps_) {
    since_ += dt;
    const double force = tap - std::floor(tap) < 0.5 ? 0.7 : 0.0;
    return Rumble{force, force};
  }
  playing_.reset();
  return std::nullopt;
}

}  // namespace navvi_feedback::haptics
