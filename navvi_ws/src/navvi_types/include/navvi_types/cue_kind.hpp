#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <optional>

#include "navvi_types/names.hpp"
#include "navvi_types/signal.hpp"

namespace navvi_types {

/// The scale of speech-dispatcher, least first.
enum class Priority : std::uint8_t { progress, notification, text, message, important };
[[nodiscard]] constexpr std::array<const char*, 5> names(Priority) {
  return {"progress", "notification", "text", "message", "important"};
}

/// Every kind of sentence that the guide speaks. Each has a row of kCueKinds, and a phrase.
enum class CueKind : std::uint8_t {
  // Safety: nothing cuts these. Each thing that is hit has its own cue, see CuePolicy.
  collision_shelf,
  collision_wall,
  collision_obstacle,
  obstacle_stop,
  pad_lost,
  keyboard_lost,
  pad_too_late,
  emergency_stop,
  robot_stopped,
  simulator_lost,
  odometry_lost,
  connection_lost,
  proximity_lost,
  guidance_lost,
  record_lost,
  trial_disk_full,
  // What the person must act on now.
  stuck,
  stuck_unknown,
  arrived,
  turn_now,
  no_route,
  off_mesh,
  no_map,
  pose_stale,
  map_stale,
  blocked,
  obstacle_comes,
  back_away,
  go_on,
  make_room,
  goal_refused_not_finite,
  goal_refused_unknown_frame,
  goal_refused_inside_obstacle,
  goal_refused_off_the_map,
  goal_refused_unreachable,
  goal_refused_not_seen,
  release_stick,
  hold_to_drive,
  intruder,
  machine_slow,
  pad_late,
  battery_low,
  assisted,
  connection_slow,
  two_drivers,
  pad_back,
  keyboard_back,
  audio_back,
  connection_back,
  picture_back,
  proximity_back,
  no_rumble,
  second_pad,
  sides_wrong,
  which_side,
  press_start,
  press_enter,
  choose_goal,
  trial_begins,
  goal_chosen,
  goal_sure,
  menu_begin,
  menu_goals,
  menu_place,
  menu_glossary,
  menu_remember,
  menu_end,
  menu_end_sure,
  menu_empty,
  menu_closed,
  no_trial,
  menu_settings,
  setting,
  setting_open,
  setting_changed,
  settings_of,
  settings_not_kept,
  settings_not_saved,
  place_saved,
  place_not_saved,
  place_no_file,
  place_no_pose,
  trial_time_up,
  trial_over,
  pad_firmware,
  // The way.
  start,
  start_distance,
  toward_goal,
  goal_seen,
  direction,
  straight,
  slight,
  straight_then,
  turn_ahead,
  wrong_way,
  off_path,
  turn_cancelled,
  push,
  rerouted,
  rerouted_blocked,
  new_route,
  way_blocked,
  shelf_near,
  wall_near,
  shelf_close,
  wall_close,
  obstacle_near,
  obstacle_close,
  // On demand, and by the way.
  goal_info,
  goal_info_distance,
  no_goal,
  around,
  around_side,
  stops_before,
  where,
  where_place,
  where_goal,
  help_pad,
  help_keys,
  help_menu,
  around_nothing,
  welcome,
  // Not in the phrases: a sentence of a lesson has a key of its own.
  lesson,
};

/// Kinds that are treated alike.
enum class CueFamily : std::uint8_t {
  other,
  hit,        ///< something was touched
  halt,       ///< stop, until "go on"
  stuck,      ///< the robot does not move as it is driven
  way,        ///< a direction that the person may do without
  route,      ///< a direction that they may not do without
  near,       ///< a thing within reach, where nothing need be done
  close,      ///< likewise, all but touched
  refusal,    ///< of a goal
  trial_end,  ///< why a trial is over
  menu,       ///< an entry of the spoken menu
  menu_end,   ///< the menu is closed
};

/// The answer of the hands that a cue asks for.
enum class Ask : std::uint8_t {
  nothing,
  ready,       ///< a goal is named; a direction or a sound follows
  begin,       ///< press the button that begins
  turn,        ///< to an hour, then go on
  go,          ///< straight ahead
  turn_ahead,  ///< remember a turn that comes
  beware,      ///< keep off a side
  back,        ///< let go of what was touched, or get free
  halt,        ///< hands off
  rest,        ///< the goal is reached
};


/// How a kind of cue is treated.
struct CueTraits {
  CueKind kind;
  const char* word;  ///< in messages, phrases and records
  Priority priority;
  double min_interval;  ///< s, the least time between two of the same kind
  double max_age;       ///< s after which it is dropped if it has not begun
  CueFamily family = CueFamily::other;
  Ask ask = Ask::nothing;
  bool shown = false;  ///< some seconds in the banner, as what it is about lasts no longer
  std::optional<Pattern> felt = {};  ///< the motors' pattern that begins with it
};

namespace cue_table {
using K = CueKind;
using P = Priority;
using F = CueFamily;
using A = Ask;
using T = Pattern;

// kind, word, priority, least interval in s, largest age in s, family, ask, shown, pattern
inline constexpr CueTraits kRows[] = {
    // Safety: nothing cuts these. Each thing that is hit has its own cue, see CuePolicy; the loss
    // of a device has no least interval, or "it is back" would stand, see Flapping.
    {K::collision_shelf, "collision_shelf", P::important, 0.0, 3.0, F::hit, A::back, true},
    {K::collision_wall, "collision_wall", P::important, 0.0, 3.0, F::hit, A::back, true},
    {K::collision_obstacle, "collision_obstacle", P::important, 0.0, 3.0, F::hit, A::back,
     true},
    {K::obstacle_stop, "obstacle_stop", P::important, 3.0, 1.0, F::halt, A::beware, false,
     T::halt},
    {K::pad_lost, "pad_lost", P::important, 0.0, 10.0, F::other, A::halt},
    {K::keyboard_lost, "keyboard_lost", P::important, 0.0, 10.0, F::other, A::halt},
    {K::pad_too_late, "pad_too_late", P::important, 5.0, 10.0, F::other, A::halt},
    {K::emergency_stop, "emergency_stop", P::important, 2.0, 10.0, F::other, A::halt},
    {K::robot_stopped, "robot_stopped", P::important, 2.0, 4.0, F::other, A::halt, false,
     T::stopped},
    {K::simulator_lost, "simulator_lost", P::important, 5.0, 10.0, F::other, A::halt},
    {K::odometry_lost, "odometry_lost", P::important, 5.0, 10.0, F::other, A::halt},
    {K::connection_lost, "connection_lost", P::important, 5.0, 10.0, F::other, A::halt, false,
     T::stopped},
    {K::proximity_lost, "proximity_lost", P::important, 0.0, 10.0, F::other, A::nothing, true},
    {K::guidance_lost, "guidance_lost", P::important, 5.0, 5.0, F::other, A::halt},
    {K::record_lost, "record_lost", P::important, 5.0, 10.0, F::other, A::nothing, true},
    {K::trial_disk_full, "trial_disk_full", P::important, 5.0, 10.0, F::trial_end, A::nothing,
     true},
    // What the person must act on now.
    {K::stuck, "stuck", P::message, 2.0, 1.0, F::stuck, A::turn, true, T::stuck},
    {K::stuck_unknown, "stuck_unknown", P::message, 2.0, 2.0, F::stuck, A::back, true,
     T::stuck},
    {K::arrived, "arrived", P::message, 1.0, 10.0, F::other, A::rest, false, T::arrived},
    {K::turn_now, "turn_now", P::message, 1.0, 1.0, F::route, A::turn},
    {K::no_route, "no_route", P::message, 5.0, 5.0, F::other, A::halt},
    {K::off_mesh, "off_mesh", P::message, 5.0, 5.0, F::other, A::back},
    {K::no_map, "no_map", P::message, 5.0, 5.0, F::other, A::halt},
    {K::pose_stale, "pose_stale", P::message, 5.0, 5.0, F::other, A::halt},
    {K::map_stale, "map_stale", P::message, 5.0, 5.0, F::other, A::halt},
    {K::blocked, "blocked", P::message, 3.0, 1.0, F::halt, A::halt, false, T::halt},
    {K::obstacle_comes, "obstacle_comes", P::message, 1.5, 1.0, F::other, A::beware},
    {K::back_away, "back_away", P::message, 2.0, 1.0, F::other, A::back, true, T::stuck},
    {K::go_on, "go_on", P::message, 1.0, 2.0, F::other, A::go},
    {K::make_room, "make_room", P::message, 1.0, 1.0, F::route, A::turn},
    {K::goal_refused_not_finite, "goal_refused_not_finite", P::message, 1.0, 10.0, F::refusal,
     A::halt},
    {K::goal_refused_unknown_frame, "goal_refused_unknown_frame", P::message, 1.0, 10.0, F::refusal,
     A::halt},
    {K::goal_refused_inside_obstacle, "goal_refused_inside_obstacle", P::message, 1.0, 10.0,
     F::refusal, A::halt},
    {K::goal_refused_off_the_map, "goal_refused_off_the_map", P::message, 1.0, 10.0, F::refusal,
     A::halt},
    {K::goal_refused_unreachable, "goal_refused_unreachable", P::message, 1.0, 10.0, F::refusal,
     A::halt},
    {K::goal_refused_not_seen, "goal_refused_not_seen", P::message, 1.0, 10.0, F::refusal, A::halt},
    {K::release_stick, "release_stick", P::message, 2.0, 2.0, F::other, A::halt, true,
     T::stopped},
    {K::hold_to_drive, "hold_to_drive", P::message, 2.0, 2.0, F::other, A::nothing, true},
    {K::intruder, "intruder", P::message, 5.0, 10.0},
    {K::machine_slow, "machine_slow", P::message, 5.0, 10.0},
    {K::pad_late, "pad_late", P::message, 5.0, 10.0},
    {K::battery_low, "battery_low", P::message, 5.0, 10.0},
    {K::assisted, "assisted", P::text, 10.0, 1.0, F::other, A::nothing, false, T::assisted},
    {K::connection_slow, "connection_slow", P::message, 5.0, 10.0},
    {K::two_drivers, "two_drivers", P::message, 5.0, 10.0},
    {K::pad_back, "pad_back", P::message, 2.0, 5.0, F::other, A::halt},
    {K::keyboard_back, "keyboard_back", P::message, 2.0, 5.0},
    {K::audio_back, "audio_back", P::message, 2.0, 5.0},
    {K::connection_back, "connection_back", P::message, 2.0, 5.0},
    {K::picture_back, "picture_back", P::message, 2.0, 5.0},
    {K::proximity_back, "proximity_back", P::message, 5.0, 5.0},
    {K::no_rumble, "no_rumble", P::message, 5.0, 10.0},
    {K::second_pad, "second_pad", P::message, 5.0, 10.0},
    {K::sides_wrong, "sides_wrong", P::message, 5.0, 10.0, F::other, A::nothing, true},
    {K::which_side, "which_side", P::message, 2.0, 5.0},
    {K::press_start, "press_start", P::message, 2.0, 5.0, F::other, A::begin, false, T::ready},
    {K::press_enter, "press_enter", P::message, 2.0, 5.0, F::other, A::begin, false, T::ready},
    {K::choose_goal, "choose_goal", P::message, 2.0, 5.0},
    {K::trial_begins, "trial_begins", P::message, 1.0, 2.0, F::other, A::nothing, false,
     T::begun},
    {K::goal_chosen, "goal_chosen", P::message, 0.0, 4.0, F::menu_end},
    {K::goal_sure, "goal_sure", P::message, 0.0, 4.0, F::menu},
    {K::menu_begin, "menu_begin", P::message, 0.0, 4.0, F::menu},
    {K::menu_goals, "menu_goals", P::message, 0.0, 4.0, F::menu},
    {K::menu_place, "menu_place", P::message, 0.0, 4.0, F::menu},
    {K::menu_glossary, "menu_glossary", P::message, 0.0, 4.0, F::menu},
    {K::menu_remember, "menu_remember", P::message, 0.0, 4.0, F::menu},
    {K::menu_end, "menu_end", P::message, 0.0, 4.0, F::menu},
    {K::menu_end_sure, "menu_end_sure", P::message, 0.0, 4.0, F::menu},
    {K::menu_empty, "menu_empty", P::message, 0.0, 4.0, F::menu},
    {K::menu_closed, "menu_closed", P::message, 0.0, 4.0, F::menu_end},
    {K::no_trial, "no_trial", P::message, 0.0, 4.0},
    {K::menu_settings, "menu_settings", P::message, 0.0, 4.0, F::menu},
    {K::setting, "setting", P::message, 0.0, 4.0, F::menu},
    {K::setting_open, "setting_open", P::message, 0.0, 4.0, F::menu},
    {K::setting_changed, "setting_changed", P::message, 0.0, 4.0, F::menu},
    {K::settings_of, "settings_of", P::message, 1.0, 10.0},
    {K::settings_not_kept, "settings_not_kept", P::message, 1.0, 10.0},
    {K::settings_not_saved, "settings_not_saved", P::message, 1.0, 10.0},
    {K::place_saved, "place_saved", P::message, 0.0, 4.0, F::menu_end},
    {K::place_not_saved, "place_not_saved", P::message, 0.0, 10.0, F::menu_end},
    {K::place_no_file, "place_no_file", P::message, 0.0, 4.0, F::menu_end},
    {K::place_no_pose, "place_no_pose", P::message, 0.0, 4.0, F::menu_end},
    {K::trial_time_up, "trial_time_up", P::message, 5.0, 10.0, F::trial_end, A::nothing, true},
    {K::trial_over, "trial_over", P::message, 5.0, 10.0, F::trial_end, A::nothing, true},
    {K::pad_firmware, "pad_firmware", P::message, 5.0, 10.0},
    // The way.
    {K::start, "start", P::text, 2.0, 10.0, F::other, A::ready},
    {K::start_distance, "start_distance", P::text, 2.0, 10.0, F::other, A::ready},
    {K::toward_goal, "toward_goal", P::text, 0.0, 10.0, F::other, A::ready},
    {K::goal_seen, "goal_seen", P::text, 0.0, 10.0, F::other, A::ready},
    {K::direction, "direction", P::text, 1.0, 1.0, F::way, A::turn},
    {K::straight, "straight", P::text, 1.0, 1.0, F::way, A::go},
    {K::slight, "slight", P::text, 1.0, 1.0, F::way, A::turn},
    {K::straight_then, "straight_then", P::text, 1.0, 1.0, F::way, A::go},
    {K::turn_ahead, "turn_ahead", P::text, 2.0, 1.0, F::way, A::turn_ahead},
    {K::wrong_way, "wrong_way", P::message, 2.0, 1.0, F::route, A::turn},
    {K::off_path, "off_path", P::text, 2.0, 1.0, F::route},
    {K::turn_cancelled, "turn_cancelled", P::text, 1.0, 1.0, F::way, A::go},
    {K::push, "push", P::text, 2.0, 1.0, F::way, A::go},
    {K::rerouted, "rerouted", P::text, 4.0, 1.0, F::route, A::turn, false, T::rerouted},
    {K::rerouted_blocked, "rerouted_blocked", P::text, 4.0, 1.0, F::route, A::turn, false,
     T::rerouted},
    {K::new_route, "new_route", P::message, 4.0, 1.0, F::other, A::nothing, false, T::rerouted},
    {K::way_blocked, "way_blocked", P::message, 4.0, 1.0, F::other, A::nothing, false,
     T::rerouted},
    {K::shelf_near, "shelf_near", P::text, 1.5, 1.0, F::near, A::beware},
    {K::wall_near, "wall_near", P::text, 1.5, 1.0, F::near, A::beware},
    {K::shelf_close, "shelf_close", P::text, 1.5, 1.0, F::close, A::beware},
    {K::wall_close, "wall_close", P::text, 1.5, 1.0, F::close, A::beware},
    {K::obstacle_near, "obstacle_near", P::text, 1.5, 1.0, F::near, A::beware},
    {K::obstacle_close, "obstacle_close", P::text, 1.5, 1.0, F::close, A::beware},
    // On demand, and by the way.
    {K::goal_info, "goal_info", P::text, 0.5, 1.0},
    {K::goal_info_distance, "goal_info_distance", P::text, 0.5, 1.0},
    {K::no_goal, "no_goal", P::text, 0.5, 4.0},
    {K::around, "around", P::text, 0.5, 1.0},
    {K::around_side, "around_side", P::text, 0.5, 1.0},
    {K::stops_before, "stops_before", P::text, 0.5, 1.0},
    {K::where, "where", P::text, 0.5, 1.0},
    {K::where_place, "where_place", P::text, 0.5, 4.0},
    {K::where_goal, "where_goal", P::text, 0.5, 1.0},
    {K::help_pad, "help_pad", P::text, 0.5, 4.0},
    {K::help_keys, "help_keys", P::text, 0.5, 4.0},
    {K::help_menu, "help_menu", P::text, 0.5, 8.0},
    {K::around_nothing, "around_nothing", P::text, 0.5, 4.0},
    {K::welcome, "welcome", P::notification, 5.0, 10.0},
    // A lesson's.
    {K::lesson, "lesson", P::message, 0.0, 20.0},
};
}  // namespace cue_table

inline constexpr std::size_t kCueKinds = std::size(cue_table::kRows);

[[nodiscard]] constexpr const CueTraits& traits(CueKind kind) {
  return cue_table::kRows[static_cast<std::size_t>(kind)];
}
[[nodiscard]] constexpr CueFamily family_of(CueKind kind) { return traits(kind).family; }

[[nodiscard]] constexpr std::array<const char*, kCueKinds> names(CueKind) {
  std::array<const char*, kCueKinds> words{};
  for (std::size_t i = 0; i < kCueKinds; ++i) words[i] = cue_table::kRows[i].word;
  return words;
}

/// The rows stand in the order of the kinds, and none is missing.
[[nodiscard]] constexpr bool rows_are_in_order() {
  for (std::size_t i = 0; i < kCueKinds; ++i)
    if (static_cast<std::size_t>(cue_table::kRows[i].kind) != i) return false;
  return kCueKinds == static_cast<std::size_t>(CueKind::lesson) + 1;
}
static_assert(rows_are_in_order(), "each CueKind needs its row of kRows, in the same order");

/// A direction, of either family.
[[nodiscard]] constexpr bool is_way(CueFamily family) {
  return family == CueFamily::way || family == CueFamily::route;
}
/// A thing within reach, of either family.
[[nodiscard]] constexpr bool is_near(CueFamily family) {
  return family == CueFamily::near || family == CueFamily::close;
}

}  // namespace navvi_types
