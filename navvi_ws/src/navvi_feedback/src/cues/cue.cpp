#include "navvi_feedback/cues/cue.hpp"

#include <stdexcept>

namespace navvi_feedback::cues {

const std::vector<CueKind>& cue_kinds() {
  using P = Priority;
  using F = Family;
  // kind, priority, least interval in s, largest age in s, family
  static const std::vector<CueKind> kinds = {
      // Safety: nothing cuts these. Each thing that is hit has its own cue, see CuePolicy.
      {"collision_shelf", P::important, 0.0, 3.0, F::hit},
      {"collision_wall", P::important, 0.0, 3.0, F::hit},
      {"collision_obstacle", P::important, 0.0, 3.0, F::hit},
      {"obstacle_stop", P::important, 3.0, 1.0, F::halt},
      {"pad_lost", P::important, 2.0, 10.0},
      {"keyboard_lost", P::important, 2.0, 10.0},
      {"robot_stopped", P::important, 2.0, 4.0},
      {"simulator_lost", P::important, 5.0, 10.0},
      {"proximity_lost", P::important, 5.0, 10.0},
      {"guidance_lost", P::important, 5.0, 5.0},
      {"record_lost", P::important, 5.0, 10.0},
      {"trial_disk_full", P::important, 5.0, 10.0},
      // What the person must act on now.
      {"stuck", P::message, 2.0, 1.0},
      {"stuck_unknown", P::message, 2.0, 2.0},
      {"arrived", P::message, 1.0, 10.0},
      {"turn_now", P::message, 1.0, 1.0, F::route},
      {"no_route", P::message, 5.0, 5.0},
      {"off_mesh", P::message, 5.0, 5.0},
      {"no_map", P::message, 5.0, 5.0},
      {"pose_stale", P::message, 5.0, 5.0},
      {"map_stale", P::message, 5.0, 5.0},
      {"blocked", P::message, 3.0, 1.0, F::halt},
      {"obstacle_comes", P::message, 1.5, 1.0},
      {"back_away", P::message, 2.0, 1.0},
      {"go_on", P::message, 1.0, 2.0},
      {"make_room", P::message, 1.0, 1.0, F::route},
      {"goal_refused_not_finite", P::message, 1.0, 10.0},
      {"goal_refused_unknown_frame", P::message, 1.0, 10.0},
      {"goal_refused_inside_obstacle", P::message, 1.0, 10.0},
      {"goal_refused_off_the_map", P::message, 1.0, 10.0},
      {"goal_refused_unreachable", P::message, 1.0, 10.0},
      {"release_stick", P::message, 2.0, 2.0},
      {"intruder", P::message, 5.0, 10.0},
      {"machine_slow", P::message, 5.0, 10.0},
      {"two_drivers", P::message, 5.0, 10.0},
      {"pad_back", P::message, 2.0, 5.0},
      {"keyboard_back", P::message, 2.0, 5.0},
      {"audio_back", P::message, 2.0, 5.0},
      {"no_rumble", P::message, 5.0, 10.0},
      {"second_pad", P::message, 5.0, 10.0},
      {"press_start", P::message, 2.0, 5.0},
      {"press_enter", P::message, 2.0, 5.0},
      {"choose_goal", P::message, 2.0, 5.0},
      {"trial_begins", P::message, 1.0, 2.0},
      {"goal_chosen", P::message, 0.0, 4.0},
      {"goal_sure", P::message, 0.0, 4.0},
      {"menu_begin", P::message, 0.0, 4.0},
      {"menu_goals", P::message, 0.0, 4.0},
      {"menu_place", P::message, 0.0, 4.0},
      {"menu_glossary", P::message, 0.0, 4.0},
      {"menu_end", P::message, 0.0, 4.0},
      {"menu_end_sure", P::message, 0.0, 4.0},
      {"menu_empty", P::message, 0.0, 4.0},
      {"menu_closed", P::message, 0.0, 4.0},
      {"no_trial", P::message, 0.0, 4.0},
      {"menu_settings", P::message, 0.0, 4.0},
      {"setting", P::message, 0.0, 4.0},
      {"setting_open", P::message, 0.0, 4.0},
      {"setting_changed", P::message, 0.0, 4.0},
      {"settings_of", P::message, 1.0, 10.0},
      {"settings_not_kept", P::message, 1.0, 10.0},
      {"settings_not_saved", P::message, 1.0, 10.0},
      {"trial_time_up", P::message, 5.0, 10.0},
      {"trial_over", P::message, 5.0, 10.0},
      {"pad_firmware", P::message, 5.0, 10.0},
      // The way.
      {"start", P::text, 2.0, 10.0},
      {"start_distance", P::text, 2.0, 10.0},
      {"direction", P::text, 1.0, 1.0, F::way},
      {"straight", P::text, 1.0, 1.0, F::way},
      {"slight", P::text, 1.0, 1.0, F::way},
      {"straight_then", P::text, 1.0, 1.0, F::way},
      {"turn_ahead", P::text, 2.0, 1.0, F::way},
      {"wrong_way", P::message, 2.0, 1.0, F::route},
      {"off_path", P::text, 2.0, 1.0, F::route},
      {"turn_cancelled", P::text, 1.0, 1.0, F::way},
      {"rerouted", P::text, 4.0, 1.0, F::route},
      {"rerouted_blocked", P::text, 4.0, 1.0, F::route},
      {"new_route", P::message, 4.0, 1.0},
      {"way_blocked", P::message, 4.0, 1.0},
      {"shelf_near", P::text, 1.5, 1.0, F::near},
      {"wall_near", P::text, 1.5, 1.0, F::near},
      {"shelf_close", P::text, 1.5, 1.0, F::near},
      {"wall_close", P::text, 1.5, 1.0, F::near},
      {"obstacle_near", P::text, 1.5, 1.0, F::near},
      {"obstacle_close", P::text, 1.5, 1.0, F::near},
      // On demand, and by the way.
      {"goal_info", P::text, 0.5, 1.0},
      {"goal_info_distance", P::text, 0.5, 1.0},
      {"no_goal", P::text, 0.5, 4.0},
      {"around", P::text, 0.5, 1.0},
      {"where", P::text, 0.5, 1.0},
      {"where_place", P::text, 0.5, 4.0},
      {"where_goal", P::text, 0.5, 1.0},
      {"help_pad", P::text, 0.5, 4.0},
      {"help_keys", P::text, 0.5, 4.0},
      {"around_nothing", P::text, 0.5, 4.0},
      {"welcome", P::notification, 5.0, 10.0},
  };
  return kinds;
}

namespace {

const CueKind* find(const std::string& kind) {
  for (const CueKind& known : cue_kinds())
    if (kind == known.kind) return &known;
  return nullptr;
}

}  // namespace

const CueKind& cue_kind(const std::string& kind) {
  if (const CueKind* const known = find(kind)) return *known;
  throw std::logic_error("\"" + kind + "\" is no kind of cue.");
}

Family family_of(const std::string& kind) {
  const CueKind* const known = find(kind);
  return known ? known->family : Family::other;
}

}  // namespace navvi_feedback::cues
