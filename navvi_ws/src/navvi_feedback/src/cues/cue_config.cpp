#include "cues/cue_config.hpp"

namespace navvi_feedback::cues {

using navvi_config::Any;
using navvi_config::OneOf;
using navvi_config::Range;

void WordingConfig::describe(navvi_config::Visitor& visit) {
  visit(directions, "directions", OneOf{{"clock", "left_right", "degrees"}}, "",
        "how directions are worded: 3 o'clock, right, or 90 degrees right");
  visit(units, "units", OneOf{{"meters", "feet"}}, "", "of spoken distances");
  visit(verbosity, "verbosity", OneOf{{"brief", "normal", "full"}}, "",
        "how many words a phrase has");
  visit(way, "way", Any{}, "", "false: directions are said only when they are asked for");
  visit(near, "near", Any{}, "", "false: what is near is not said; a word to stop always is");
}

void StrayConfig::describe(navvi_config::Visitor& visit) {
  visit(wrong_way_degrees, "wrong_way_degrees", Range{30.0, 180.0}, "deg",
        "driving farther than this away from where to steer is the wrong way");
  visit(off_path, "off_path", Range{0.1, 10.0}, "m", "farther than this from the path is off it");
  visit(on_path, "on_path", Range{0.0, 10.0}, "m", "nearer than this to the path is on it again");
  visit(after, "after", Range{0.0, 10.0}, "s", "straying for so long is announced");
  visit(repeat, "repeat", Range{1.0, 60.0}, "s", "repeats while the robot strays");
}

void RouteConfig::describe(navvi_config::Visitor& visit) {
  visit(rounding, "rounding", OneOf{{"nearest", "floor"}}, "", "how an angle becomes an hour");
  visit(hysteresis_degrees, "hysteresis_degrees", Range{0.0, 14.0}, "deg",
        "how far beyond its border the announced hour still stands");
  visit(turn_ahead, "turn_ahead", Range{0.5, 50.0}, "m", "distance from which a turn is announced");
  visit(turn_now, "turn_now", Range{0.5, 10.0}, "m",
        "a way-point that is replaced within this distance was reached: turn now");
  visit(same_turn, "same_turn", Range{0.0, 60.0}, "s",
        "the same turn is not announced again within");
  visit(same_corner, "same_corner", Range{0.1, 10.0}, "m",
        "a way-point that moved less is the same");
  visit(repeat_direction, "repeat_direction", Range{1.0, 60.0}, "s",
        "repeats while the robot faces elsewhere");
  visit(repeat_straight, "repeat_straight", Range{1.0, 60.0}, "s",
        "repeats while the robot faces the way-point");
  visit(pause, "pause", Range{0.0, 10.0}, "s", "least time between two directions");
  visit(turning_rate, "turning_rate", Range{0.05, 3.0}, "rad/s",
        "faster turns on the spot are waited for");
  visit(settle, "settle", Range{0.0, 3.0}, "s", "how long a turn must have ended");
  visit(straight_lead, "straight_lead", Range{0.0, 2.0}, "s",
        "how long before it faces the way-point a turning robot is told so");
  visit(idle, "idle", Range{1.0, 60.0}, "s",
        "with the stick at rest for so long, the direction is repeated half as often");
  visit(reach, "reach", Range{0.1, 5.0}, "m",
        "no correction while the robot heads to pass the way-point within this distance");
  visit(at_hand, "at_hand", Range{0.0, 5.0}, "m",
        "nearer than this a way-point roughly ahead needs no more directions");
  visit(worse_degrees, "worse_degrees", Range{1.0, 90.0}, "deg",
        "facing elsewhere by so much more than when it was told needs the direction again");
  visit(spot_radius, "spot_radius", Range{0.0, 5.0}, "m",
        "turning with a smaller radius is turning on the spot");
  visit(long_leg, "long_leg", Range{0.0, 100.0}, "m",
        "where a sound leads, a shorter leg needs no words");
  visit(next_turn, "next_turn", Range{0.0, 20.0}, "m",
        "a turn so soon after another is told with it");
  visit(in_the_way, "in_the_way", Range{0.0, 5.0}, "m",
        "a thing ahead with a larger gap need not be passed yet");
  visit(coming, "coming", Range{0.0, 10.0}, "m",
        "where a sound leads, no direction leads at what moves ahead within this gap");
  visit(still_ahead, "still_ahead", Range{0.0, 60.0}, "s",
        "what is ahead for so long is to be driven round");
  visit(join, "join", Any{}, "",
        "two turns in a row are one sentence, and no direction leads straight at what is ahead");
  visit.group("stray", stray);
}

void NearConfig::describe(navvi_config::Visitor& visit) {
  visit(distance, "distance", Range{0.1, 5.0}, "m", "gap at which a shelf or a wall is announced");
  visit(close, "close", Range{0.0, 5.0}, "m", "gap at which it is announced once more");
  visit(hysteresis, "hysteresis", Range{0.0, 1.0}, "m",
        "how much farther it must be to count as gone");
  visit(forget, "forget", Range{0.0, 30.0}, "s", "how long it must be gone to be announced again");
  visit(obstacles, "obstacles", Any{}, "",
        "also name any other thing that the robot drives towards");
  visit(stop_moving, "stop_moving", Range{0.0, 10.0}, "s",
        "time to collision with what moves at which the word is to stop; 0: never");
  visit(stop_standing, "stop_standing", Range{0.0, 10.0}, "s",
        "the same, with what stands; at most 1 s if the guide turns off before it");
}

void CuePolicyConfig::describe(navvi_config::Visitor& visit) {
  visit(stuck_time, "stuck_time", Range{0.2, 30.0}, "s",
        "commanded without moving for longer is stuck");
  visit(stuck_linear, "stuck_linear", Range{0.0, 1.0}, "m/s", "slower counts as not moving");
  visit(stuck_angular, "stuck_angular", Range{0.0, 1.0}, "rad/s", "slower counts as not turning");
  visit(stuck_repeat, "stuck_repeat", Range{1.0, 60.0}, "s", "repeats while the robot stays stuck");
  visit(blocker_gap, "blocker_gap", Range{0.0, 5.0}, "m",
        "a thing farther away is not what blocks");
  visit(state_hold, "state_hold", Range{0.0, 5.0}, "s",
        "a state of the guidance shorter than this is passed over, but not a wait that is near");
  visit(problem_repeat, "problem_repeat", Range{1.0, 300.0}, "s",
        "repeats while the guidance does not lead");
  visit(patience, "patience", Range{1.0, 300.0}, "s",
        "a link that never lived for so long counts as lost");
  visit(same_text, "same_text", Range{0.0, 60.0}, "s",
        "a reminder in the same words is only felt within");
  visit(recover, "recover", Range{0.0, 10.0}, "s",
        "from a collision or a word to stop to the next direction");
  visit(starting, "starting", Range{0.0, 30.0}, "s",
        "how long a start may take before it is a problem");
  visit(last_words, "last_words", Range{0.0, 60.0}, "s", "without directions after a trial's end");
  visit.group("wording", wording);
  visit.group("route", route);
  visit.group("near", near);
}

}  // namespace navvi_feedback::cues
