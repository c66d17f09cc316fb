#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "cues/near_cues.hpp"

namespace navvi_feedback::cues {

inline NearThing shelf(double gap, const Eigen::Vector2d& nearest) {
  return {ThingClass::shelf, 7, gap, nearest, false};
}

inline const Eigen::Vector2d kLeft(0.1, 1.3);
inline const Eigen::Vector2d kRight(0.1, -1.3);
inline const Eigen::Vector2d kAhead(1.3, 0.1);
inline const Eigen::Vector2d kBehind(-1.3, 0.1);

class NearCuesTest : public testing::Test {
 protected:
  NearCuesTest() { now_.measured.emplace(); }

  /// The sides said within `seconds` of a situation, in order.
  std::vector<Side> pass(double seconds, const std::vector<NearThing>& nearby) {
    now_.nearby = nearby;
    std::vector<Side> sides;
    for (const double end = time_ + seconds; time_ < end - 1e-9; time_ += 0.02) {
      for (const Utterance& utterance : cues_.update(now_, true, {}, time_)) {
        sides.push_back(*utterance.fillings.side);
        last_ = utterance;
      }
    }
    return sides;
  }

  NearCues cues_{NearConfig{}};
  Observation now_;
  Utterance last_;
  double time_ = 10.0;
};

using Sides = std::vector<Side>;

}  // namespace navvi_feedback::cues
