#include "navvi_feedback/lockstep/guide.hpp"

#include <navvi_types/stall_guard.hpp>
#include <utility>

#include "core/feedback.hpp"
#include "cues/cue_queue.hpp"
#include "cues/heard_words.hpp"
#include "haptics/rumble_output.hpp"
#include "lockstep/events.hpp"
#include "lockstep/guide_values.hpp"

namespace navvi_feedback::lockstep {

using core::Feedback;

GuideConfig::GuideConfig() : values_(std::make_unique<Values>()) {}
GuideConfig::GuideConfig(const GuideConfig& other)
    : values_(std::make_unique<Values>(*other.values_)) {}
GuideConfig& GuideConfig::operator=(const GuideConfig& other) {
  *values_ = *other.values_;
  return *this;
}
GuideConfig::~GuideConfig() = default;

void GuideConfig::describe(navvi_config::Visitor& visit) { values_->describe(visit); }
bool GuideConfig::has_sounds() const { return values_->sounds.enabled; }
std::string GuideConfig::lead(bool audible) const {
  const haptics::HapticsConfig& touch = values_->haptics;
  return !audible && touch.enabled && touch.instead_of_words ? "hand" : values_->lead;
}

struct Guide::Parts {
  Parts(const core::FeedbackConfig& config, const std::filesystem::path& phrases)
      : feedback(config, phrases) {}

  Feedback feedback;
  cues::CueQueue queue;
  cues::HeardWords heard_words;
  haptics::RumbleOutput rumble_output, flow_output;
  navvi_types::StallGuard stall;
  std::vector<CueKind> news;  ///< not said yet
  bool runs = false;          ///< a trial
  bool told_to_run = false;   ///< by its last state, which is repeated
  bool last_words = false;    ///< it has ended, which is told
  std::uint32_t rumbles = 0;  ///< so far, as are
  std::uint32_t sounds = 0;

  void move_motors(const haptics::Rumble& rumble, std::optional<haptics::Pattern> pattern,
                   bool somebody_feels, double time, Output& out) {
    const haptics::RumbleOutput::Due due = rumble_output.update(rumble, time);
    out.rumble = rumble;
    out.rumble_due = due.feedback;
    out.rumble_moved = due.moved;
    // The record holds what can have been felt.
    if (due.changed && somebody_feels) out.felt = rumble_event(rumble, pattern, ++rumbles);
    if (flow_output.update(out.flow, time).changed) out.flowed = flow_event(out.flow, ++sounds);
  }
};

namespace {

/// Where no words are wanted, there are none in the record.
std::vector<CueEvent> as_heard(cues::HeardWords& words, const std::vector<CueEvent>& events,
                               const Devices& devices) {
  if (!devices.words) return {};
  return words.of(events, devices.sounds);
}

}  // namespace

Guide::Guide(const GuideConfig& config, const std::filesystem::path& phrases)
    : parts_(std::make_unique<Parts>(*config.operator->(), phrases)) {}
Guide::~Guide() = default;

void Guide::take(const navvi_types::Proximity& proximity, double time) {
  parts_->feedback.take(proximity, time);
}
void Guide::take(const navvi_types::Guidance& guidance, double time) {
  parts_->feedback.take(guidance, time);
}
void Guide::take(const navvi_types::DriveState& state, double time) {
  parts_->feedback.take(state, time);
}
void Guide::take(const navvi_types::TrialState& state, double time) {
  const bool runs = state.state == TrialState::State::running;
  if (runs && !parts_->told_to_run) {
    parts_->runs = true;
    parts_->last_words = false;
  }
  parts_->told_to_run = runs;
  parts_->feedback.take(state, time);
}
void Guide::take(const navvi_types::Odometry& odometry, double time) {
  parts_->feedback.take(odometry, time);
}
void Guide::take(const navvi_types::Scenario& scenario, double time) {
  parts_->feedback.take(scenario, time);
}
void Guide::take(const navvi_types::Contact& contact) { parts_->feedback.take(contact); }
void Guide::take_goal(const Eigen::Vector2d& goal) { parts_->feedback.take_goal(goal); }
void Guide::take_place(const Eigen::Vector2d& at) { parts_->feedback.take_place(at); }
void Guide::offer(const std::map<std::string, std::string>& values) {
  parts_->feedback.take_settings(values);
}
void Guide::use(const GuideConfig& config) { parts_->feedback.use(*config.operator->()); }

void Guide::announce(CueKind kind) { parts_->news.push_back(kind); }

void Guide::end_trial(std::optional<CueKind> words) {
  parts_->runs = false;
  if (!words) return;
  announce(*words);
  parts_->last_words = true;
}

std::optional<Output> Guide::update(const Devices& devices, double time) {
  if (parts_->stall.catches_up(time)) return std::nullopt;
  Devices now = devices;
  now.states.insert(now.states.end(), parts_->news.begin(), parts_->news.end());
  parts_->news.clear();
  const Feedback::Decided decided = parts_->feedback.update(now, !parts_->queue.empty(), time);
  Output out = decided;
  parts_->move_motors(decided.rumble, decided.pattern, devices.felt, time, out);
  const cues::CueQueue::Step step = parts_->queue.update(decided.cues, devices.speaking, time);
  parts_->feedback.note(step.events);
  out.voice = step;
  out.said = as_heard(parts_->heard_words, step.events, devices);
  return out;
}

bool Guide::end_session() {
  if (parts_->runs) end_trial(CueKind::trial_over);
  return !parts_->news.empty();
}

bool Guide::has_last_words() const { return parts_->last_words && !parts_->queue.empty(); }

Output Guide::hear_out(const Devices& devices, double time) {
  const cues::CueQueue::Step step = parts_->queue.update({}, devices.speaking, time);
  parts_->feedback.note(step.events);
  Output out;
  parts_->move_motors({}, std::nullopt, devices.felt, time, out);
  out.voice = step;
  out.said = as_heard(parts_->heard_words, step.events, devices);
  return out;
}

Output Guide::finish(const Devices& devices) {
  const cues::CueQueue::Step step = parts_->queue.clear();
  Output out;
  out.voice = step;
  out.said = as_heard(parts_->heard_words, step.events, devices);
  return out;
}

CueEvent Guide::event_of(const sounds::Play& play) { return sound_event(play, ++parts_->sounds); }

std::optional<CueEvent> Guide::order() const {
  const auto order = parts_->feedback.order();
  if (!order) return std::nullopt;
  return CueEvent{0, CueStage::started, navvi_types::Spoken(order->kind, order->lesson),
                  order->text, order->priority};
}

std::optional<sounds::Learnt> Guide::learnt() const { return parts_->feedback.learnt(); }

const std::optional<navvi_types::Guidance>& Guide::guidance() const {
  return parts_->feedback.guidance();
}

bool Guide::guidance_fresh(double time) const { return parts_->feedback.guidance_fresh(time); }

}  // namespace navvi_feedback::lockstep
