#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "cues/route_cues.hpp"

namespace navvi_feedback::cues {

constexpr double kTick = 0.02;

inline double rad(double degrees) { return degrees * kDegree; }

inline Guidance following(double degrees, double distance) {
  Guidance guidance;
  guidance.state = Guidance::State::following;
  guidance.goal = {20.0, 5.0};
  guidance.waypoint = {10.0, 0.0};
  guidance.waypoint_angle = guidance.steer_angle = rad(degrees);
  guidance.waypoint_distance = distance;
  guidance.turn_angle = rad(90.0);
  guidance.goal_distance = 25.0;
  return guidance;
}

/// A drive as it is told: what was said at which second.
class Drive {
 public:
  explicit Drive(const RouteConfig& config = {}) : cues(config) { now.measured.emplace(); }

  /// Lets `seconds` pass in this situation and returns what was said.
  std::vector<Content> pass(double seconds) {
    std::vector<Content> told;
    for (const double end = time + seconds; time < end - 1e-9; time += kTick) {
      for (const Utterance& utterance : cues.update(now, false, time)) {
        told.emplace_back(utterance);
        last = utterance;
      }
    }
    return told;
  }

  /// The way lies so far to the right.
  void face(double degrees) {
    now.guidance->waypoint_angle = now.guidance->steer_angle = rad(degrees);
  }
  void lead_to(double x, double y) { now.guidance->waypoint = {x, y}; }

  /// After the introduction and the first direction, so that only news is said.
  void settle(double degrees, double distance) {
    now.guidance = following(degrees, distance);
    now.commanded.linear = 1.0;
    now.measured->linear = 1.0;
    pass(3.0);
  }

  /// Of a person who was told to stop.
  Utterances go_on() {
    EXPECT_TRUE(cues.update(now, true, time += kTick).empty());
    return cues.go_on(now, time);
  }

  RouteCues cues;
  Observation now;
  Utterance last;
  double time = 100.0;
};

using Kinds = std::vector<Content>;

}  // namespace navvi_feedback::cues
