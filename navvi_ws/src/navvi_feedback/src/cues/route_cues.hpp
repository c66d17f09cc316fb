#pragma once

#include <optional>

#include "cues/bearing.hpp"
#include "cues/leg.hpp"
#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// It tells that there is another route, which explains the next direction.
[[nodiscard]] constexpr bool tells_route(CueKind kind) {
  return kind == CueKind::rerouted || kind == CueKind::new_route;
}
/// It tells whether the map shows the goal.
[[nodiscard]] constexpr bool tells_sight(CueKind kind) {
  return kind == CueKind::toward_goal || kind == CueKind::goal_seen;
}
/// What was cut off is said again.
[[nodiscard]] constexpr bool is_owed(CueKind kind) {
  return tells_route(kind) || tells_sight(kind);
}

struct Look;

/// Says where to drive while there is a path (R-AUD-1, R-AUD-2), so that a person who only hears
/// can follow it. All hours are seen from the robot's nose to where to steer. What the person knows
/// is a Leg; which of its news is said, and when, decides one of two strategies: words_lead(), or
/// sounds_lead() where a sound leads to where to steer.
class RouteCues {
 public:
  explicit RouteCues(const RouteConfig& config) : config_(config), bearing_(config) {}

  /// Call it while the guidance is fresh and leads along a path.
  /// \param halted  the person was told to stop: nothing is said until they may go on
  /// \param time  s, monotonic
  [[nodiscard]] Utterances update(const Observation& now, bool halted, double time);

  /// The way as of now, with what has changed meanwhile, for a person who was told to stop and may
  /// go on; none if it is not known. Call it after update().
  [[nodiscard]] Utterances go_on(const Observation& now, double time);

  /// The direction as of now, for a person who asks; it need not be said again by itself.
  [[nodiscard]] std::optional<Utterance> ask(const Guidance& guidance, double time);

  /// Where to drive now: aside, to where to steer, or, facing that, round the next corner.
  /// \return nullopt: it is not known
  [[nodiscard]] std::optional<Utterance> order(const Guidance& guidance) const;

  /// The path is gone: when there is one again, say where it leads.
  /// \param goal_gone  the goal, too: the next one is introduced
  void pause(bool goal_gone);
  void note(CueKind kind, CueStage stage);
  void lost(CueKind kind, double time);
  /// Something else was said that makes a person stop: say the direction again from `time` on.
  void remind(double time) { leg_.reminder = time; }

  /// Straight ahead would lead into something near, or along it.
  [[nodiscard]] bool leads_off() const { return bearing_.leads_off(); }
  [[nodiscard]] Rounding rounding() const { return bearing_.rounding(); }

 private:
  /// That the map does not show the goal yet.
  struct Unseen {
    bool told = false;    ///< it was decided last, and not that it does
    bool heard = false;   ///< likewise, what the voice has begun
    bool before = false;  ///< likewise, before that
    double time = -1e9;   ///< s, when either was decided
  };

  [[nodiscard]] Utterances introduce_goal(const Look& look);
  [[nodiscard]] Utterances sight_of_goal(const Observation& now, double time);
  [[nodiscard]] bool is_new_goal(const Guidance& guidance) const;

  RouteConfig config_;
  Bearing bearing_;
  Leg leg_;
  std::optional<Eigen::Vector2d> goal_;  ///< m, in map, the one that was introduced
  Unseen unseen_;
  bool by_sound_ = false;  ///< a sound led at the last look
};

}  // namespace navvi_feedback::cues
