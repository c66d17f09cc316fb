#pragma once

#include <cstdint>
#include <optional>

#include "cues/cue_config.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// How a robot that is led strays: it drives the wrong way, or beside the path.
/// \param now  with a guidance that leads
/// \param was  how it strayed at the last look, so that it takes less to be off the path still
/// \return wrong_way or off_path; nullopt: it does not
[[nodiscard]] std::optional<CueKind> straying(const Observation& now, std::optional<CueKind> was,
                                              const StrayConfig& config);

/// The robot drives on, and does not turn on the spot.
[[nodiscard]] bool drives_on(const Observation& now);

/// How long the robot has strayed, and when that was said.
struct Stray {
  std::optional<CueKind> kind;  ///< nullopt: it does not
  double since = 0.0;           ///< s
  std::optional<double> said;   ///< s

  /// Call it at each look. \param time  s, monotonic
  void observe(const Observation& now, const StrayConfig& config, double time);
  /// \return whether it is to be said now
  [[nodiscard]] bool due(const Observation& now, const StrayConfig& config, double time) const;
};

/// A hand that rests on a leg that leads straight ahead, though nothing is being said.
struct StillHand {
  bool driven = false;          ///< ahead on this leg
  std::optional<double> urged;  ///< s, on this leg, to push the stick
  std::optional<double> since;  ///< s, neither the hand has moved nor the voice spoken

  void observe(const Observation& now, double time);
  /// The person was told to go straight, and has not begun.
  /// \param again  s, from one word to push the stick to the next
  [[nodiscard]] bool due(double time, double again) const;
};

/// Another route than before is news until its way was told.
struct ToldRoutes {
  std::uint32_t told = 0;    ///< reroutes of this goal, whose way was told
  std::uint32_t before = 0;  ///< the last words of the way

  void tell(std::uint32_t reroutes);
  [[nodiscard]] bool news(const Guidance& guidance) const { return guidance.reroutes != told; }
};

/// What a person knows of the leg that they drive, from one corner of the path to the next, and
/// what is news to them. The state is `news`; these events change it and what goes with it:
///
/// | event        | news                            | said.hour | turn_told      | routes.told    |
/// |--------------|---------------------------------|-----------|----------------|----------------|
/// | `begin`      | none                            | unknown   |                | as now         |
/// | `advance`    | corner or told_corner: reached; |           | no, at another |                |
/// |              | else other_route, if it is      |           | corner         |                |
/// | `heard`      | none                            | as said   |                | as now         |
/// | `announced`  |                                 |           | yes            |                |
/// | `lost`       |                                 | unknown   | no             | as before that |
/// | `route_lost` | other_route                     | unknown * |                | as before that |
/// | `stand`      | none                            |           |                |                |
/// | `pause`      | none                            | unknown   |                |                |
///
/// * but not where a sound leads. An unknown hour makes the direction due at once.
struct Leg {
  enum class News {
    none,
    corner,       ///< it was reached, and this is the next leg
    told_corner,  ///< likewise, and its turn was announced
    other_route,  ///< the plan leads elsewhere
  };
  /// The way as of the last look.
  struct Sight {
    Eigen::Vector2d corner;      ///< m, in map
    double distance = 0.0;       ///< m
    double angle = 0.0;          ///< rad, to it
    double steer = 0.0;          ///< rad
    std::uint32_t reroutes = 0;  ///< of this goal
  };
  struct Said {
    std::optional<int> hour;  ///< nullopt: the person does not know where to steer
    double time = 0.0;        ///< s
    double angle = 0.0;       ///< rad, where to steer then
  };
  struct Turn {
    std::optional<int> hour;
    double time = 0.0;  ///< s
  };

  std::optional<Sight> seen;  ///< nullopt: there was no path at the last look
  News news = News::none;
  Said said;                       ///< the direction
  Turn turn;                       ///< that was last announced
  bool turn_told = false;          ///< it is that of the corner ahead
  bool fell_away = false;          ///< it is no longer to be made
  bool room_made = false;          ///< the thing to make room for was named
  double unheard = -1e9;           ///< s, when words of the way were lost
  ToldRoutes routes;               ///< of this goal
  std::optional<double> reminder;  ///< s, from which on the direction is to be said again
  Stray stray;
  StillHand hand;

  void begin(const Guidance& guidance);
  /// The robot has driven, or the path has changed.
  /// \param next  hour of the turn at the corner ahead, if it is near enough to be announced
  void advance(const Guidance& guidance, std::optional<int> next, const RouteConfig& config);
  /// The direction is said now.
  void heard(int hour, double time);
  /// The turn at the corner ahead is announced now.
  void announced(int hour, double time);
  /// What was said of the way was not heard: it is said again, as it is then.
  void lost(double time);
  /// That the route is another was not heard. \param by_sound  a sound leads
  void route_lost(bool by_sound);
  /// The person waits: another plan, and not the robot, has replaced the corner.
  void stand() { news = News::none; }
  /// The path is gone.
  void pause();

  [[nodiscard]] bool at_corner() const { return news == News::corner || news == News::told_corner; }
  /// \param same  m, by which the same corner may move
  [[nodiscard]] bool ends(const Guidance& guidance, double same) const;

 private:
  [[nodiscard]] News change_to(const Guidance& guidance, const RouteConfig& config) const;
};

}  // namespace navvi_feedback::cues
