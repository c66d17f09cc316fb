#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cues/cue_policy.hpp"

namespace navvi_feedback::cues {

inline const std::string kEnglish = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml";

using Texts = std::vector<std::string>;

/// A policy, and a robot that follows a straight path to a goal 20 m ahead.
class CuePolicyTest : public testing::Test {
 protected:
  CuePolicyTest() {
    now_.links.pad = now_.links.simulator = Link::alive;
    now_.links.guidance = now_.links.proximity = now_.links.audio = Link::alive;
    now_.gate = DriveState::State::running;
    now_.measured.emplace();
    now_.guidance.emplace();
    now_.guidance->state = Guidance::State::following;
    now_.guidance->goal = {20.0, 0.0};
    now_.guidance->waypoint = {20.0, 0.0};
    now_.guidance->waypoint_is_goal = true;
    now_.guidance->waypoint_distance = now_.guidance->goal_distance = 20.0;
  }

  Texts pass(double seconds) {
    Texts texts;
    for (const double end = time_ + seconds; time_ < end - 1e-9; time_ += 0.02) {
      for (const Cue& cue : policy_.update(now_, asked_, time_)) {
        texts.push_back(cue.text);
        last_ = cue;
      }
      now_.contacts.clear();
      asked_ = {};
    }
    return texts;
  }

  /// Drives ahead until only news is said.
  void under_way() {
    now_.commanded.linear = now_.measured->linear = 1.0;
    pass(3.0);
  }

  CuePolicy policy_{CuePolicyConfig{}, Phrases(kEnglish)};
  Observation now_;
  Asked asked_;
  Cue last_;
  double time_ = 50.0;
};

}  // namespace navvi_feedback::cues
