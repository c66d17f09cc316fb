#pragma once

#include <vector>

#include "cues/answers.hpp"
#include "cues/collision_cues.hpp"
#include "cues/cue_config.hpp"
#include "cues/halt.hpp"
#include "cues/held_stick.hpp"
#include "cues/link_cues.hpp"
#include "cues/near_cues.hpp"
#include "cues/notice_cues.hpp"
#include "cues/order.hpp"
#include "cues/phrases.hpp"
#include "cues/phrasing.hpp"
#include "cues/route_cues.hpp"
#include "cues/state_cues.hpp"
#include "cues/stuck.hpp"
#include "cues/tick.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Decides what is said, and when. Pure: the same observations at the same times give the same
/// cues.
class CuePolicy {
 public:
  CuePolicy(const CuePolicyConfig& config, Phrases phrases);

  /// \param time  s, of a monotonic wall clock, so that a paused simulation is noticed
  /// \return the cues decided now, most urgent first
  [[nodiscard]] std::vector<Cue> update(const Observation& now, const Asked& asked, double time);

  void use(const WordingConfig& wording) { phrasing_.use(wording); }

  /// What the person is to do now; in few words where that is the way, as they stand on a plate.
  /// \return nullopt: nothing
  [[nodiscard]] std::optional<Cue> order() const;
  /// The person is to follow the path now.
  [[nodiscard]] bool leads() const { return leads_ && !order_.stopped(); }
  /// And it leads off something near, so that a small turn counts.
  [[nodiscard]] bool leads_off() const { return leads() && route_.leads_off(); }

  /// Takes note of what became of the cues: one that was dropped may be said again at once.
  void note(const std::vector<CueEvent>& events);

 private:
  [[nodiscard]] Tick look(const Observation& now, const Asked& asked, double time);
  [[nodiscard]] Utterances release(const Tick& tick, const Utterances& told);
  [[nodiscard]] Utterances near(const Tick& tick);
  void remind(const Tick& tick, const Utterances& told);
  bool halt(const Utterances& told, const Tick& tick);
  [[nodiscard]] Utterances way(const Tick& tick);
  [[nodiscard]] std::vector<Cue> say(const Utterances& told, const Tick& tick);
  void lost(const CueEvent& event);

  CuePolicyConfig config_;
  LinkCues links_;
  NoticeCues notices_;
  CollisionCues collisions_;
  HeldStick held_;
  Stuck stuck_;
  StateCues state_;
  NearCues near_;
  Answers answers_;
  Halt halt_;
  RouteCues route_;
  Phrasing phrasing_;
  Order order_;
  bool leads_ = false;  ///< there is a path, and no word against following it
  double time_ = 0.0;   ///< s, of the last update
};

}  // namespace navvi_feedback::cues
