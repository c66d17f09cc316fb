#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "cues/collision_warning.hpp"
#include "cues/cue_config.hpp"
#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Tells what is near. Above all what will be hit, see CollisionWarning. Besides, a shelf or a wall
/// is named once a side at `distance` (R-AUD-3), once more at `close`. Any other thing is named
/// once at `distance`, if the robot drives towards it, because rumble does not say what it is; and
/// once more at `close`, if it moves about.
class NearCues {
 public:
  struct Hold {
    bool ahead = false;
    bool comes = false;
  };

  explicit NearCues(const NearConfig& config) : config_(config), warning_(config) {}

  /// \param all  false: only what will be hit
  /// \param hold  what was just said: to go straight ahead, so that what is there waits, unless it
  /// will be hit; or to stop, so that what comes waits
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] Utterances update(const Observation& now, bool all, Hold hold, double time);

  [[nodiscard]] bool comes(const Observation& now, double time) const {
    return warning_.comes(now, time);
  }

  /// These words were dropped: what they told may be told again at once.
  void unsaid(const Content& content);

 private:
  enum class Level { none, near, close };
  struct Watch {
    Level said = Level::none;
    double last_near = 0.0;  ///< s, when the thing was last within reach
  };

  struct Candidate {
    Utterance utterance;
    double gap = 0.0;  ///< m
    Watch* watch = nullptr;
    Level level = Level::none;
  };

  [[nodiscard]] Level level(double gap, Level said) const;
  /// \param straight  that was just said: what is ahead waits
  void consider_sides(const Observation& now, bool straight, double time,
                      std::optional<Candidate>& best);
  void consider_things(const Observation& now, bool straight, double time,
                       std::optional<Candidate>& best);
  /// Brings a watch up to date. \return what its thing has reached
  Level observe(Watch& watch, double gap, double time) const;

  NearConfig config_;
  CollisionWarning warning_;
  std::map<std::pair<ThingClass, Side>, Watch> watches_;
  LastSaid said_;  ///< what would come too soon waits, so that it is not lost
  std::map<std::uint32_t, Watch> things_;  ///< by id
};

}  // namespace navvi_feedback::cues
