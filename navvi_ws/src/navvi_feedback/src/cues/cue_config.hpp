#pragma once

#include <string>

#include "navvi_config/field.hpp"

namespace navvi_feedback::cues {

/// s, after words that found no room, before they are said again.
inline constexpr double kTryAgain = 0.3;

struct WordingConfig {
  std::string directions =
      "clock";  ///< clock "3 o'clock", left_right "right", degrees "90 degrees right"
  std::string units = "meters";      ///< meters or feet
  std::string verbosity = "normal";  ///< brief, normal or full
  bool way = true;                   ///< directions are said without being asked for
  bool near = true;                  ///< likewise what is near; a word to stop always is

  void describe(navvi_config::Visitor& visit);
};

/// A robot that drives elsewhere than it is led.
struct StrayConfig {
  /// deg, driving farther than this away from where to steer is the wrong way
  static constexpr double kWrongWayDegrees = 120.0;
  static constexpr double kOffPath = 0.7;  ///< m, farther than this from the path is off it
  static constexpr double kOnPath = 0.4;   ///< m, nearer than this to the path is on it again
  static constexpr double kAfter = 1.5;    ///< s, straying for so long is announced
  static constexpr double kRepeat = 10.0;  ///< s, repeats while the robot strays
};

struct RouteConfig {
  std::string rounding = "nearest";
  /// deg, how far beyond its border the announced hour still stands
  static constexpr double kHysteresisDegrees = 5.0;
  double turn_ahead = 6.0;        ///< m
  /// m, a way-point that is replaced within this distance was reached: turn now
  static constexpr double kTurnNow = 2.0;
  static constexpr double kSameTurn = 5.0;    ///< s, the same turn is not announced again within
  static constexpr double kSameCorner = 1.0;  ///< m, a way-point that moved less is the same
  static constexpr double kRepeatDirection = 6.0;  ///< s, repeats while the robot faces elsewhere
  /// s, repeats while the robot faces the way-point
  static constexpr double kRepeatStraight = 20.0;
  static constexpr double kPause = 1.5;         ///< s, least time between two directions
  static constexpr double kTurningRate = 0.25;  ///< rad/s, faster turns on the spot are waited for
  static constexpr double kSettle = 0.3;        ///< s, how long a turn must have ended
  /// s, how long before it faces the way-point a turning robot is told so
  static constexpr double kStraightLead = 0.5;
  /// s, with the stick at rest for so long, the direction is repeated half as often
  static constexpr double kIdle = 5.0;
  /// m, no correction while the robot heads to pass the way-point within this distance
  static constexpr double kReach = 0.8;
  /// m, nearer than this a way-point roughly ahead needs no more directions
  static constexpr double kAtHand = 1.0;
  /// deg, facing elsewhere by so much more than when it was told needs the direction again
  static constexpr double kWorseDegrees = 15.0;
  /// m, turning with a smaller radius is turning on the spot
  static constexpr double kSpotRadius = 0.5;
  /// m, where a sound leads, a shorter leg needs no words
  static constexpr double kLongLeg = 10.0;
  static constexpr double kNextTurn = 3.0;  ///< m, a turn so soon after another is told with it
  /// m, a thing ahead with a larger gap need not be passed yet
  static constexpr double kInTheWay = 1.0;
  /// m, where a sound leads, no direction leads at what moves ahead within this gap
  static constexpr double kComing = 2.5;
  /// s, what is ahead for so long is to be driven round
  static constexpr double kStillAhead = 6.0;
  bool join = true;
  StrayConfig stray;

  void describe(navvi_config::Visitor& visit);
};

struct NearConfig {
  double distance = 1.0;    ///< m, gap
  static constexpr double kClose = 0.35;      ///< m, gap at which it is announced once more
  static constexpr double kHysteresis = 0.2;  ///< m, how much farther it must be to count as gone
  static constexpr double kForget = 8.0;      ///< s, how long it must be gone to be announced again
  bool obstacles = true;
  double stop_moving = 2.5;    ///< s
  double stop_standing = 1.5;  ///< s

  void describe(navvi_config::Visitor& visit);
};

struct CuePolicyConfig {
  double stuck_time = 1.5;       ///< s
  static constexpr double kStuckLinear = 0.05;  ///< m/s, slower counts as not moving
  static constexpr double kStuckAngular = 0.1;  ///< rad/s, slower counts as not turning
  double stuck_repeat = 2.5;     ///< s
  static constexpr double kBlockerGap = 0.5;  ///< m, a thing farther away is not what blocks
  static constexpr double kProblemRepeat = 15.0;  ///< s, repeats while the guidance does not lead
  /// s, a link that never lived for so long counts as lost
  static constexpr double kPatience = 10.0;
  double same_text = 10.0;       ///< s
  /// s, from a collision or a word to stop to the next direction
  static constexpr double kRecover = 2.0;
  static constexpr double kStarting = 3.0;  ///< s, how long a start may take before it is a problem
  static constexpr double kLastWords = 10.0;  ///< s, without directions after a trial's end
  WordingConfig wording;
  RouteConfig route;
  NearConfig near;

  void describe(navvi_config::Visitor& visit);
};

}  // namespace navvi_feedback::cues
