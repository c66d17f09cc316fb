#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cues/phrases.hpp"
#include "cues/situation.hpp"
#include "navvi_feedback/cues/cue_config.hpp"

namespace navvi_feedback::cues {

/// Says when a shelf or a wall comes near (R-AUD-3): once a side at `distance`, once more at
/// `close`. Any other thing is named once at `distance`, if the robot drives towards it,
/// because rumble does not say what it is; and once more at `close`, if it moves about. If the
/// robot is about to run into it, the first word is to stop.
class NearCues {
 public:
  explicit NearCues(const NearConfig& config) : config_(config) {}

  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::vector<Utterance> update(const Situation& now, double time);

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

  [[nodiscard]] Level level(double gap, Level said) const;
  void consider_sides(const Situation& now, double time, std::optional<Candidate>& best);
  void consider_things(const Situation& now, double time, std::optional<Candidate>& best);
  /// The same kind was said too short a time ago; its next thing waits, so that it is not lost.
  [[nodiscard]] bool too_soon(const std::string& kind, double time) const;
  /// Brings a watch up to date. \return what its thing has reached
  Level observe(Watch& watch, double gap, double time) const;

  NearConfig config_;
  std::map<std::pair<ThingClass, Side>, Watch> watches_;
  std::map<std::string, double> said_;     ///< s, by kind
  std::map<std::uint32_t, Watch> things_;  ///< by id
};

}  // namespace navvi_feedback::cues
