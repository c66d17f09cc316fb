#include "sounds/sounds_config.hpp"

namespace navvi_feedback::sounds {

using navvi_config::Any;
using navvi_config::Range;

void FamilyConfig::describe(navvi_config::Visitor& visit) {
  visit(on, "on", Any{}, "", "false: not heard; words do its work where there are any");
  visit(volume, "volume", Range{0.0, 1.0}, "", "gain");
}

void TurnConfig::describe(navvi_config::Visitor& visit) {
  visit(volume, "volume", Range{0.0, 1.0}, "", "gain, of ticks and of what lasts");
  visit(stopping_delay, "stopping_delay", Range{0.0, 2.0}, "s",
        "how much earlier it ends: what the person and the robot take to stop a turn");
  visit(stopping_spread, "stopping_spread", Range{0.0, 2.0}, "s",
        "standard deviation of that, from turn to turn: the larger, the slower a turn ends");
  visit(
      learn, "learn", Any{}, "",
      "correct both by each turn that was stopped, and let words lead where turns by sounds leave "
      "too much");
  visit(
      slow_down, "slow_down", Range{0.0, 5.0}, "s",
      "while it counts down, the robot turns no faster than what is left over this time, so that a "
      "late hand does little; 0: as fast as the stick says");
}

void SoundsConfig::describe(navvi_config::Visitor& visit) {
  visit(enabled, "enabled", Any{}, "", "false: nothing but words");
  visit.group("turn", turn);
  visit.group("hit", hit);
  visit.group("shelf", shelf);
  visit.group("near", near);
  visit.group("arrival", arrival);
  visit.group("beacon", beacon);
  visit(sides, "sides", Any{}, "",
        "the sound device by which the person told left from right: with it they are not asked");
}

const FamilyConfig& SoundsConfig::family_of(Earcon earcon) const {
  switch (earcon) {
    case Earcon::turn:
    case Earcon::turn_click:
    case Earcon::turn_stop:
    case Earcon::on_course:
      return turn;
    case Earcon::hit_shelf:
    case Earcon::hit_obstacle:
      return hit;
    case Earcon::shelf_near:
    case Earcon::shelf_close:
      return shelf;
    case Earcon::arrived:
      return arrival;
    case Earcon::beacon:
      return beacon;
    default:
      return near;
  }
}

}  // namespace navvi_feedback::sounds
