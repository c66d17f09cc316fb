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

  Texts ask(Button question, double seconds = 0.1) {
    asked_.question = question;
    return pass(seconds);
  }

  void drive(double speed) { now_.commanded.linear = now_.measured->linear = speed; }
  /// Drives ahead until only news is said.
  void under_way() {
    drive(1.0);
    pass(3.0);
  }
  void stand() {
    now_.commanded = {};
    now_.measured = Velocity{};
  }

  void block(ThingClass by = ThingClass::worker) {
    now_.guidance->state = Guidance::State::blocked;
    now_.guidance->blocked_by = by;
  }
  void follow() { now_.guidance->state = Guidance::State::following; }
  void lead_to(double x, double y, double angle, double distance) {
    now_.guidance->waypoint = {x, y};
    now_.guidance->waypoint_angle = now_.guidance->steer_angle = angle;
    now_.guidance->waypoint_distance = distance;
  }

  /// What became of the words that were told last.
  void note(std::uint32_t id, const std::vector<CueStage>& stages) {
    for (const CueStage stage : stages)
      policy_.note({{id, stage, Content(last_), last_.text, last_.priority}});
  }

  CuePolicy policy_{CuePolicyConfig{}, Phrases(kEnglish)};
  Observation now_;
  Asked asked_;
  Cue last_;
  double time_ = 50.0;
};

const std::vector<CueStage> kHeard = {CueStage::queued, CueStage::started, CueStage::ended};
const std::vector<CueStage> kDropped = {CueStage::queued, CueStage::dropped};

}  // namespace navvi_feedback::cues
