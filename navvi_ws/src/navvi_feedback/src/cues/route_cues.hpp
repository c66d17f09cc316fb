#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cues/clock_face.hpp"
#include "cues/cue_config.hpp"
#include "cues/phrases.hpp"
#include "cues/situation.hpp"

namespace navvi_feedback::cues {

/// Says where to drive while there is a path (R-AUD-1, R-AUD-2), so that a person who only hears
/// can follow it. All hours are seen from the robot's nose to where to steer. While the robot
/// turns nothing is said but "straight ahead", early enough to stop a turn of more than one hour
/// by; once it has settled, the hour that is left. Where a sound leads to where to steer, words are
/// for what it cannot tell: each leg once, and turns of more than one hour.
class RouteCues {
 public:
  explicit RouteCues(const RouteConfig& config);

  /// Call it while the guidance is fresh and leads along a path.
  /// \param halted  the person was told to stop: nothing is said until they may go on
  /// \param time  s, monotonic
  [[nodiscard]] std::vector<Utterance> update(const Situation& now, bool halted, double time);

  /// The way as of now, with what has changed meanwhile, for a person who was told to stop and may
  /// go on. Call it after update(). \return nullopt: no direction is known
  [[nodiscard]] std::optional<Utterance> go_on(const Situation& now, double time);

  /// The direction as of now, for a person who asks.
  [[nodiscard]] std::optional<Utterance> ask(const Guidance& guidance, double time);
  [[nodiscard]] int hour_of(double angle) const {
    return clock_hour(angle, rounding_).value_or(12);
  }
  /// Where the next turn is, and where it leads.
  [[nodiscard]] Utterance next_turn(const Guidance& guidance) const;
  /// Distance and, if it is known, hour of the goal. \param without_hour  the kind if it is not
  [[nodiscard]] Utterance goal(CueKind kind, CueKind without_hour, const Situation& now) const;

  /// The path is gone: when there is one again, say where it leads.
  void pause();
  /// The goal is gone too: the next one is introduced.
  void forget();
  /// The way is said anew, as it is then.
  void unsaid();
  /// Likewise, for what was said of it last was not heard.
  void unheard();
  /// That the route is new was not heard.
  void route_unheard();

  /// Straight ahead would lead into something near, or along it.
  [[nodiscard]] bool leads_off() const { return leads_off_; }
  /// Something else was said that makes a person stop: say the direction again soon.
  void remind(double time);

 private:
  enum class Change { none, next_corner, reroute };

  [[nodiscard]] bool new_goal(const Guidance& guidance) const;
  [[nodiscard]] bool closed_way(const Guidance& guidance) const;
  [[nodiscard]] Change compare(const Guidance& guidance) const;
  void observe(const Situation& now, bool halted, double time);
  [[nodiscard]] std::optional<Utterance> direction(const Guidance& guidance) const;
  [[nodiscard]] std::optional<int> turn_within_reach(const Guidance& guidance) const;
  [[nodiscard]] int clear_of_things(const Situation& now, bool held) const;
  [[nodiscard]] bool about_to_face(const Situation& now) const;
  [[nodiscard]] bool passes_within_reach(const Guidance& guidance) const;
  [[nodiscard]] bool at_hand(const Guidance& guidance, double time) const;
  [[nodiscard]] bool worth_words(int hour) const;
  [[nodiscard]] bool comes_ahead(const Situation& now) const;
  [[nodiscard]] bool quiet(const Situation& now, double time) const;
  [[nodiscard]] bool turn_ahead_due(const Guidance& guidance, int turn, double time) const;
  [[nodiscard]] bool direction_due(const Situation& now, double time) const;
  [[nodiscard]] std::vector<Utterance> tell(const Situation& now, double time);
  [[nodiscard]] Utterance announce_turn(CueKind kind, Utterance way, int turn, double time);
  [[nodiscard]] std::optional<Utterance> stray(const Situation& now, double time);
  Utterance said(Utterance utterance, int hour, double time);

  RouteConfig config_;
  Rounding rounding_;
  SteadyHour steady_;
  bool by_sound_ = false;                ///< a sound leads to where to steer
  std::optional<Eigen::Vector2d> goal_;  ///< m, in map, the one that was introduced
  std::optional<Guidance> last_;         ///< of the path that is being followed
  std::optional<int> hour_;              ///< to the way-point, now
  bool leads_off_ = false;               ///< it is no 12 only for what is near
  std::optional<int> said_hour_;         ///< what the person last heard
  Change pending_ = Change::none;        ///< not said yet
  std::uint32_t reroutes_ = 0;           ///< of this goal, whose way was told
  std::uint32_t reroutes_before_ = 0;    ///< the last words of the way
  bool made_room_ = false;               ///< the thing to make room for was named
  bool ahead_told_ = false;              ///< this corner's turn_ahead was said
  bool turn_announced_ = false;          ///< that of the corner that was reached last
  bool fell_away_ = false;               ///< a turn that was announced is no longer to be made
  std::optional<int> turn_said_;         ///< hour of the last turn_ahead
  double turn_said_time_ = 0.0;          ///< s
  double said_time_ = 0.0;               ///< s, of the last direction
  double said_angle_ = 0.0;              ///< rad, where to steer, then
  bool turning_ = false;                 ///< on the spot, or not yet settled
  std::optional<double> last_turning_;   ///< s
  double last_commanded_ = 0.0;          ///< s, when the person last moved the stick
  std::optional<CueKind> astray_;        ///< the wrong way, or off the path
  double astray_since_ = 0.0;            ///< s
  std::optional<double> astray_said_;    ///< s
  std::optional<double> reminder_;       ///< s, say the direction again from then on
};

}  // namespace navvi_feedback::cues
