#pragma once

#include <cstdint>
#include <map>
#include <navvi_people/loop/closed_loop.hpp>
#include <navvi_people/people/instruction.hpp>
#include <optional>
#include <string>
#include <vector>

#include "batch/direction_figures.hpp"
#include "batch/sensing_figures.hpp"
#include "batch/speech_figures.hpp"
#include "batch/stand_figures.hpp"
#include "batch/turn_figures.hpp"
#include "batch/warning_figures.hpp"
#include "trial/trial_monitor.hpp"

namespace navvi_study::batch {

using navvi_people::loop::ClosedLoop;
namespace people = navvi_people::people;

/// Judges the trial of a closed loop: whether and when its goal was reached, and how good the
/// guidance was on the way. What trials count, it counts as they do (TrialMonitor).
class LoopFigures {
 public:
  /// \param limit  s after the goal was set
  explicit LoopFigures(double limit) : limit_(limit), monitor_(trial::TrialMonitorConfig()) {}

  /// Call it after every step of `loop`. \return whether the trial goes on
  [[nodiscard]] bool watch(const ClosedLoop& loop);

  /// One row. `time` s since the goal was set; `driven` and `shortest` m; `hits` by class; the
  /// states of the guidance in s; `hash` of the world's last state; `least_gap` m, to anything;
  /// `motors`, the share of the time in which one turns; and what the parts add.
  [[nodiscard]] record::Fields row(const ClosedLoop& loop) const;

 private:
  /// What is about, for a person who stands.
  struct About {
    Guidance::State state = Guidance::State::no_goal;
    std::string blocked_by;
    std::string spoken;
    std::string nearest;

    [[nodiscard]] std::string text() const;
  };

  void begin(const ClosedLoop& loop);
  void feel(const navvi_msgs::Proximity& near);
  void take(const navvi_msgs::Guidance& guidance);
  void judge_turns(const ClosedLoop& loop);

  double limit_;
  trial::TrialMonitor monitor_;
  SpeechFigures speech_;
  SensingFigures sensing_;
  TurnFigures turns_made_;
  DirectionFigures directions_;
  WarningFigures warnings_;
  StandFigures stands_;
  std::optional<double> begun_;  ///< s
  double time_ = 0.0;            ///< s since then
  std::string result_ = "timeout";
  std::map<std::string, std::uint64_t> hits_;
  unsigned reroutes_ = 0;
  double shortest_ = 0.0;
  double asked_ = -1e9;  ///< s, when the person last asked
  std::map<std::string, double> states_;
  std::optional<double> course_;  ///< rad, in map, to where to steer while there is a way
  double least_gap_ = 1e9;        ///< m
  double felt_for_ = 0.0;         ///< s
  About about_;
};

}  // namespace navvi_study::batch
