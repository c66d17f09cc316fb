#include "status/status.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace navvi_rviz::status {
namespace {

using navvi_types::Guidance;

// s; "stop" and "wait" hold until a word follows, but not for ever; nor does "no sound" hide the
// way.
constexpr double kHeld = 10.0;
constexpr double kShown = 4.0;  // s, of other warnings

/// Cues that hold until the next word about the way.
const std::set<std::string> kHolding = {"obstacle_stop", "blocked"};
const std::set<std::string> kWarnings = {"collision_shelf", "collision_wall", "collision_obstacle",
                                         "obstacle_stop",   "blocked",        "back_away",
                                         "off_mesh",        "stuck",          "stuck_unknown",
                                         "make_room",       "release_stick",  "trial_time_up",
                                         "trial_disk_full", "trial_over",     "proximity_lost",
                                         "simulator_lost",  "guidance_lost",  "no_route",
                                         "record_lost"};
/// Cues that say that the way goes on.
const std::set<std::string> kReleasing = {
    "direction", "straight", "slight", "straight_then", "turn_now", "rerouted", "rerouted_blocked"};

/// What the spoken menu says while it is open, and what closes it.
bool offers(const std::string& kind) {
  static const std::set<std::string> others = {"goal_sure", "setting", "setting_open",
                                               "setting_changed"};
  return (kind.rfind("menu_", 0) == 0 && kind != "menu_closed") || others.count(kind) > 0;
}
bool closes(const std::string& kind) {
  return kind == "menu_closed" || kind == "goal_chosen" || kind.rfind("glossary", 0) == 0;
}

/// States that are said in words of their own.
bool said_as_state(Guidance::State state) {
  return state == Guidance::State::no_route || state == Guidance::State::off_mesh ||
         state == Guidance::State::no_map || state == Guidance::State::pose_stale ||
         state == Guidance::State::map_stale;
}

}  // namespace

void Status::take(const navvi_types::CueEvent& cue, double time) {
  using navvi_types::CueStage;
  if (cue.modality != navvi_types::Modality::speech) return;
  // The menu goes on, also where its word comes too late to be spoken.
  if (cue.stage == CueStage::queued && offers(cue.kind)) menu_ = cue.text;
  if (cue.stage == CueStage::queued && closes(cue.kind)) menu_.clear();
  // Where nothing can be heard, what would have been is dropped.
  if (cue.stage != CueStage::started && !(silent_ && cue.stage == CueStage::dropped)) return;
  last_ = Said{cue.kind, cue.text, time};
  if (kWarnings.count(cue.kind) > 0) warning_ = last_;
  if (kReleasing.count(cue.kind) > 0 && warning_ && kHolding.count(warning_->kind) > 0)
    warning_.reset();
  if (cue.kind == "pad_lost" || cue.kind == "keyboard_lost") lost_ = cue.text;
  if (cue.kind == "pad_back" || cue.kind == "keyboard_back") lost_.clear();
}

void Status::take(const navvi_types::TrialState& state) {
  if (trial_ != state.state) menu_.clear();
  trial_ = state.state;
  if (trial_ != navvi_types::TrialState::State::running || state.stamp == 0) return;
  begun_ = 1e-9 * static_cast<double>(state.stamp);
  ended_.reset();
}

void Status::take(const Guidance& guidance) {
  if (guidance_ && guidance_->state == Guidance::State::arrived &&
      guidance.state != Guidance::State::arrived)
    last_.reset();
  guidance_ = guidance;
}

void Status::take_event(const std::string& type, double ros_time) {
  if (type == "TRIAL_START") {
    begun_ = ros_time;
    ended_.reset();
  }
  if (type == "TRIAL_END") ended_ = ros_time;
}

void Status::take_device(const std::string& name, const std::string& state, double time) {
  if (name != "navvi/audio") return;
  if (state != "missing")
    silent_.reset();
  else if (!silent_)
    silent_ = time;
}

std::optional<Status::Said> Status::warning(double time) const {
  if (!warning_) return std::nullopt;
  const double age = time - warning_->time;
  return age < (kHolding.count(warning_->kind) > 0 ? kHeld : kShown) ? warning_ : std::nullopt;
}

/// The first that applies, most urgent first.
void Status::choose_banner(double time, Shown& shown) const {
  using Tone = Shown::Tone;
  const auto show = [&](const std::string& text, Tone tone) {
    if (!shown.banner.empty() || text.empty()) return;
    shown.banner = text;
    shown.tone = tone;
  };
  if (gate_ == navvi_types::DriveState::State::stopped)
    show(words_.said("robot_stopped", keyboard_), Tone::alarm);
  show(lost_, Tone::alarm);
  if (const auto said = warning(time))
    show(said->text,
         said->kind == "blocked" || said->kind == "make_room" ? Tone::wait : Tone::alarm);
  using Trial = navvi_types::TrialState::State;
  if (trial_ == Trial::ready)
    show(words_.said(keyboard_ ? "press_enter" : "press_start", keyboard_), Tone::wait);
  if (trial_ == Trial::choose_goal) show(words_.said("choose_goal", keyboard_), Tone::wait);
  if (!guidance_) return;
  const auto state = guidance_->state;
  if (state == Guidance::State::blocked) show(words_.of("picture/wait"), Tone::wait);
  if (state == Guidance::State::make_room) show(words_.of("picture/make_room"), Tone::wait);
  if (state == Guidance::State::arrived) show(words_.of("picture/arrived"), Tone::good);
  if (state == Guidance::State::goal_refused) show(words_.of("picture/goal_refused"), Tone::alarm);
  if (said_as_state(state)) show(words_.said(to_string(state), keyboard_), Tone::alarm);
  if (silent_ && time - *silent_ < kHeld) show(words_.of("picture/no_sound"), Tone::wait);
}

Shown Status::shown(double time, double ros_time) const {
  Shown shown;
  choose_banner(time, shown);
  if (last_) shown.instruction = last_->text;
  shown.menu = menu_;
  if (guidance_ && guidance_->leads()) shown.distance = guidance_->goal_distance;
  shown.speed = std::abs(speed_);
  if (begun_) shown.clock = std::max(0.0, ended_.value_or(ros_time) - *begun_);
  shown.sound = !silent_;
  return shown;
}

}  // namespace navvi_rviz::status
