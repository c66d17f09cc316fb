#pragma once

#include <string>

#include "navvi_config/field.hpp"

namespace navvi_feedback::cues {

/// s, after words that found no room, before they are said again.
inline constexpr double kTryAgain = 0.3;

/// How things are worded, in any language.
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
  double wrong_way_degrees = 120.0;
  double off_path = 0.7;  ///< m
  double on_path = 0.4;   ///< m
  double after = 1.5;     ///< s
  double repeat = 10.0;   ///< s

  void describe(navvi_config::Visitor& visit);
};

struct RouteConfig {
  std::string rounding = "nearest";
  double hysteresis_degrees = 5.0;
  double turn_ahead = 6.0;        ///< m
  double turn_now = 2.0;          ///< m
  double same_turn = 5.0;         ///< s
  double same_corner = 1.0;       ///< m
  double repeat_direction = 6.0;  ///< s
  double repeat_straight = 20.0;  ///< s
  double pause = 1.5;             ///< s
  double turning_rate = 0.25;     ///< rad/s
  double settle = 0.3;            ///< s
  double straight_lead = 0.5;     ///< s
  double idle = 5.0;              ///< s
  double reach = 0.8;             ///< m
  double at_hand = 1.0;           ///< m
  double worse_degrees = 15.0;
  double spot_radius = 0.5;  ///< m
  double long_leg = 10.0;    ///< m
  double next_turn = 3.0;    ///< m
  double in_the_way = 1.0;   ///< m, gap
  double coming = 2.5;       ///< m, gap
  double still_ahead = 6.0;  ///< s
  bool join = true;
  StrayConfig stray;

  void describe(navvi_config::Visitor& visit);
};

struct NearConfig {
  double distance = 1.0;    ///< m, gap
  double close = 0.35;      ///< m, gap
  double hysteresis = 0.2;  ///< m
  double forget = 8.0;      ///< s
  bool obstacles = true;
  double stop_moving = 2.5;    ///< s
  double stop_standing = 1.5;  ///< s

  void describe(navvi_config::Visitor& visit);
};

struct CuePolicyConfig {
  double stuck_time = 1.5;       ///< s
  double stuck_linear = 0.05;    ///< m/s
  double stuck_angular = 0.1;    ///< rad/s
  double stuck_repeat = 2.5;     ///< s
  double blocker_gap = 0.5;      ///< m
  double state_hold = 0.5;       ///< s
  double problem_repeat = 15.0;  ///< s
  double patience = 10.0;        ///< s
  double same_text = 10.0;       ///< s
  double recover = 2.0;          ///< s
  double starting = 3.0;         ///< s
  double last_words = 10.0;      ///< s
  WordingConfig wording;
  RouteConfig route;
  NearConfig near;

  void describe(navvi_config::Visitor& visit);
};

}  // namespace navvi_feedback::cues
