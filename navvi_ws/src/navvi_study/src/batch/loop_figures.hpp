#pragma once

#include <cstdint>
#include <map>
#include <navvi_people/loop/closed_loop.hpp>
#include <navvi_people/people/instruction.hpp>
#include <optional>
#include <string>
#include <vector>

#include "batch/sensing_figures.hpp"
#include "batch/speech_figures.hpp"
#include "batch/turn_figures.hpp"
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

  /// One row. `time` s since the goal was set; `driven` and `shortest` m; `hits` by class;
  /// `turns` changes of the announced hour a minute; `flips` how often a direction contradicted the
  /// one just before; `reversed` how often it led 4 hours or more elsewhere than one within 4 s
  /// before, no corner and no new route being told; `misled` how often the turn that was ordered
  /// was not the one announced for that corner; `warned`: of each contact with what moves, the s
  /// before it since when that was felt, and since when it was told, and `late`, how many of them
  /// were felt < 3 s or told < 2 s before; `speechless` how often a stick was pushed in vain for 3
  /// s without a word or a sound; the states of the guidance in s; `still` s, the longest stay
  /// within 0.3 m, since `still_at` s, and `why`: what was about at its end; `hash` of the world's
  /// last state; `least_gap` m, to anything; `motors`, the share of the time in which one turns;
  /// and what SpeechFigures, TurnFigures and SensingFigures add.
  [[nodiscard]] record::Fields row(const ClosedLoop& loop) const;

 private:
  /// A direction that was spoken, and where.
  struct Said {
    int hour = 12;
    double course = 0.0;  ///< rad, in map
    double time = 0.0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
  };

  void begin(const ClosedLoop& loop);
  void feel(const navvi_msgs::Proximity& near, double time);
  void listen(const ClosedLoop& loop, const navvi_types::CueEvent& cue);
  void take(const navvi_msgs::Guidance& guidance);
  void stand(const ClosedLoop& loop);
  void judge_turns(const ClosedLoop& loop);
  void judge_warning(const navvi_msgs::Contact& contact, double time);
  void hear(const navvi_types::CueEvent& cue, double time);
  void push(const ClosedLoop& loop);
  [[nodiscard]] std::string about() const;

  double limit_;
  trial::TrialMonitor monitor_;
  SpeechFigures speech_;
  SensingFigures sensing_;
  TurnFigures turns_made_;
  std::optional<double> begun_;  ///< s
  double time_ = 0.0;            ///< s since then
  std::string result_ = "timeout";
  std::map<std::string, std::uint64_t> hits_;
  unsigned reroutes_ = 0;
  double shortest_ = 0.0;
  unsigned turns_ = 0;
  unsigned flips_ = 0;
  unsigned misled_ = 0;
  unsigned reversed_ = 0;
  unsigned late_ = 0;
  unsigned speechless_ = 0;
  std::string warned_;
  std::map<std::uint32_t, double> felt_;              ///< s, since when, by thing
  std::map<std::string, std::vector<double>> named_;  ///< s, each time, by class
  std::optional<double> pushed_;                      ///< s, since when in vain and in silence
  double asked_ = -1e9;                               ///< s, when the person last asked
  std::optional<Said> said_;
  std::optional<int> announced_;  ///< hour of the turn that comes
  double announced_until_ = 0.0;  ///< m driven, where its corner is passed
  std::map<std::string, double> states_;
  Guidance::State state_ = Guidance::State::no_goal;
  std::optional<double> course_;  ///< rad, in map, to where to steer while there is a way
  double least_gap_ = 1e9;        ///< m
  double felt_for_ = 0.0;         ///< s
  std::string blocked_by_;
  std::string spoken_;
  std::string nearest_;
  Eigen::Vector2d stay_ = Eigen::Vector2d::Zero();
  double stay_since_ = 0.0;
  double still_ = 0.0;
  double still_at_ = 0.0;
  std::string why_;
};

}  // namespace navvi_study::batch
