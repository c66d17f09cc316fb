#include "core/feedback.hpp"

#include <algorithm>
#include <cmath>

#include "core/auditory_display.hpp"
#include "core/haptic_display.hpp"
#include "cues/cue_policy.hpp"
#include "lessons/teacher.hpp"
#include "menu/menu.hpp"

namespace navvi_feedback::core {
namespace {

constexpr double kLongestTick = 0.1;  // s; a longer delay is not made up for
constexpr double kIdle = 6.0;         // s; who does not drive for so long needs no ticks to turn by
constexpr double kPi = 3.14159265358979323846;

/// The smallest place that holds the point.
std::optional<navvi_types::Place> place_at(const std::optional<Scenario>& scenario,
                                           const Eigen::Vector2d& point) {
  std::optional<navvi_types::Place> found;
  if (!scenario) return found;
  for (const navvi_types::Place& place : scenario->places)
    if (place.area.contains(point) && (!found || place.area.volume() < found->area.volume()))
      found = place;
  return found;
}

constexpr double kRecordLost = 2.0;  // s; a slow disk holds trial_node up for less

bool deflected(const drive::Stick& stick) { return stick.x != 0.0 || stick.y != 0.0; }

}  // namespace

void FeedbackConfig::describe(navvi_config::Visitor& visit) {
  visit(stale, "stale", navvi_config::Range{0.2, 10.0}, "s",
        "guidance, proximity or odometry older than this (wall clock) is lost");
  visit.group("drive", drive);
  visit.group("buttons", buttons);
  visit.group("haptics", haptics);
  visit.group("sounds", sounds);
  visit.group("cues", cues);
}

struct Feedback::Deciders {
  Deciders(const FeedbackConfig& config, const cues::Phrases& phrases)
      : drive(config.drive),
        assistance(config.drive.assistance),
        buttons(config.buttons),
        touch(config.haptics),
        sounds(config.sounds),
        cues(config.cues, phrases),
        teacher(config.lesson, phrases, config.buttons, config.haptics, config.sounds,
                0.5 * config.drive.max_turn / config.drive.turn_acceleration, config.questions) {
    menu.lock(config.locked);
  }

  drive::Drive drive;
  drive::Assistance assistance;
  drive::Buttons buttons;
  HapticDisplay touch;
  AuditoryDisplay sounds;
  cues::CuePolicy cues;
  menu::Menu menu;
  lessons::Teacher teacher;
};

Feedback::Feedback(const FeedbackConfig& config, const std::filesystem::path& phrases)
    : config_(config),
      deciders_(new Deciders(config, cues::Phrases(phrases, config.cues.wording))) {}

Feedback::~Feedback() = default;

void Feedback::note(const std::vector<CueEvent>& events) {
  deciders_->cues.note(events);
  for (const CueEvent& event : events) {
    const auto* const spoken = std::get_if<navvi_types::Spoken>(&event.what);
    if (event.stage == CueStage::started && spoken) begun_.push_back(spoken->lesson);
    if (event.stage == CueStage::started && event.priority == Priority::important)
      important_ = event.id;
    else if (event.id == important_ && event.stage != CueStage::queued)
      important_.reset();
  }
}

Feedback::Output Feedback::update(const Input& input, double time) {
  const double dt = std::clamp(time - last_update_.value_or(time), 0.0, kLongestTick);
  last_update_ = time;
  seen_hands_ = seen_hands_ || input.hands.live;
  auto& [drive, assistance, buttons, touch, sounds, cues, menu, teacher] = *deciders_;
  touch.use_pad(input.pad);
  Output out;
  out.command = command(input.hands, dt);
  out.share = assist(out.command, time);
  out.alarm_begins = touch.report(input.audio, input.motors);
  std::vector<drive::Button> pressed = buttons.update(input.hands);
  pressed.insert(pressed.end(), input.asked.begin(), input.asked.end());
  teach(input, pressed, time);
  const std::optional<cues::Utterance> answer = obey(pressed, input.pad, out);
  cues::Situation now = situation(input, pressed, answer, time);
  if (menu.pass(dt)) now.notices.push_back(CueKind::menu_closed);
  out.cues = cues.update(now, time);
  teacher.join(out.cues);
  touch.begin(out.cues, contacts_, teacher.taught());
  out.cues.erase(std::remove_if(out.cues.begin(), out.cues.end(),
                                [](const cues::Cue& cue) { return cue.felt; }),
                 out.cues.end());
  const bool drives = commanded_.linear != 0.0 || commanded_.angular != 0.0;
  idle_ = cues.leads() && !drives ? idle_ + dt : 0.0;
  if (motion_.value) turned_ += motion_.value->angular * dt;
  for (const sounds::Play& play : sounds.update(out.cues, sounds_now(input, time), time))
    out.plays.push_back(play);
  out.rumble = touch.update(near_now(time), teacher.taught(), important_.has_value(), dt);
  out.pattern = touch.playing();
  out.lesson_over = teacher.over();
  out.record = teacher.record();
  out.settings = teacher.settings();
  if (teacher.alone()) out.command.reset();
  begun_.clear();
  contacts_.clear();
  last_hands_ = input.hands;
  return out;
}

std::optional<Velocity> Feedback::command(const drive::InputState& hands, double dt) {
  // A device that was opened anew between two ticks was lost between them.
  const bool live = hands.live && (!last_hands_.live || hands.session == last_hands_.session);
  const int enable = config_.drive.enable;
  const bool enabled = enable < 0 || hands.button(static_cast<std::size_t>(enable));
  const lessons::Teacher& teacher = deciders_->teacher;
  const bool held = teacher.teaching() ? teacher.holds() : trial_.holds();
  if (held || !enabled) deciders_->drive.disarm();
  const drive::Stick stick = hands.stick(config_.drive.stick == "right");
  const std::optional<Velocity> velocity =
      deciders_->drive.update(live ? std::optional(stick) : std::nullopt, dt);
  commanded_ = velocity.value_or(Velocity{});
  held_unarmed_ =
      live && enabled && !deciders_->drive.armed() && deflected(deciders_->drive.shaped(stick));
  // The last command of a lost stick is zero; none follows it.
  return velocity || last_hands_.live ? std::optional(commanded_) : std::nullopt;
}

/// What the person asked for stays the measure of being stuck. \return the share that is left
double Feedback::assist(std::optional<Velocity>& command, double time) const {
  if (!command) return 1.0;
  const bool fresh = nearby_.link(time, config_.stale) == cues::Link::alive;
  const double share = deciders_->assistance.share(
      *command, nearby_.value.value_or(std::vector<NearThing>{}), fresh);
  command->linear *= share;
  const double turning = std::abs(command->angular);
  const double most = deciders_->sounds.most_rate().value_or(turning);
  if (turning <= most) return share;
  command->angular *= most / turning;
  return std::min(share, most / turning);
}

std::optional<double> Feedback::off_course(double time) const {
  if (deciders_->teacher.speaks()) return deciders_->teacher.taught().off;
  if (!guidance_fresh(time) || !deciders_->cues.leads() || idle_ > kIdle) return std::nullopt;
  return std::remainder(guidance_.value->steer_angle + turned_, 2.0 * kPi);
}

NearNow Feedback::near_now(double time) const {
  const bool arrived = guidance_.value && guidance_.value->state == Guidance::State::arrived;
  const bool fresh = nearby_.link(time, config_.stale) == cues::Link::alive &&
                     motion_.link(time, config_.stale) != cues::Link::lost &&
                     !(arrived && config_.haptics.rest_at_goal);
  const bool asked = others_.link(time, config_.stale) == cues::Link::alive;
  return {nearby_.value.value_or(std::vector<NearThing>{}), fresh, off_course(time),
          asked ? *others_.value : haptics::Rumble{}};
}

SoundsNow Feedback::sounds_now(const Input& input, double time) const {
  const lessons::Taught& taught = deciders_->teacher.taught();
  sounds::Soundscape::Input now;
  now.off = off_course(time);
  now.fine = deciders_->cues.leads_off();
  now.motion = taught.motion.value_or(motion_.value.value_or(Velocity{}));
  if (now.off && guidance_.value && guidance_.value->waypoint_distance > 0.0) {
    const double angle = guidance_.value->waypoint_angle + turned_;
    now.waypoint =
        guidance_.value->waypoint_distance * Eigen::Vector2d(std::cos(angle), -std::sin(angle));
  }
  if (nearby_.link(time, config_.stale) == cues::Link::alive && !nearby_.value->empty()) {
    now.nearest = nearby_.value->front().nearest;
    now.gap = nearby_.value->front().gap;
  }
  return {input.sounds, input.voice_busy, contacts_, taught, now};
}

std::optional<sounds::Learnt> Feedback::learnt() const { return deciders_->sounds.learnt(); }

void Feedback::take(const TrialState& state, double time) {
  trial_repeats_ = trial_time_ && state.state == trial_.state;
  trial_time_ = time;
  trial_ = state;
  deciders_->menu.take(state);
}

void Feedback::take(const Scenario& scenario, double /*time*/) {
  scenario_ = scenario;
  deciders_->menu.take(scenario);
}

void Feedback::take_goal(const Eigen::Vector2d& goal) { deciders_->menu.take_goal(goal); }

void Feedback::take_settings(const std::map<std::string, std::string>& values) {
  deciders_->menu.take_settings(values);
}

void Feedback::use(const FeedbackConfig& config) {
  config_ = config;
  deciders_->touch.use(config.haptics);
  deciders_->sounds.use(config.sounds);
  deciders_->cues.use(config.cues.wording);
  deciders_->teacher.use(config.haptics, config.sounds, config.cues.wording);
}

std::optional<cues::Utterance> Feedback::obey(const std::vector<drive::Button>& pressed,
                                              const std::string& pad, Output& out) {
  std::optional<cues::Utterance> answer;
  for (const drive::Button button : pressed) {
    const menu::Menu::Step step = deciders_->menu.press(button);
    if (step.told) answer = step.told;
    if (step.goal) out.goal = step.goal;
    if (step.request) out.request = step.request;
    if (step.glossary) deciders_->teacher.begin("glossary", pad);
    if (step.change.empty()) continue;
    out.change = step.change;
    if (step.felt) deciders_->touch.begin(haptics::Pattern::sample);
    if (step.heard) out.plays.push_back(deciders_->sounds.sample(*step.heard));
  }
  return answer;
}

cues::Situation Feedback::situation(const Input& input, const std::vector<drive::Button>& pressed,
                                    const std::optional<cues::Utterance>& answer,
                                    double time) const {
  cues::Situation now;
  now.guidance = guidance_.value;
  if (input.robot) {
    now.place = place_at(scenario_, input.robot->position);
    if (now.guidance && now.guidance->leads()) {
      now.goal_angle = navvi_types::clockwise_angle(*input.robot, now.guidance->goal);
      now.goal_straight = (now.guidance->goal - input.robot->position).norm();
    }
  }
  const auto link = [&](const auto& latest) { return latest.link(time, config_.stale); };
  now.links = {pad_link(input.hands), link(motion_), link(nearby_), link(guidance_), input.audio};
  if (now.links.proximity == cues::Link::alive) now.nearby = *nearby_.value;
  if (now.links.simulator == cues::Link::alive) now.measured = motion_.value;
  now.keyboard = input.keyboard;
  now.contacts = contacts_;
  now.commanded = commanded_;
  now.stick_held_unarmed = held_unarmed_;
  now.gate = gate_;
  now.trial = trial_.state;
  if (deciders_->teacher.alone()) {
    using cues::Link;
    now.links = {now.links.pad, Link::alive, Link::alive, Link::alive, input.audio};
    now.stick_held_unarmed = false;
  }
  now.menu = answer;
  for (const drive::Button button : pressed)
    if (button <= drive::Button::help) now.question = static_cast<cues::Question>(button);
  now.voice_busy = input.voice_busy;
  now.touch = input.motors && config_.haptics.enabled && config_.haptics.patterns;
  now.notices = input.notices;
  if (intruder_) now.notices.push_back(CueKind::intruder);
  if (trial_.state == TrialState::State::running && trial_repeats_ &&
      time - *trial_time_ > kRecordLost)
    now.notices.push_back(CueKind::record_lost);
  now.person = input.person;
  const sounds::SoundsConfig& sounds = config_.sounds;
  if (sounds.enabled && input.sounds)
    now.sounds = {sounds.turn.on, sounds.shelf.on, sounds.near.on};
  return now;
}

void Feedback::teach(const Input& input, std::vector<drive::Button>& pressed, double time) {
  lessons::Seen seen;
  seen.pressed = pressed;
  seen.begun = begun_;
  seen.hands = input.hands.live;
  seen.stick = deciders_->drive.shaped(input.hands.stick(config_.drive.stick == "right"));
  seen.keyboard = input.keyboard;
  seen.pad = input.pad;
  seen.quiet = !input.voice_busy;
  seen.motors = input.felt && config_.haptics.enabled;
  seen.sounds = input.sounds && config_.sounds.enabled;
  seen.hit = !contacts_.empty();
  if (motion_.link(time, config_.stale) == cues::Link::alive) seen.motion = *motion_.value;
  seen.arrived = guidance_.value && guidance_.value->state == Guidance::State::arrived;
  seen.trial = trial_.state;
  lessons::Teacher& teacher = deciders_->teacher;
  teacher.update(seen, time);
  pressed.erase(std::remove_if(pressed.begin(), pressed.end(),
                               [&](drive::Button button) { return teacher.takes(button); }),
                pressed.end());
}

cues::Link Feedback::pad_link(const drive::InputState& hands) const {
  if (hands.live) return cues::Link::alive;
  return seen_hands_ ? cues::Link::lost : cues::Link::never;
}

}  // namespace navvi_feedback::core
