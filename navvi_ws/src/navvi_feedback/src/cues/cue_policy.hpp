#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "cues/cue_config.hpp"
#include "cues/halt.hpp"
#include "cues/held_stick.hpp"
#include "cues/near_cues.hpp"
#include "cues/phrasing.hpp"
#include "cues/route_cues.hpp"
#include "cues/situation.hpp"
#include "cues/stuck.hpp"

namespace navvi_feedback::cues {

/// Decides what is said, and when. Pure: the same situations at the same times give the same cues.
class CuePolicy {
 public:
  CuePolicy(const CuePolicyConfig& config, Phrases phrases);

  /// \param time  s, of a monotonic wall clock, so that a paused simulation is noticed
  /// \return the cues decided now, most urgent first
  [[nodiscard]] std::vector<Cue> update(const Situation& now, double time);

  /// From now on.
  void use(const WordingConfig& wording) { phrasing_.use(wording); }

  /// The person is to follow the path now.
  [[nodiscard]] bool leads() const { return leads_; }
  /// And it leads off something near, so that a small turn counts.
  [[nodiscard]] bool leads_off() const { return leads_ && route_.leads_off(); }

  /// Takes note of what became of the cues: one that was dropped may be said again at once.
  void note(const std::vector<CueEvent>& events);

 private:
  [[nodiscard]] Links judge(const Situation& now, double time);
  [[nodiscard]] Utterances lost_and_found(const Situation& now, const Links& links, double time);
  [[nodiscard]] Utterances collisions(const Situation& now, double time);
  [[nodiscard]] Utterances release(const Situation& now, const Links& links, double time);
  [[nodiscard]] Utterances guidance_state(const Situation& now, const Links& links, double time);
  [[nodiscard]] Utterance tell_problem(CueKind kind, const Situation& now) const;
  void halt(const Utterances& told, const Utterances& answer, double time);
  [[nodiscard]] Utterances near(const Situation& now, double time);
  [[nodiscard]] Utterances route(const Situation& now, const Links& links, double time);
  [[nodiscard]] Utterance where_am_i(const Situation& now) const;
  [[nodiscard]] Utterances answers(const Situation& now, double time);
  void forget(const CueEvent& event);

  CuePolicyConfig config_;
  Phrasing phrasing_;
  RouteCues route_;
  NearCues near_;
  HeldStick held_;
  Stuck stuck_;
  Halt halt_;

  std::optional<double> first_update_;  ///< s
  double sensed_ = 0.0;                 ///< s, when proximity was last not lost
  double time_ = 0.0;                   ///< s, of the last update
  Links links_;                         ///< as of the last update
  std::optional<DriveState::State> gate_;
  bool awaited_ = false;            ///< a trial waits for the person
  bool follows_ = false;            ///< there is a fresh path now
  bool leads_ = false;              ///< and no word against following it
  std::optional<CueKind> problem_;  ///< why the guidance does not lead
  Eigen::Vector2d problem_goal_ = Eigen::Vector2d::Zero();
  double problem_since_ = 0.0;          ///< s
  std::optional<double> problem_said_;  ///< s
  bool arrival_said_ = false;
  bool led_ = false;                     ///< there was a path to follow
  std::optional<Question> asked_;        ///< the last that was answered
  std::optional<CueKind> answered_;      ///< the kind of that
  std::optional<Question> question_;     ///< to be answered anew
  std::map<std::uint32_t, double> hit_;  ///< s, by thing
  std::set<CueKind> noticed_;
  std::optional<double> trial_over_;  ///< s, when that was said
};

}  // namespace navvi_feedback::cues
