#pragma once

#include <optional>
#include <string>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_feedback/clock_face.hpp"
#include "navvi_feedback/phrases.hpp"
#include "navvi_feedback/situation.hpp"

namespace navvi_feedback {

struct RouteConfig {
  std::string rounding = "nearest";
  double hysteresis_degrees = 5.0;
  double turn_ahead = 6.0;        ///< m
  double turn_now = 2.0;          ///< m
  double same_turn = 5.0;         ///< s
  double same_corner = 1.0;       ///< m
  double repeat_direction = 4.0;  ///< s
  double repeat_straight = 8.0;   ///< s
  double pause = 1.5;             ///< s
  double turning_rate = 0.25;     ///< rad/s
  double settle = 0.3;            ///< s
  double straight_lead = 0.5;     ///< s
  double idle = 5.0;              ///< s

  void describe(navvi_config::Visitor& visit);
};

/// Says where to drive while there is a path (R-AUD-1, R-AUD-2), so that a person who only hears
/// can follow it. All hours are seen from the robot's nose to the next way-point. While the robot
/// turns nothing is said but "straight ahead", early enough to stop the turn by; once it has
/// settled, the hour that is left.
class RouteCues {
 public:
  explicit RouteCues(const RouteConfig& config);

  /// Call it while the guidance is fresh and follows a path. \param time  s, monotonic
  [[nodiscard]] std::vector<Utterance> update(const Situation& now, double time);

  /// The direction as of now, for a person who asks.
  [[nodiscard]] std::optional<Utterance> direction(const Guidance& guidance) const;
  /// Distance and, if it is known, hour of the goal. \param kind  "start" or "goal_info"
  [[nodiscard]] Utterance goal(const std::string& kind, const Situation& now) const;

  /// The path is gone: when there is one again, say where it leads.
  void pause();
  /// Something else was said that makes a person stop: say the direction again soon.
  void remind(double time);

 private:
  enum class Change { none, new_goal, next_corner, reroute };

  [[nodiscard]] Change compare(const Guidance& guidance) const;
  void observe(const Situation& now, double time);
  [[nodiscard]] bool turning(double time) const;
  [[nodiscard]] bool about_to_face(const Situation& now) const;
  [[nodiscard]] bool turn_ahead_due(const Guidance& guidance, double time) const;
  [[nodiscard]] bool direction_due(double time) const;
  Utterance spoken(Utterance utterance, std::optional<int> hour, double time);

  RouteConfig config_;
  Rounding rounding_;
  SteadyHour steady_;
  std::optional<Guidance> last_;    ///< of the path that is being followed
  std::optional<int> hour_;         ///< to the way-point, now
  std::optional<int> said_hour_;    ///< what the person last heard
  Change pending_ = Change::none;   ///< still to be told
  std::optional<int> turn_said_;    ///< hour of the last turn_ahead
  bool ahead_told_ = false;         ///< this corner's turn_ahead was said
  double said_time_ = 0.0;          ///< s, of the last direction
  double turn_said_time_ = 0.0;     ///< s
  double last_turning_ = 0.0;       ///< s, when the robot last turned
  double last_commanded_ = 0.0;     ///< s, when the person last moved the stick
  std::optional<double> reminder_;  ///< s, say the direction again from then on
};

}  // namespace navvi_feedback
