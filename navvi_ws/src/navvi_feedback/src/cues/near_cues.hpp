#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cues/collision_forecast.hpp"
#include "cues/cue_config.hpp"
#include "cues/phrases.hpp"
#include "cues/situation.hpp"
#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::cues {

/// Warns of what is near. Whatever will be hit within `stop_time`, be it a shelf, a thing or what
/// comes along, is to stop for; so is what comes to a robot that stands. Besides, a shelf or a wall
/// is named once a side at `distance` (R-AUD-3), once more at `close`. Any other thing is named
/// once at `distance`, if the robot drives towards it, because rumble does not say what it is; and
/// once more at `close`, if it moves about.
class NearCues {
 public:
  struct Hold {
    bool ahead = false;
    bool comes = false;
  };

  explicit NearCues(const NearConfig& config) : config_(config) {}

  /// \param all  false: only what will be hit
  /// \param hold  what was just said: to go straight ahead, so that what is there waits, unless it
  /// will be hit; or to stop, so that what comes waits
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::vector<Utterance> update(const Situation& now, bool all, Hold hold,
                                              double time);

  /// \return whether anything would be to stop for within `time` (s), be it that the robot goes on
  /// as it does, or, of what moves about, that it drives where it is led
  [[nodiscard]] bool comes(const Situation& now, double time) const;

  /// Words of this kind were dropped: what they told may be told again at once.
  void unsaid(CueKind kind);

 private:
  enum class Level { none, near, close };
  struct Watch {
    Level said = Level::none;
    double last_near = 0.0;  ///< s, when the thing was last within reach
  };

  /// What may be said now.
  struct Candidate {
    Utterance utterance;
    double gap = 0.0;  ///< m
    Watch* watch = nullptr;
    Level level = Level::none;
  };

  void consider_collisions(const Situation& now, double time, std::optional<Candidate>& best);
  [[nodiscard]] double stop_time(const Situation& now, const NearThing& thing) const;
  [[nodiscard]] bool steadily(std::uint32_t thing, bool heads, double time);
  [[nodiscard]] Level level(double gap, Level said) const;
  void consider_sides(const Situation& now, double time, std::optional<Candidate>& best);
  void consider_things(const Situation& now, double time, std::optional<Candidate>& best);
  /// The same kind was said too short a time ago; its next thing waits, so that it is not lost.
  [[nodiscard]] bool too_soon(CueKind kind, double time) const;
  /// Brings a watch up to date. \return what its thing has reached
  Level observe(Watch& watch, double gap, double time) const;

  NearConfig config_;
  CollisionForecast forecast_;
  std::map<std::uint32_t, double> headed_;  ///< s, since when for the robot, by id
  std::optional<std::uint32_t> warned_of_;  ///< what was last to be stopped for, or came, by id
  double warned_ = 0.0;                     ///< s
  double danger_ = 0.0;                     ///< s, when it was last about to be hit
  bool warned_stop_ = false;                ///< it was to be stopped for
  bool kept_off_ = false;                   ///< and then only to be kept off
  Hold hold_;
  std::map<std::pair<ThingClass, Side>, Watch> watches_;
  std::map<CueKind, double> said_;         ///< s, by kind
  std::map<std::uint32_t, Watch> things_;  ///< by id
};

/// What is heard instead of such words, where sounds do their work.
[[nodiscard]] std::optional<sounds::Play> instead_of(const Utterance& utterance,
                                                     const Sounds& sounds);

/// The sound of what is near.
[[nodiscard]] sounds::Earcon earcon_of(ThingClass thing);

/// What is around: the nearest thing on each side, the nearest of all first, then clockwise, each
/// with where it is, for a person who asks.
[[nodiscard]] Utterance around(const std::vector<NearThing>& nearby);

}  // namespace navvi_feedback::cues
