#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "cues/collision_forecast.hpp"
#include "cues/cue_config.hpp"
#include "cues/last_said.hpp"
#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Warns of what will be hit within `stop_time`, be it a shelf, a thing, or what comes along: it is
/// to stop for, or to keep off by a person who was told to stop for it and drives along it. Of what
/// comes to a robot that stands, it tells that it comes.
class CollisionWarning {
 public:
  explicit CollisionWarning(const NearConfig& config) : config_(config) {}

  struct Warning {
    Utterance utterance;
    NearThing thing;
  };
  /// \param told_to_stop  just now: that something comes is no news
  /// \param said  when kinds were said: one that would come too soon waits
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::optional<Warning> update(const Observation& now, bool told_to_stop,
                                              const LastSaid& said, double time);

  /// \return whether anything would be to stop for within `time` (s), be it that the robot goes on
  /// as it does, or, of what moves about, that it drives where it is led
  [[nodiscard]] bool comes(const Observation& now, double time) const;

  /// The warning was not heard.
  void lost() { last_.of.reset(); }

 private:
  /// The last warning, until it is not heard.
  struct Last {
    std::optional<std::uint32_t> of = {};  ///< what was to be stopped for, or came, by id
    double time = 0.0;                     ///< s
    double danger = 0.0;                   ///< s, when it was last about to be hit
    bool stop = false;                     ///< it was to be stopped for
    bool keep_off = false;                 ///< and then only to be kept off
  };
  struct Danger {
    NearThing thing;
    double left;  ///< s
  };
  [[nodiscard]] std::optional<Danger> soonest(const Observation& now, double time);
  [[nodiscard]] double stop_time(const Observation& now, const NearThing& thing) const;
  [[nodiscard]] bool steadily(std::uint32_t thing, bool heads, double time);

  NearConfig config_;
  CollisionForecast forecast_;
  std::map<std::uint32_t, double> headed_;  ///< s, since when for the robot, by id
  Last last_;
};

}  // namespace navvi_feedback::cues
