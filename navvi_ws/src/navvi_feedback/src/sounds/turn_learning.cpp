#include "sounds/turn_learning.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::sounds {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
/// Of what a turn teaches: of what it left, and of its stop.
constexpr double kWeight = 0.3;
constexpr double kStopWeight = 0.15;
constexpr double kSlowest = 2.0;  // s
/// Standard deviations; a stop that is farther off was missed first, and teaches no more than this.
constexpr double kFarthest = 3.0;
constexpr double kLeastSpread = 0.05;  // s
/// Stops that what is set counts for: the first ones teach more than later ones.
constexpr int kBefore = 1;
/// Standard deviation over the mean deviation, where errors are normal.
constexpr double kNormal = 1.25;
constexpr double kMuch = 20.0 * kDegree;
/// Turns that leave much; one that leaves little makes up for one of them.
constexpr int kTooMany = 3;
constexpr int kLongestTrial = 32;

}  // namespace

void TurnLearning::stopped(double took) {
  if (!learns_) return;
  took = std::clamp(took, 0.0, kSlowest);
  const double farthest = kFarthest * std::max(kLeastSpread, learnt_.stopping_spread);
  const double off = std::clamp(took - learnt_.stopping_delay, -farthest, farthest);
  learnt_.stopping_delay += std::max(kStopWeight, 1.0 / (kBefore + ++stops_)) * off;
  learnt_.stopping_spread += kStopWeight * (kNormal * std::abs(off) - learnt_.stopping_spread);
}

void TurnLearning::led_by_sounds(double error) {
  // The first turns count alike, later ones the less the older they are.
  learnt_.turn_error += std::max(kWeight, 1.0 / ++turns_) * (error - learnt_.turn_error);
  if (!learns_) return;
  bad_ = std::max(0, bad_ + (error > kMuch ? 1 : -1));
  if (bad_ < kTooMany) return;
  learnt_.words_lead = true;
  by_words_ = 0;
}

void TurnLearning::turned(bool away) {
  if (!learns_) return;
  away_ = std::max(0, away_ + (away ? 1 : -1));
  if (away_ >= kTooMany) found_sides_wrong();
}

void TurnLearning::found_sides_wrong() { learnt_.words_lead = learnt_.sides_wrong = true; }

void TurnLearning::led_by_words(double error) {
  if (!learnt_.words_lead || learnt_.sides_wrong) return;
  by_words_ = error > kMuch ? 0 : by_words_ + 1;
  if (by_words_ < trial_) return;
  // Sounds are tried again; if that fails, not so soon the next time.
  learnt_.words_lead = false;
  bad_ = kTooMany - 1;
  trial_ = std::min(2 * trial_, kLongestTrial);
}

}  // namespace navvi_feedback::sounds
