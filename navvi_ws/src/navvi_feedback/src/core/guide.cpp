#include <algorithm>
#include <navvi_config/reader.hpp>
#include <utility>

#include "core/events.hpp"
#include "core/guide_parts.hpp"

namespace navvi_feedback::core {

GuideConfig::GuideConfig() : values_(Values()) {}

GuideConfig::Values* GuideConfig::operator->() { return std::any_cast<Values>(&values_); }
const GuideConfig::Values* GuideConfig::operator->() const {
  return std::any_cast<Values>(&values_);
}

void GuideConfig::describe(navvi_config::Visitor& visit) {
  Values* const values = operator->();
  visit(values->lead, "lead", navvi_config::OneOf{{"words", "ticks", "flow", "hand"}}, "",
        "what leads along the way: words; ticks that count turns down, and words; flow, a sound "
        "that lasts, its side where to steer, its pitch how fast; hand, pulses of the motors, "
        "likewise, without any sound");
  visit.group("link", values->link);
  visit.group("drive", values->drive);
  visit.group("buttons", values->buttons);
  visit.group("haptics", values->haptics);
  visit.group("sounds", values->sounds);
  visit.group("cues", values->cues);
}

bool GuideConfig::has_sounds() const { return (*this)->sounds.enabled; }

std::string GuideConfig::lead(bool audible) const {
  const haptics::HapticsConfig& touch = (*this)->haptics;
  return !audible && touch.enabled && touch.instead_of_words ? "hand" : (*this)->lead;
}

std::shared_ptr<const cues::Phrases> read_phrases(const std::filesystem::path& file) {
  return std::make_shared<const cues::Phrases>(file);
}

Guide::Parts::Parts(const GuideConfig::Values& config, cues::Phrases worded)
    : config(config),
      senses(config.kStale),
      drive(config.drive),
      buttons(config.buttons),
      touch(config.haptics),
      sounds(config.sounds),
      phrases(std::move(worded)),
      policy(config.cues, phrases),
      teacher(config.lesson, phrases, config.buttons, config.haptics, config.sounds,
              0.5 * config.drive.max_turn / config.drive.turn_acceleration, config.questions) {
  if (config.link.simulated()) wire.emplace(config.link);
  menu.lock(config.locked);
  if (!config.places.empty()) menu.take(menu::read_places(config.places));
  if (!config.may_lead(config.lead))
    throw navvi_config::ConfigError("lead is " + config.lead + ", but " +
                                    (config.lead == "hand" ? "haptics" : "sounds") +
                                    "/enabled is false; it leads only where these are on");
  for (const char* way : {"flow", "hand"})
    if (!config.may_lead(way)) menu.withdraw(way);
  if (config.drive.enable >= 0) menu.withdraw("9", std::to_string(config.drive.enable));
}

void Guide::Parts::take(const TrialState& state, double time) {
  using State = TrialState::State;
  if (state.state == State::running && senses.trial().state != State::running) {
    runs = true;
    last_words = false;
    following.forgive();
  }
  senses.take(state, time);
  menu.take(state);
}

void Guide::Parts::take(const Scenario& scenario, double time) {
  senses.take(scenario, time);
  menu.take(scenario);
}

Output Guide::Parts::update(const Devices& devices, double time) {
  constexpr double kLongestTick = 0.1;  // s; a longer delay is not made up for
  const double dt = std::clamp(time - last_update.value_or(time), 0.0, kLongestTick);
  last_update = time;
  Output out;
  out.command = command(devices, dt, time);
  Observation now = observe(devices, dt, time);
  ask_side(now, time, out);
  if (out.command) limit(*out.command, now);
  foresight.sent(out.command.value_or(Velocity{}), time);
  if (const auto& robot = now.devices.robot; robot && now.connection.foresight > 0.0)
    out.stops_at = robot->to_parent({now.stops_in, 0.0});
  touch.use_pad(devices.pad);
  out.alarm_begins = touch.report(devices.audio, devices.motors);
  teacher.update(now, time);
  const cues::Asked asked = obey(now, dt, out);
  decided = policy.update(now, asked, time);
  teacher.join(decided, queue.empty());
  if (!teacher.speaks()) lesson.reset();
  touch.begin(decided, now, teacher.taught());
  decided.erase(std::remove_if(decided.begin(), decided.end(),
                               [](const cues::Cue& cue) { return cue.felt; }),
                decided.end());
  const auto answers = [](const cues::Cue& cue) { return cue.asked; };
  out.answers = !now.pressed.empty() && std::any_of(decided.begin(), decided.end(), answers);
  const AuditoryDisplay::Steering led = steering(now, dt);
  for (const sounds::Play& play : sounds.update(decided, now, led, teacher.taught(), time))
    out.plays.push_back(play);
  std::optional<lead::Way> way;
  if (lasts(now.lead) && !teacher.speaks() && led.off)
    way = lead::Way{*led.off, now.guidance->waypoint_distance, now.guidance->turn_angle};
  auto course = pilot.update(way, now.nearby,
                             now.lead == Lead::hand ? lead::kBesideByHand : lead::kBesideBySound,
                             now.motion().linear, config.drive.max_forward, time);
  if (now.lead == Lead::flow) following.update(course ? led.off : std::nullopt, now.motion(), time);
  if (const auto& lesson_course = teacher.taught().course) {
    course = lesson_course->course;
    now.lead = lesson_course->lead;
  }
  if (now.lead == Lead::flow && course) out.flow = lead::flow_of(*course);
  out.flow_gain =
      (now.voice_busy ? config.sounds.kFlowUnderWords : 1.0) * config.sounds.turn.volume;
  out.rumble = touch.update(now, course, teacher.taught(), important.has_value(), dt);
  out.lesson_over = teacher.over();
  out.record = teacher.record();
  out.settings = teacher.settings();
  if (teacher.alone()) out.command.reset();
  move_motors(touch.playing(), devices, time, out);
  say(queue.update(decided, devices.speaking, time), devices, out);
  return out;
}

void Guide::Parts::receive(Devices& devices, double time) {
  wire->down.send({std::nullopt, devices.robot}, time);
  wire->down.receive(time, [&](const Wire::Report& report, double sent) {
    wire->seen = std::max(sent, wire->seen.value_or(sent));
    if (report.message)
      std::visit([&](const auto& value) { take(value, time); }, *report.message);
    else
      wire->robot = report.robot;
  });
  devices.robot = wire->robot;
}

void Guide::Parts::send(Output& out, double time) {
  if (out.command) wire->up.send({*out.command, wire->seen.value_or(time)}, time);
  out.command.reset();
  wire->up.receive(time, [&](const Wire::Sent& sent, double) {
    out.command = sent.command;
    out.lag = time - sent.seen;
  });
}

Observation Guide::Parts::observe(const Devices& devices, double dt, double time) {
  const double ahead = senses.foresight();
  Devices seen = devices;
  if (ahead > 0.0 && seen.robot) seen.robot = foresight.place(*seen.robot, ahead, time);
  Observation now = senses.observe(seen, dt, time);
  if (ahead > 0.0) foresight.look_ahead(now, devices.robot, ahead, time);
  now.stops_in = drive::stopping_distance(now.motion().linear);
  now.pressed = buttons.update(devices.hands);
  now.pressed.insert(now.pressed.end(), devices.asked.begin(), devices.asked.end());
  now.stick = drive.shaped(devices.hands.stick(config.drive.stick == "right"));
  now.menu_open = menu.open();
  now.robotless = teacher.alone();
  now.stick_held_unarmed = held_unarmed && !now.robotless;
  now.stick_disabled = pushed_disabled && !now.robotless;
  now.commanded = commanded;
  now.voice_busy = !queue.empty() || (teacher.helps() && teacher.speaks());
  now.begun = std::exchange(begun, {});
  const haptics::HapticsConfig& haptics = config.haptics;
  now.motors = devices.felt && haptics.enabled;
  now.touch = devices.motors && now.motors && haptics.patterns;
  const sounds::SoundsConfig& sounds = config.sounds;
  now.audible = devices.sounds && sounds.enabled;
  if (now.audible) now.sounds = {sounds.shelf.on, sounds.near.on};
  now.lead = leading(now);
  return now;
}

void Guide::Parts::move_motors(std::optional<haptics::Pattern> pattern, const Devices& devices,
                               double time, Output& out) {
  const haptics::RumbleOutput::Due due = rumble_output.update(out.rumble, time);
  out.rumble_due = due.feedback;
  out.rumble_moved = due.moved;
  // The record holds what can have been felt.
  const haptics::Rumble felt = devices.felt ? out.rumble : haptics::Rumble{};
  if (!devices.felt) pattern.reset();
  if (felt_output.update(felt, time).changed) out.felt = rumble_event(felt, pattern, ++rumbles);
  if (flow_output.update(out.flow, time).changed) out.flowed = flow_event(out.flow, ++sounds_begun);
}

void Guide::Parts::say(const cues::CueQueue::Step& step, const Devices& devices, Output& out) {
  out.voice = step;
  words = step.events;
  // Where no words are wanted, there are none in the record.
  if (devices.words)
    out.said = heard_words.of(words, devices.sounds && devices.voice, devices.heard);
  policy.note(words);
  for (const CueEvent& event : words) {
    const navvi_types::Spoken* const spoken = event.spoken();
    if (event.stage == CueStage::ended && event.kind() == CueKind::which_side) side.told();
    if (event.stage == CueStage::started && spoken) begun.push_back(spoken->lesson);
    if (event.stage == CueStage::started && spoken && !spoken->lesson.empty() && teacher.speaks()) {
      // Also where it says what the guide would say.
      lesson = cues::Cue{CueKind::lesson, event.text, event.priority};
      lesson->lesson = spoken->lesson;
    }
    if (event.stage == CueStage::started && event.priority == Priority::important)
      important = event.id;
    else if (event.id == important && event.stage != CueStage::queued)
      important.reset();
  }
}

Guide::Guide(const GuideConfig& config, const cues::Phrases& phrases) {
  cues::Phrases worded = phrases;
  worded.use(config->cues.wording);
  parts_ = std::make_unique<Parts>(*config.operator->(), std::move(worded));
}
Guide::~Guide() = default;

void Guide::take(const Message& message, double time) {
  if (parts_->wire)
    parts_->wire->down.send({message, std::nullopt}, time, 1 + message.index());
  else
    std::visit([&](const auto& value) { parts_->take(value, time); }, message);
}
void Guide::take_goal(const Eigen::Vector2d& goal) { parts_->menu.take_goal(goal); }
void Guide::take_place(const Eigen::Vector2d& at) { parts_->shown = at; }
void Guide::offer(const std::map<std::string, std::string>& values) {
  parts_->menu.take_settings(values);
}
void Guide::use(const GuideConfig& config) {
  const GuideConfig::Values& values = parts_->config = *config.operator->();
  parts_->touch.use(values.haptics);
  parts_->sounds.use(values.sounds);
  parts_->policy.use(values.cues.wording);
  parts_->teacher.use(values.haptics, values.sounds, values.cues.wording);
}

void Guide::announce(const Content& content) { parts_->news.push_back(content); }

void Guide::end_trial(std::optional<Content> words) {
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
  if (parts_->wire) parts_->receive(now, time);
  Output out = parts_->update(now, time);
  if (parts_->wire) parts_->send(out, time);
  return out;
}

bool Guide::end_session() {
  if (parts_->runs) end_trial(Content{CueKind::trial_ends, About::over});
  return !parts_->news.empty();
}

bool Guide::has_last_words() const {
  return parts_->last_words && (!parts_->queue.empty() || parts_->touch.playing());
}

Output Guide::hear_out(const Devices& devices, double time) {
  Output out;
  const double dt = time - std::exchange(parts_->last_update, time).value_or(time);
  const bool last = has_last_words();
  if (last) out.rumble = parts_->touch.update({}, std::nullopt, {}, false, dt);
  parts_->move_motors(last ? parts_->touch.playing() : std::nullopt, devices, time, out);
  parts_->say(parts_->queue.update({}, devices.speaking, time), devices, out);
  return out;
}

Output Guide::finish(const Devices& devices) {
  Output out;
  parts_->say(parts_->queue.clear(), devices, out);
  return out;
}

CueEvent Guide::event_of(const sounds::Play& play) {
  return sound_event(play, ++parts_->sounds_begun);
}

std::optional<CueEvent> Guide::order() const {
  std::optional<cues::Cue> order = parts_->policy.order();
  const bool urgent =
      order && (order->priority == Priority::important || traits(order->kind).shown);
  if (parts_->lesson && !urgent) order = parts_->lesson;
  if (!order) return std::nullopt;
  return CueEvent{0, CueStage::started, navvi_types::Spoken(*order, order->lesson), order->text,
                  order->priority};
}

std::optional<sounds::Learnt> Guide::learnt() const {
  return parts_->config.lead == "ticks" ? parts_->sounds.learnt() : std::nullopt;
}

const std::optional<Guidance>& Guide::guidance() const { return parts_->senses.guidance(); }

bool Guide::guidance_fresh(double time) const { return parts_->senses.guidance_fresh(time); }

}  // namespace navvi_feedback::core
