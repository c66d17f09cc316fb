#include "status/status.hpp"

#include <algorithm>
#include <navvi_config/reader.hpp>
#include <navvi_types/spoken.hpp>
#include <set>

namespace navvi_rviz::status {
namespace {

using navvi_types::Guidance;

constexpr double kFresh = 1.0;     // s, after which a robot that fell silent has no speed
constexpr double kNoSound = 10.0;  // s, for which "no sound" hides the way
constexpr double kRead = 4.0;      // s, that what was said stays to be read

using navvi_types::CueKind;

/// The menu is closed, by itself or by what was chosen.
bool closes(CueKind kind) {
  return kind == CueKind::menu_closed || kind == CueKind::place_not_saved ||
         kind == CueKind::goal_refused || kind == CueKind::lesson;
}

Shown::Tone tone_of(CueKind kind) {
  static const std::set<CueKind> waits = {CueKind::blocked,    CueKind::make_room,
                                          CueKind::which_side, CueKind::press,
                                          CueKind::choose_goal, CueKind::lesson};
  if (kind == CueKind::arrived) return Shown::Tone::good;
  return waits.count(kind) > 0 ? Shown::Tone::wait : Shown::Tone::alarm;
}

}  // namespace

Words::Words(const std::filesystem::path& phrases, std::string units) : units_(std::move(units)) {
  const YAML::Node root = navvi_config::load_yaml(phrases);
  for (const char* section : {"phrases", "words", "picture", "lessons"})
    if (const YAML::Node texts = root[section]; texts && texts.IsMap())
      for (const auto& text : texts)
        if (text.second.IsScalar())
          texts_[std::string(section) + "/" + text.first.Scalar()] = text.second.Scalar();
}

std::string Words::of(const std::string& key) const {
  const auto found = texts_.find(key);
  return found == texts_.end() ? "" : found->second;
}

std::string Words::said(navvi_types::CueKind kind, bool keyboard) const {
  const std::string place = "{stick}";
  std::string text = of("phrases/" + to_string(kind));
  if (const std::size_t at = text.find(place); at != std::string::npos)
    text.replace(at, place.size(), of(keyboard ? "words/key_stick" : "words/pad_stick"));
  return text;
}

std::optional<navvi_types::ThingClass> Words::mover_in(const std::string& text) const {
  using navvi_types::ThingClass;
  for (const ThingClass mover : {ThingClass::worker, ThingClass::forklift,
                                 ThingClass::pallet_robot, ThingClass::other}) {
    const std::string word = of(std::string("words/") + to_string(mover));
    if (!word.empty() && text.find(word) != std::string::npos) return mover;
  }
  return std::nullopt;
}

std::string Words::to_go(double metres) const {
  const auto length = navvi_types::spoken_length(metres, units_);
  return length.number + " " + of(std::string("words/") + length.unit) + " " + of("picture/to_go");
}

Shown SteadyBanner::hold(Shown shown, double time) {
  constexpr double kLeast = 0.35;  // s
  const bool changed = !last_ || shown.banner != last_->banner || shown.tone != last_->tone;
  if (changed && last_ && time - since_ < kLeast) {
    shown.banner = last_->banner;
    shown.tone = last_->tone;
    shown.mover = last_->mover;
  } else if (changed) {
    since_ = time;
    last_ = shown;
  }
  return shown;
}

void Status::take(const navvi_types::CueEvent& cue, double time) {
  using navvi_types::CueStage;
  if (!cue.kind()) return;
  const CueKind kind = *cue.kind();
  // The menu goes on, also where its word comes too late to be spoken.
  if (cue.stage == CueStage::queued && kind == CueKind::menu) menu_ = cue.text;
  if (cue.stage == CueStage::queued && closes(kind) && cue.word() != "help") menu_.clear();
  // Where nothing can be heard, what would have been is dropped.
  if (cue.stage != CueStage::started && !(silent_ && cue.stage == CueStage::dropped)) return;
  last_ = Said{kind, cue.text, time};
}

void Status::take_order(const navvi_types::CueEvent& order) {
  order_ = Order{};
  if (order.kind() && order.stage == navvi_types::CueStage::started)
    order_ = Order{*order.kind(), order.text};
}

void Status::take(const navvi_types::TrialState& state) {
  if (trial_ != state.state) menu_.clear();
  trial_ = state.state;
  if (trial_ != navvi_types::TrialState::State::running || state.stamp == 0) return;
  begun_ = 1e-9 * static_cast<double>(state.stamp);
  ended_.reset();
}

void Status::take(const Guidance& guidance, double time) {
  if (guidance_ && guidance_->state == Guidance::State::arrived &&
      guidance.state != Guidance::State::arrived)
    last_.reset();
  guidance_ = guidance;
  guided_ = time;
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

/// What was said is soon no longer true: of the way the order is shown at once, after all else as
/// soon as that was read.
std::string Status::instruction(double time) const {
  if (!last_) return order_ ? order_->text : "";
  const bool way = is_way(family_of(last_->kind));
  const bool read = time - last_->time >= kRead;
  if (order_ && (way || (read && !order_->text.empty()))) return order_->text;
  return last_->text;
}

/// The order, but for the way, and that the wheels stand, unless the guide knows why.
void Status::choose_banner(double time, Shown& shown) const {
  const auto show = [&](const std::string& text, Shown::Tone tone) {
    if (!shown.banner.empty() || text.empty()) return;
    shown.banner = text;
    shown.tone = tone;
  };
  const navvi_types::CueTraits& ordered = traits(order_ ? order_->kind : CueKind::lesson);
  const bool why =
      ordered.ask == navvi_types::Ask::halt && ordered.priority == navvi_types::Priority::important;
  if (gate_ == navvi_types::DriveState::State::stopped && !why)
    show(words_.said(CueKind::robot_stopped, keyboard_), Shown::Tone::alarm);
  if (order_ && family_of(order_->kind) != navvi_types::CueFamily::way)
    show(order_->text, tone_of(order_->kind));
  shown.mover = words_.mover_in(shown.banner);
  if (silent_ && time - *silent_ < kNoSound) show(words_.of("picture/no_sound"), Shown::Tone::wait);
}

Shown Status::shown(double time, double ros_time) const {
  Shown shown;
  choose_banner(time, shown);
  shown.instruction = instruction(time);
  shown.menu = menu_;
  if (guidance_ && guidance_->leads() && !guidance_->ends_short && time - guided_ < kFresh)
    shown.distance = words_.to_go(guidance_->goal_distance);
  if (speed_ && time - speed_->second < kFresh) shown.speed = speed_->first;
  if (begun_) shown.clock = std::max(0.0, ended_.value_or(ros_time) - *begun_);
  shown.sound = !silent_;
  return shown;
}

}  // namespace navvi_rviz::status
