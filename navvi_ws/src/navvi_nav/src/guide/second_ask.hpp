#pragma once

#include <navvi_types/guidance.hpp>
#include <optional>

#include "geometry.hpp"

namespace navvi_nav::guide {

using navvi_types::Guidance;

/// Whether a person has asked a second time for a goal that was refused because the map does not
/// show it yet: then they are led toward it. Only a message with a newer stamp is a person's word:
/// who sends a goal again, as trial_node does, keeps its stamp, and a goal that nobody chose has 0.
/// Times and stamps are s of ROS time.
class SecondAsk {
 public:
  /// A goal is set. \returns true if it is to be led toward: it lies within 0.5 m of the one that
  /// was refused and is stamped later, or it is one for which that was so, sent again
  [[nodiscard]] bool agrees(Point goal, double stamp);
  /// A goal was refused: once more if the person had agreed to it.
  /// \param heard  the later one of its stamp and the time of the refusal
  void refused(Point goal, Guidance::Refusal why, double heard);
  void reset();

 private:
  struct Goal {
    Point place;
    double stamp = 0.0;
  };
  std::optional<Goal> refused_;  ///< stamp: that a second ask must be later than
  std::optional<Goal> agreed_;
};

}  // namespace navvi_nav::guide
