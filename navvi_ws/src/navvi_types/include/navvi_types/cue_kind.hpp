#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "navvi_types/names.hpp"
#include "navvi_types/signal.hpp"

namespace navvi_types {

/// The scale of speech-dispatcher, least first.
enum class Priority : std::uint8_t { progress, notification, text, message, important };

// clang-format off
/// Every kind of sentence that the guide speaks. Each has a row of kRows, and a phrase.
enum class CueKind : std::uint8_t {
  // Safety: nothing cuts these.
  collision, obstacle_stop, stick_lost, pad_too_late, emergency_stop, robot_stopped, robot_lost,
  connection_lost, proximity_lost, guidance_lost, record_lost, trial_disk_full,
  // What the person must act on now.
  stuck, stuck_unknown, arrived, turn_now, no_way, off_mesh, blocked, obstacle_comes, back_away,
  go_on, make_room, goal_refused, release_stick, hold_to_drive, notice, assisted, pad_back, back,
  proximity_back, sides_wrong, which_side, press, choose_goal, trial_begins, menu, menu_closed,
  settings, place_not_saved, trial_ends,
  // The way.
  start, toward_goal, goal_seen, direction, straight, slight, turn_ahead, wrong_way, off_path,
  turn_cancelled, push, rerouted, new_route, near, close,
  // On demand, and by the way; an answer stays true while it waits to be spoken.
  goal_info, around, stops_before, where, answer, welcome,
  // Not in the phrases: a sentence of a lesson has a key of its own.
  lesson,
};

/// What a sentence is about, where its kind has several: a thing, a device, a reason, an entry.
enum class About : std::uint8_t {
  none,
  shelf, wall, obstacle,
  pad, keyboard, simulator, odometry, audio, connection, picture,
  no_route, no_map, pose_stale, map_stale,
  not_finite, unknown_frame, inside_obstacle, off_the_map, unreachable, not_seen,
  intruder, machine_slow, pad_late, battery_low, connection_slow, two_drivers, no_rumble,
  second_pad, pad_firmware, zone_keep_out, zone_slow, zone_rack,
  start, enter, pick, drop, scan,
  goal_sure, menu_begin, menu_goals, menu_place, menu_glossary, menu_remember, menu_end,
  menu_end_sure, menu_empty, menu_settings, setting, setting_open, setting_changed, no_trial,
  menu_closed, goal_chosen, place_saved, place_no_file, place_no_pose,
  of, not_kept, not_saved,
  time_up, over,
  distance, side, blocked, then, goal,
  new_route, way_blocked,
  no_goal, around_nothing, where_place,
};
/// A kind has the word of its row.
void names(CueKind) = delete;
// clang-format on

/// Kinds that are treated alike.
enum class CueFamily : std::uint8_t {
  other,
  halt,       ///< stop, until "go on"
  stuck,      ///< the robot does not move as it is driven
  way,        ///< a direction that the person may do without
  route,      ///< a direction that they may not do without
  trial_end,  ///< why a trial is over
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
  /// In messages, phrases and records; `*` stands for what the sentence is about.
  const char* word;
  Priority priority;
  double min_interval;  ///< s, the least time between two of the same content
  double max_age;       ///< s after which it is dropped if it has not begun
  CueFamily family = CueFamily::other;
  Ask ask = Ask::nothing;
  bool shown = false;  ///< some seconds in the banner, as what it is about lasts no longer
  std::optional<Pattern> felt = {};   ///< the motors' pattern that begins with it
  std::array<About, 14> about = {};   ///< all that it can be about; none, but the first, ends it
};

namespace cue_table {
using K = CueKind;
using P = Priority;
using F = CueFamily;
using A = Ask;
using T = Pattern;
using B = About;

// kind, word, priority, least interval in s, largest age in s, family, ask, shown, pattern, about
inline constexpr CueTraits kRows[] = {
    // Safety: nothing cuts these. Each thing that is hit has its own cue, see CuePolicy; the loss
    // of a device has no least interval, or "it is back" would stand, see Flapping.
    {K::collision, "collision_*", P::important, 0.0, 3.0, F::other, A::back, true, {},
     {B::shelf, B::wall, B::obstacle}},
    {K::obstacle_stop, "obstacle_stop", P::important, 3.0, 1.0, F::halt, A::beware, false,
     T::halt},
    {K::stick_lost, "*_lost", P::important, 0.0, 10.0, F::other, A::halt, false, {},
     {B::pad, B::keyboard}},
    {K::pad_too_late, "pad_too_late", P::important, 5.0, 10.0, F::other, A::halt},
    {K::emergency_stop, "emergency_stop", P::important, 2.0, 10.0, F::other, A::halt, false,
     T::stopped},
    {K::robot_stopped, "robot_stopped", P::important, 2.0, 4.0, F::other, A::halt, false,
     T::stopped},
    {K::robot_lost, "*_lost", P::important, 0.0, 10.0, F::other, A::halt, false, {},
     {B::simulator, B::odometry}},
    {K::connection_lost, "connection_lost", P::important, 0.0, 10.0, F::other, A::halt, false,
     T::stopped},
    {K::proximity_lost, "proximity_lost", P::important, 0.0, 10.0, F::other, A::nothing, true},
    {K::guidance_lost, "guidance_lost", P::important, 5.0, 5.0, F::other, A::halt},
    {K::record_lost, "record_lost", P::important, 5.0, 10.0, F::other, A::nothing, true},
    {K::trial_disk_full, "trial_disk_full", P::important, 5.0, 10.0, F::trial_end, A::nothing,
     true, T::stopped},
    // What the person must act on now.
    {K::stuck, "stuck", P::message, 2.0, 1.0, F::stuck, A::turn, true, T::stuck},
    {K::stuck_unknown, "stuck_unknown", P::message, 2.0, 2.0, F::stuck, A::back, true,
     T::stuck},
    {K::arrived, "arrived", P::message, 1.0, 10.0, F::other, A::rest, false, T::arrived},
    {K::turn_now, "turn_now", P::message, 1.0, 1.0, F::route, A::turn},
    {K::no_way, "*", P::message, 5.0, 5.0, F::other, A::halt, false, {},
     {B::no_route, B::no_map, B::pose_stale, B::map_stale}},
    {K::off_mesh, "off_mesh", P::message, 5.0, 5.0, F::other, A::back},
    {K::blocked, "blocked", P::message, 3.0, 1.0, F::halt, A::halt, false, T::halt},
    {K::obstacle_comes, "obstacle_comes", P::message, 1.5, 1.0, F::other, A::beware},
    {K::back_away, "back_away", P::message, 2.0, 1.0, F::other, A::back, true, T::stuck},
    {K::go_on, "go_on", P::message, 1.0, 2.0, F::other, A::go},
    {K::make_room, "make_room", P::message, 1.0, 1.0, F::route, A::turn},
    {K::goal_refused, "goal_refused_*", P::message, 1.0, 10.0, F::other, A::halt, false, {},
     {B::not_finite, B::unknown_frame, B::inside_obstacle, B::off_the_map, B::unreachable,
      B::not_seen}},
    {K::release_stick, "release_stick", P::message, 2.0, 2.0, F::other, A::halt, true,
     T::stopped},
    {K::hold_to_drive, "hold_to_drive", P::message, 2.0, 2.0, F::other, A::nothing, true},
    {K::notice, "*", P::message, 5.0, 10.0, F::other, A::nothing, false, {},
     {B::intruder, B::machine_slow, B::pad_late, B::battery_low, B::connection_slow,
      B::two_drivers, B::no_rumble, B::second_pad, B::pad_firmware, B::zone_keep_out,
      B::zone_slow, B::zone_rack}},
    {K::assisted, "assisted", P::text, 10.0, 1.0, F::other, A::nothing, false, T::assisted},
    {K::pad_back, "pad_back", P::message, 2.0, 5.0, F::other, A::halt},
    {K::back, "*_back", P::message, 0.0, 5.0, F::other, A::nothing, false, {},
     {B::keyboard, B::audio, B::connection, B::picture}},
    {K::proximity_back, "proximity_back", P::message, 5.0, 5.0},
    {K::sides_wrong, "sides_wrong", P::message, 5.0, 10.0, F::other, A::nothing, true},
    {K::which_side, "which_side", P::message, 2.0, 5.0},
    {K::press, "press_*", P::message, 2.0, 5.0, F::other, A::begin, false, T::ready,
     {B::start, B::enter, B::pick, B::drop, B::scan}},
    {K::choose_goal, "choose_goal", P::message, 2.0, 5.0, F::other, A::nothing, false, T::ready},
    {K::trial_begins, "trial_begins", P::message, 1.0, 2.0, F::other, A::nothing, false,
     T::begun},
    {K::menu, "*", P::message, 0.0, 4.0, F::other, A::nothing, false, {},
     {B::goal_sure, B::menu_begin, B::menu_goals, B::menu_place, B::menu_glossary, B::menu_remember,
      B::menu_end, B::menu_end_sure, B::menu_empty, B::menu_settings, B::setting, B::setting_open,
      B::setting_changed, B::no_trial}},
    {K::menu_closed, "*", P::message, 0.0, 4.0, F::other, A::nothing, false, {},
     {B::menu_closed, B::goal_chosen, B::place_saved, B::place_no_file, B::place_no_pose}},
    {K::settings, "settings_*", P::message, 1.0, 10.0, F::other, A::nothing, false, {},
     {B::of, B::not_kept, B::not_saved}},
    {K::place_not_saved, "place_not_saved", P::message, 0.0, 10.0},
    {K::trial_ends, "trial_*", P::message, 5.0, 10.0, F::trial_end, A::nothing, true, T::stopped,
     {B::time_up, B::over}},
    // The way.
    {K::start, "start_*", P::text, 2.0, 10.0, F::other, A::ready, false, {},
     {B::none, B::distance}},
    {K::toward_goal, "toward_goal", P::text, 0.0, 10.0, F::other, A::ready},
    {K::goal_seen, "goal_seen", P::text, 0.0, 10.0, F::other, A::ready},
    {K::direction, "direction", P::text, 1.0, 1.0, F::way, A::turn},
    {K::straight, "straight_*", P::text, 1.0, 1.0, F::way, A::go, false, {}, {B::none, B::then}},
    {K::slight, "slight", P::text, 1.0, 1.0, F::way, A::turn},
    {K::turn_ahead, "turn_ahead", P::text, 2.0, 1.0, F::way, A::turn_ahead},
    {K::wrong_way, "wrong_way", P::message, 2.0, 1.0, F::route, A::turn},
    {K::off_path, "off_path", P::text, 2.0, 1.0, F::route},
    {K::turn_cancelled, "turn_cancelled", P::text, 1.0, 1.0, F::way, A::go},
    {K::push, "push", P::text, 2.0, 1.0, F::way, A::go},
    {K::rerouted, "rerouted_*", P::text, 4.0, 1.0, F::route, A::turn, false, T::rerouted,
     {B::none, B::blocked}},
    {K::new_route, "*", P::message, 4.0, 1.0, F::other, A::nothing, false, T::rerouted,
     {B::new_route, B::way_blocked}},
    {K::near, "*_near", P::text, 1.5, 1.0, F::other, A::beware, false, {},
     {B::shelf, B::wall, B::obstacle}},
    {K::close, "*_close", P::text, 1.5, 1.0, F::other, A::beware, false, {},
     {B::shelf, B::wall, B::obstacle}},
    // On demand, and by the way.
    {K::goal_info, "goal_info_*", P::text, 0.5, 1.0, F::other, A::nothing, false, {},
     {B::none, B::distance}},
    {K::around, "around_*", P::text, 0.5, 1.0, F::other, A::nothing, false, {},
     {B::none, B::side}},
    {K::stops_before, "stops_before", P::text, 0.5, 1.0},
    {K::where, "where_*", P::text, 0.5, 1.0, F::other, A::nothing, false, {}, {B::none, B::goal}},
    {K::answer, "*", P::text, 0.5, 4.0, F::other, A::nothing, false, {},
     {B::no_goal, B::around_nothing, B::where_place}},
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
/// A thing within reach.
[[nodiscard]] constexpr bool is_near(CueKind kind) {
  return kind == CueKind::near || kind == CueKind::close;
}

/// A sentence without its fillings: two that differ in what they are about are two, also to rules
/// that keep one of a kind. Compared with a kind alone, it is any sentence of that kind.
struct Content {
  // NOLINTNEXTLINE(google-explicit-constructor): most kinds have one sentence
  constexpr Content(CueKind of = CueKind::lesson, About what = About::none)
      : kind(of), about(what) {}
  CueKind kind;
  About about;

  [[nodiscard]] friend constexpr bool operator==(const Content& a, const Content& b) {
    return a.kind == b.kind && a.about == b.about;
  }
  [[nodiscard]] friend constexpr bool operator!=(const Content& a, const Content& b) {
    return !(a == b);
  }
  [[nodiscard]] friend constexpr bool operator<(const Content& a, const Content& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.about < b.about;
  }
  [[nodiscard]] friend constexpr bool operator==(const Content& a, CueKind b) { return a.kind == b; }
  [[nodiscard]] friend constexpr bool operator!=(const Content& a, CueKind b) { return a.kind != b; }
};

/// All that the guide says, without lessons.
[[nodiscard]] std::vector<Content> contents();

/// In messages, phrases and records: the kind's word with what the sentence is about, such as
/// "shelf_near"; or "near", for all that it may be about.
[[nodiscard]] std::string to_string(const Content& content);
/// The inverse.
template <>
[[nodiscard]] std::optional<Content> from_word<Content>(const std::string& word);

}  // namespace navvi_types
