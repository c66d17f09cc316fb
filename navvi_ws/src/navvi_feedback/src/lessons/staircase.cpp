#include "lessons/staircase.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::lessons {
namespace {

constexpr double kWeakest = 0.01;
constexpr double kStrongest = 0.5;  // what haptics/start_left may be
constexpr double kCoarse = 2.0;     // factor
constexpr double kFine = 1.41;
constexpr std::size_t kCounted = 4;

}  // namespace

void Staircase::answer(bool felt) {
  if (last_ && *last_ != felt) turns_.push_back(strength_);
  last_ = felt;
  const double factor = turns_.empty() ? kCoarse : kFine;
  const double next =
      std::clamp(felt ? strength_ / factor : strength_ * factor, kWeakest, kStrongest);
  ends_ = next == strength_ ? ends_ + 1 : 0;
  strength_ = next;
}

std::optional<double> Staircase::threshold() const {
  if (turns_.size() < 6) return last_ == true ? std::optional(strength_) : std::nullopt;
  double sum = 0.0;
  for (std::size_t i = turns_.size() - kCounted; i < turns_.size(); ++i) sum += std::log(turns_[i]);
  return std::exp(sum / kCounted);
}

}  // namespace navvi_feedback::lessons
