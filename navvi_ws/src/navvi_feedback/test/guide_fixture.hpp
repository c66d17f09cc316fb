#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "beat.hpp"

namespace navvi_feedback::core {

/// A guide, and a person with the hands on a stick.
class GuideTest : public testing::Test {
 protected:
  GuideTest() {
    input_.hands.live = true;
    hold(0.0, 0.0);
  }

  void hold(double left, double forward) {
    input_.hands.axes = {left, forward};
    input_.hands.buttons = {false, false};
  }

  /// \return the last output
  Beat pass(double seconds) {
    Beat output;
    for (const double end = time_ + seconds; time_ < end - 1e-9; time_ += 0.02) {
      output = beat(guide_, input_, time_);
      for (const cues::Cue& cue : output.cues) told_.emplace_back(cue);
      plays_.insert(plays_.end(), output.plays.begin(), output.plays.end());
    }
    return output;
  }

  /// A function is asked for, by whatever means.
  Beat ask(const std::vector<drive::Button>& functions) {
    input_.asked = functions;
    const Beat output = pass(0.02);
    input_.asked.clear();
    return output;
  }
  /// A button of the pad goes down and up again. \return what came of it at once
  Beat press(std::size_t button) {
    input_.hands.buttons.assign(15, false);
    pass(0.1);
    input_.hands.buttons[button] = true;
    const Beat output = pass(0.02);
    input_.hands.buttons[button] = false;
    return output;
  }

  /// A path that leads to the right; a shelf that is near. \param y  m, to its left
  void lead(double y) {
    Guidance guidance;
    guidance.state = Guidance::State::following;
    guidance.goal = {20.0, 5.0};
    guidance.steer_angle = guidance.waypoint_angle = 1.5;
    guidance.waypoint_distance = 8.0;
    guidance.goal_distance = 25.0;
    guide_.take(guidance, time_);
    guide_.take(Odometry{}, time_);
    guide_.take(Proximity{0, {{ThingClass::shelf, 1, 0.5, {0.0, y}}}}, time_);
  }
  /// \param times  0.5 s each
  void drive_along(double y, int times) {
    for (int i = 0; i < times; ++i) {
      lead(y);
      pass(0.5);
    }
  }

  /// How often it was told.
  [[nodiscard]] auto count(const Content& content) const {
    return std::count(told_.begin(), told_.end(), content);
  }
  [[nodiscard]] bool said(const Content& content) const { return count(content) > 0; }
  [[nodiscard]] auto played(sounds::Earcon earcon) const {
    return std::count_if(plays_.begin(), plays_.end(),
                         [&](const sounds::Play& play) { return play.earcon == earcon; });
  }

  Guide guide_{GuideConfig{}, cues::Phrases(kEnglish)};
  Devices input_;
  double time_ = 10.0;
  std::vector<Content> told_;
  std::vector<sounds::Play> plays_;
};

}  // namespace navvi_feedback::core
