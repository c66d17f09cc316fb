#include "status/status.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_rviz::status {
namespace {

using navvi_types::Guidance;

// s; "stop" and "wait" hold until a word follows, but not for ever; nor does "no sound" hide the
// way.
constexpr double kHeld = 10.0;
constexpr double kShown = 4.0;  // s, of other warnings

using navvi_types::Banner;
using navvi_types::CueFamily;
using navvi_types::CueKind;

/// A word that the way goes on.
bool releases(CueKind kind) {
  switch (kind) {
    case CueKind::direction:
    case CueKind::straight:
    case CueKind::slight:
    case CueKind::straight_then:
    case CueKind::turn_now:
    case CueKind::rerouted:
    case CueKind::rerouted_blocked:
      return true;
    default:
      return false;
  }
}

/// The menu is closed, by itself or by what was chosen.
bool closes(CueKind kind) {
  return family_of(kind) == CueFamily::menu_end || kind == CueKind::lesson;
}

/// The cue whose words the banner shows of a state; nullopt for other words, or none.
std::optional<CueKind> said_of(Guidance::State state) {
  switch (state) {
    case Guidance::State::no_route:
      return CueKind::no_route;
    case Guidance::State::off_mesh:
      return CueKind::off_mesh;
    case Guidance::State::no_map:
      return CueKind::no_map;
    case Guidance::State::pose_stale:
      return CueKind::pose_stale;
    case Guidance::State::map_stale:
      return CueKind::map_stale;
    case Guidance::State::no_goal:
    case Guidance::State::following:
    case Guidance::State::arrived:
    case Guidance::State::blocked:
    case Guidance::State::make_room:
    case Guidance::State::goal_refused:
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

void Status::take(const navvi_types::CueEvent& cue, double time) {
  using navvi_types::CueStage;
  if (!cue.kind()) return;
  const CueKind kind = *cue.kind();
  // The menu goes on, also where its word comes too late to be spoken.
  if (cue.stage == CueStage::queued && family_of(kind) == CueFamily::menu) menu_ = cue.text;
  if (cue.stage == CueStage::queued && closes(kind)) menu_.clear();
  // Where nothing can be heard, what would have been is dropped.
  if (cue.stage != CueStage::started && !(silent_ && cue.stage == CueStage::dropped)) return;
  last_ = Said{kind, cue.text, time};
  if (traits(kind).banner != Banner::none) warning_ = last_;
  if (releases(kind) && warning_ && traits(warning_->kind).banner == Banner::held) warning_.reset();
  if (kind == CueKind::pad_lost || kind == CueKind::keyboard_lost) lost_ = cue.text;
  if (kind == CueKind::pad_back || kind == CueKind::keyboard_back) lost_.clear();
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
  return age < (traits(warning_->kind).banner == Banner::held ? kHeld : kShown) ? warning_
                                                                                : std::nullopt;
}

/// What was said is soon no longer true: of the way the plate's words are shown at once, after all
/// else as soon as that was read.
std::string Status::instruction(double time) const {
  if (!last_) return "";
  const bool leads = guidance_ && guidance_->leads();
  const bool read = time - last_->time >= kShown;
  if (family_of(last_->kind) == CueFamily::way && !turn_.empty()) return turn_;
  return leads && read ? turn_ : last_->text;
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
    show(words_.said(CueKind::robot_stopped, keyboard_), Tone::alarm);
  show(lost_, Tone::alarm);
  if (const auto said = warning(time))
    show(said->text, said->kind == CueKind::blocked || said->kind == CueKind::make_room
                         ? Tone::wait
                         : Tone::alarm);
  using Trial = navvi_types::TrialState::State;
  if (trial_ == Trial::ready)
    show(words_.said(keyboard_ ? CueKind::press_enter : CueKind::press_start, keyboard_),
         Tone::wait);
  if (trial_ == Trial::choose_goal) show(words_.said(CueKind::choose_goal, keyboard_), Tone::wait);
  if (!guidance_) return;
  const auto state = guidance_->state;
  if (state == Guidance::State::blocked) show(words_.of("picture/wait"), Tone::wait);
  if (state == Guidance::State::make_room) show(words_.of("picture/make_room"), Tone::wait);
  if (state == Guidance::State::arrived) show(words_.of("picture/arrived"), Tone::good);
  if (state == Guidance::State::goal_refused) show(words_.of("picture/goal_refused"), Tone::alarm);
  if (const auto kind = said_of(state)) show(words_.said(*kind, keyboard_), Tone::alarm);
  if (silent_ && time - *silent_ < kHeld) show(words_.of("picture/no_sound"), Tone::wait);
}

Shown Status::shown(double time, double ros_time) const {
  Shown shown;
  choose_banner(time, shown);
  shown.instruction = instruction(time);
  shown.menu = menu_;
  if (guidance_ && guidance_->leads() && !guidance_->ends_short)
    shown.distance = words_.to_go(guidance_->goal_distance);
  shown.speed = std::abs(speed_);
  if (begun_) shown.clock = std::max(0.0, ended_.value_or(ros_time) - *begun_);
  shown.sound = !silent_;
  return shown;
}

}  // namespace navvi_rviz::status
