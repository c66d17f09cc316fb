#include "batch/turn_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <navvi_types/angles.hpp>

namespace navvi_study::batch {
namespace {

constexpr double kTurns = 0.15;   // rad/s; slower does not begin a turn
constexpr double kStands = 0.1;   // rad/s
constexpr double kSettled = 0.3;  // s
constexpr double kRadius = 0.5;   // m; a wider one is no turn on the spot
constexpr double kLeast = navvi_types::radians(15.0);
constexpr double kActs = 5.0;  // s; what is done later is not for that cue

/// \param share  [0, 1] of the values that are not above it
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace

void TurnFigures::ask(double time) {
  if (!turns_ && !asked_) asked_ = time;
}

void TurnFigures::watch(double rate, double forward, std::optional<double> off, double time) {
  const double dt = time - time_;
  time_ = time;
  const bool spot = std::abs(forward) <= kRadius * std::abs(rate);
  if (!turns_ && std::abs(rate) > kTurns && spot) {
    turns_ = true;
    turned_ = 0.0;
    if (asked_ && time - *asked_ < kActs) late_.push_back(time - *asked_);
    asked_.reset();
  }
  if (asked_ && time - *asked_ >= kActs) asked_.reset();
  if (!turns_) return;
  turned_ += rate * dt;
  if (std::abs(rate) > kStands) still_since_.reset();
  if (std::abs(rate) <= kStands && !still_since_) still_since_ = time;
  if (!still_since_ || time - *still_since_ < kSettled) return;
  turns_ = false;
  still_since_.reset();
  if (off && std::abs(turned_) > kLeast) left_.push_back(std::abs(*off));
}

void TurnFigures::add_to(record::Fields& row) const {
  row.set("led_turns", std::uint64_t{left_.size()});
  row.set("residual", navvi_types::degrees(quantile(left_, 0.5)), 1);
  row.set("residual_90", navvi_types::degrees(quantile(left_, 0.9)), 1);
  row.set("cue_to_action", quantile(late_, 0.5), 2);
}

}  // namespace navvi_study::batch
