#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "navvi_feedback/cues/held_stick.hpp"
#include "navvi_feedback/cues/near_cues.hpp"
#include "navvi_feedback/cues/phrases.hpp"
#include "navvi_feedback/cues/route_cues.hpp"
#include "navvi_feedback/cues/situation.hpp"

namespace navvi_feedback::cues {

struct CuePolicyConfig {
  double stuck_time = 1.5;       ///< s
  double stuck_linear = 0.05;    ///< m/s
  double stuck_angular = 0.1;    ///< rad/s
  double stuck_repeat = 5.0;     ///< s
  double blocker_gap = 0.5;      ///< m
  double state_hold = 0.5;       ///< s
  double problem_repeat = 15.0;  ///< s
  double patience = 10.0;        ///< s
  std::string direction_words = "clock";
  RouteConfig route;
  NearConfig near;

  void describe(navvi_config::Visitor& visit);
  /// direction_words as Phrases takes it.
  [[nodiscard]] DirectionWords words() const;
};

/// Decides what is said, and when. Pure: the same situations at the same times give the same cues.
class CuePolicy {
 public:
  CuePolicy(const CuePolicyConfig& config, Phrases phrases);

  /// \param time  s, of a monotonic wall clock, so that a paused simulation is noticed
  /// \return the cues decided now, most urgent first
  [[nodiscard]] std::vector<Cue> update(const Situation& now, double time);

  /// Takes note of what became of the cues: one that was dropped may be said again at once.
  void note(const std::vector<CueEvent>& events);

 private:
  using Utterances = std::vector<Utterance>;
  struct Links {
    Link pad = Link::never;
    Link simulator = Link::never;
    Link proximity = Link::never;
    Link guidance = Link::never;
    Link audio = Link::never;
  };

  [[nodiscard]] Links judge(const Situation& now, double time);
  [[nodiscard]] Utterances lost_and_found(const Situation& now, const Links& links, double time);
  [[nodiscard]] Utterances collisions(const Situation& now, double time);
  [[nodiscard]] Utterances stuck(const Situation& now, double time);
  [[nodiscard]] Utterances release(const Situation& now, const Links& links, double time);
  [[nodiscard]] Utterances guidance_state(const Situation& now, const Links& links, double time);
  [[nodiscard]] Utterance tell_problem(const Situation& now) const;
  [[nodiscard]] Utterances near(const Situation& now, double time);
  [[nodiscard]] Utterances route(const Situation& now, const Links& links, double time);
  [[nodiscard]] Utterances answers(const Situation& now, double time);
  [[nodiscard]] std::vector<Cue> phrase(const Utterances& utterances, double time);

  CuePolicyConfig config_;
  Phrases phrases_;
  RouteCues route_;
  NearCues near_;
  HeldStick held_;

  std::optional<double> first_update_;  ///< s
  Links links_;                         ///< as of the last update
  std::optional<DriveState::State> gate_;
  bool follows_ = false;                 ///< there is a fresh path now
  std::optional<double> blocked_since_;  ///< s, commanded without moving
  std::optional<double> stuck_said_;     ///< s
  std::string problem_;                  ///< why the guidance does not lead, as a cue kind
  Eigen::Vector2d problem_goal_ = Eigen::Vector2d::Zero();
  double problem_since_ = 0.0;          ///< s
  std::optional<double> problem_said_;  ///< s
  bool arrival_said_ = false;
  std::map<std::string, double> last_said_;  ///< s, by kind
  std::map<std::uint32_t, double> hit_;      ///< s, by thing
  std::set<std::string> noticed_;
};

}  // namespace navvi_feedback::cues
