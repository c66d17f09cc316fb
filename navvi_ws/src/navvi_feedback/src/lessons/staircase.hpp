#pragma once

#include <optional>
#include <vector>

namespace navvi_feedback::lessons {

/// Finds the weakest strength that is felt: weaker after each that was, stronger after each that
/// was not, in steps that are halved after the first turn (in the logarithm of the strength). The
/// threshold is the mean of the last turns.
class Staircase {
 public:
  /// [0, 1], to be given next
  [[nodiscard]] double strength() const { return strength_; }
  void answer(bool felt);
  [[nodiscard]] bool done() const { return turns_.size() >= 6 || ends_ >= 2; }
  /// [0, 1]; nullopt if even the strongest was not felt
  [[nodiscard]] std::optional<double> threshold() const;

 private:
  double strength_ = 0.3;
  std::optional<bool> last_;
  std::vector<double> turns_;  ///< strengths at which the answer was another than before
  int ends_ = 0;               ///< in succession, at the weakest or strongest strength
};

}  // namespace navvi_feedback::lessons
