#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "cues/cue_config.hpp"
#include "cues/phrases.hpp"
#include "senses/observation.hpp"
#include "types.hpp"

namespace navvi_feedback::cues {

/// Forecasts when a near thing will be touched if it and the robot go on as they do: in a straight
/// line, by how its nearest point has moved of late, seen from the robot. Along the face of a shelf
/// that point slides as the robot drives, so that a robot that slowly nears it is seen, too. What
/// stands nears as fast as the robot drives now, however slowly it began.
class CollisionForecast {
 public:
  /// \param drives  m/s, of the robot, forward positive
  /// \param time  s, of a clock that does not run backwards
  void update(const std::vector<NearThing>& nearby, double drives, double time);

  /// s, >= 0; infinity if it will be missed, or has not been seen for long enough
  /// \param drives  of the robot, from now on
  [[nodiscard]] double time_to_collision(const NearThing& thing, const Velocity& drives) const;
  /// Likewise of a thing that moves, once a robot that stands now drives. \param velocity  m/s, in
  /// base_link
  [[nodiscard]] double time_once_driven(const NearThing& thing,
                                        const Eigen::Vector2d& velocity) const;

 private:
  struct Seen {
    double time = 0.0;                                ///< s
    double driven = 0.0;                              ///< m, by the robot until then
    Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< m, in base_link
  };
  /// How the thing's point has moved, and the robot's mean speed meanwhile.
  struct Motion {
    Eigen::Vector2d velocity;  ///< m/s, in base_link
    double drives;             ///< m/s, >= 0
  };
  [[nodiscard]] std::optional<Motion> motion_of(const NearThing& thing) const;

  double driven_ = 0.0;                              ///< m, either way
  double time_ = 0.0;                                ///< s, of the last update
  std::map<std::uint32_t, std::vector<Seen>> seen_;  ///< of late, by id
};

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
  /// \param said  when each was said: one that would come too soon waits
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::optional<Warning> update(const Observation& now, bool told_to_stop,
                                              const LastSaid& said, double time);

  /// \return whether anything would be to stop for within `time` (s), be it that the robot goes on
  /// as it does, or, of what moves about, that it drives where it is led
  [[nodiscard]] bool comes(const Observation& now, double time) const;

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
