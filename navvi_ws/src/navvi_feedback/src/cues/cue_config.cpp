#include "cues/cue_config.hpp"

namespace navvi_feedback::cues {

using namespace navvi_config;

void WordingConfig::describe(navvi_config::Visitor& visit) {
  visit(directions, "directions", OneOf{{"clock", "left_right", "degrees"}}, "",
        "how directions are worded: 3 o'clock, right, or 90 degrees right");
  visit(units, "units", OneOf{{"meters", "feet"}}, "", "of spoken distances");
  visit(verbosity, "verbosity", OneOf{{"brief", "normal", "full"}}, "",
        "how many words a phrase has");
  visit(way, "way", Any{}, "", "false: directions are said only when they are asked for");
  visit(near, "near", Any{}, "", "false: what is near is not said; a word to stop always is");
}

void RouteConfig::describe(navvi_config::Visitor& visit) {
  visit(rounding, "rounding", OneOf{{"nearest", "floor"}}, "", "how an angle becomes an hour");
  visit(turn_ahead, "turn_ahead", Range{0.5, 50.0}, "m", "distance from which a turn is announced");
  visit(join, "join", Any{}, "",
        "two turns in a row are one sentence, and no direction leads straight at what is ahead");
}

void NearConfig::describe(navvi_config::Visitor& visit) {
  visit(distance, "distance", Range{0.1, 5.0}, "m", "gap at which a shelf or a wall is announced");
  visit(obstacles, "obstacles", Any{}, "",
        "also name any other thing that the robot drives towards");
  visit(stop_moving, "stop_moving", Range{0.0, 10.0}, "s",
        "time to a collision with a moving thing at which the guide says stop; 0: never");
  visit(stop_standing, "stop_standing", Range{0.0, 10.0}, "s",
        "the same for a standing thing; at most 1 s if the path turns off before it");
}

void CuePolicyConfig::describe(navvi_config::Visitor& visit) {
  visit(stuck_time, "stuck_time", Range{0.2, 30.0}, "s",
        "commanded without moving for longer is stuck");
  visit(stuck_repeat, "stuck_repeat", Range{1.0, 60.0}, "s", "repeats while the robot stays stuck");
  visit(same_text, "same_text", Range{0.0, 60.0}, "s",
        "a reminder in the same words is only felt within");
  visit.group("wording", wording);
  visit.group("route", route);
  visit.group("near", near);
}

}  // namespace navvi_feedback::cues
