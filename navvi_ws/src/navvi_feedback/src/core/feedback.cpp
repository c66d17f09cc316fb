#include "navvi_feedback/core/feedback.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cues/cue_policy.hpp"
#include "cues/side.hpp"
#include "lessons/calibration.hpp"
#include "lessons/glossary.hpp"
#include "lessons/tutorial.hpp"
#include "menu/menu.hpp"
#include "sounds/soundscape.hpp"

namespace navvi_feedback::core {
namespace {

constexpr double kLongestTick = 0.1;  // s; a longer delay is not made up for
constexpr double kIdle = 6.0;         // s; who does not drive for so long needs no ticks to turn by
constexpr double kPi = 3.14159265358979323846;

haptics::Zone zone_of(const Contact& contact) {
  switch (cues::side_of(contact.seen_from_robot())) {
    case cues::Side::left:
      return haptics::Zone::left;
    case cues::Side::right:
      return haptics::Zone::right;
    case cues::Side::ahead:
    case cues::Side::behind:
      break;
  }
  return haptics::Zone::center;
}

/// What is felt when a cue is said; the cues that are not here are for the ear alone, unless
/// nothing can be heard.
std::optional<haptics::Pattern> pattern_of(const cues::Cue& cue, bool deaf) {
  using haptics::Pattern;
  static const std::map<std::string, Pattern> patterns = {{"obstacle_stop", Pattern::halt},
                                                          {"blocked", Pattern::halt},
                                                          {"robot_stopped", Pattern::stopped},
                                                          {"release_stick", Pattern::stopped},
                                                          {"stuck", Pattern::stuck},
                                                          {"stuck_unknown", Pattern::stuck},
                                                          {"press_start", Pattern::ready},
                                                          {"press_enter", Pattern::ready},
                                                          {"trial_begins", Pattern::begun},
                                                          {"back_away", Pattern::stuck},
                                                          {"arrived", Pattern::arrived},
                                                          {"rerouted", Pattern::rerouted},
                                                          {"rerouted_blocked", Pattern::rerouted},
                                                          {"new_route", Pattern::rerouted},
                                                          {"way_blocked", Pattern::rerouted}};
  const auto found = patterns.find(cue.kind);
  if (found != patterns.end()) return found->second;
  const bool alarm = cue.kind == "guidance_lost" ||
                     (cue.priority == Priority::important && cue.kind.rfind("collision_", 0) != 0);
  return deaf && alarm ? std::optional(Pattern::stopped) : std::nullopt;
}

bool fixed(const Contact& contact) {
  return contact.thing_class == navvi_types::ThingClass::shelf ||
         contact.thing_class == navvi_types::ThingClass::wall;
}

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

bool deflected(const drive::Stick& stick) { return stick.x != 0.0 || stick.y != 0.0; }

}  // namespace

void FeedbackConfig::describe(navvi_config::Visitor& visit) {
  visit(stale, "stale", navvi_config::Range{0.2, 10.0}, "s",
        "guidance, proximity or odometry older than this (wall clock) is lost");
  visit(lesson, "lesson", navvi_config::OneOf{{"none", "glossary", "tutorial", "calibrate"}}, "",
        "what is taught before all else; glossary and calibrate want no robot");
  visit.group("drive", drive);
  visit.group("buttons", buttons);
  visit.group("haptics", haptics);
  visit.group("sounds", sounds);
  visit.group("cues", cues);
}

struct Feedback::Deciders {
  drive::Drive drive;
  drive::Assistance assistance;
  drive::Buttons buttons;
  haptics::Haptics haptics;
  haptics::PatternPlayer patterns;
  sounds::Soundscape soundscape;
  cues::CuePolicy cues;
  menu::Menu menu;
  cues::Phrases phrases;
  std::string pad;  ///< whose motors are moved
  std::unique_ptr<lessons::Lesson> lesson;
  lessons::Taught taught;                 ///< of the lesson, now
  std::optional<cues::Utterance> answer;  ///< of the menu, to what was pressed now
};

Feedback::Feedback(const FeedbackConfig& config, const std::filesystem::path& phrases)
    : config_(config),
      deciders_(
          new Deciders{drive::Drive(config.drive),
                       drive::Assistance(config.drive.assistance),
                       drive::Buttons(config.buttons),
                       haptics::Haptics(config.haptics),
                       {},
                       sounds::Soundscape(config.sounds),
                       cues::CuePolicy(config.cues, cues::Phrases(phrases, config.cues.wording)),
                       {},
                       cues::Phrases(phrases, config.cues.wording),
                       {},
                       {},
                       {},
                       {}}) {}

Feedback::~Feedback() = default;

void Feedback::note(const std::vector<CueEvent>& events) {
  deciders_->cues.note(events);
  for (const CueEvent& event : events) {
    if (event.stage == CueStage::started) begun_.push_back(event.kind);
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
  if (std::exchange(deciders_->pad, input.pad) != input.pad) deciders_->haptics.use_pad(input.pad);
  Output out;
  out.command = drive(input.hands, dt);
  out.share = assist(out.command, time);
  out.alarm_begins = alarm_begins(input);
  deaf_ = config_.haptics.instead_of_words && input.audio != cues::Link::alive;
  std::vector<drive::Button> pressed = deciders_->buttons.update(input.hands);
  pressed.insert(pressed.end(), input.asked.begin(), input.asked.end());
  teach(input, pressed, time);
  out.cues = decide_cues(input, pressed, out, time);
  hush(out.cues);
  begin_patterns(out);
  out.cues.erase(std::remove_if(out.cues.begin(), out.cues.end(),
                                [](const cues::Cue& cue) { return cue.felt; }),
                 out.cues.end());
  const bool leads = deciders_->cues.leads();
  idle_ = leads && commanded_.linear == 0.0 && commanded_.angular == 0.0 ? idle_ + dt : 0.0;
  if (motion_.value) turned_ += motion_.value->angular * dt;
  for (const sounds::Play& play : sound(input, out.cues, time)) out.plays.push_back(play);
  out.rumble = feel(time, dt);
  out.pattern = deciders_->patterns.playing();
  if (const lessons::Lesson* const lesson = deciders_->lesson.get()) {
    out.lesson_over = lesson->over() && config_.lesson != "none";
    out.record = lesson->record();
    out.settings = lesson->settings();
  }
  if (alone()) out.command.reset();
  begun_.clear();
  contacts_.clear();
  last_hands_ = input.hands;
  return out;
}

std::optional<Velocity> Feedback::drive(const drive::InputState& hands, double dt) {
  // A device that was opened anew between two ticks was lost between them.
  const bool live = hands.live && (!last_hands_.live || hands.session == last_hands_.session);
  const int enable = config_.drive.enable;
  const bool enabled = enable < 0 || hands.button(static_cast<std::size_t>(enable));
  const bool held = teaching() ? !deciders_->lesson->drives() : trial_.holds();
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
  return share;
}

/// The motors report a missing audio device (safety rule 3), once there are any.
bool Feedback::alarm_begins(const Input& input) {
  if (input.audio == cues::Link::alive) {
    if (std::exchange(alarmed_, false) &&
        deciders_->patterns.playing() == haptics::Pattern::no_sound)
      deciders_->patterns.stop();
    return false;
  }
  return input.motors && !std::exchange(alarmed_, true);
}

void Feedback::begin_patterns(const Output& out) {
  haptics::PatternPlayer& patterns = deciders_->patterns;
  if (out.alarm_begins) patterns.begin(haptics::Pattern::no_sound);
  if (!config_.haptics.enabled || !config_.haptics.patterns) return;
  if (const auto& pattern = deciders_->taught.pattern)
    patterns.begin(*pattern, deciders_->taught.side);
  for (const cues::Cue& cue : out.cues)
    if (const auto pattern = pattern_of(cue, deaf_)) patterns.begin(*pattern);
  for (const Contact& contact : contacts_) {
    patterns.begin(fixed(contact) ? haptics::Pattern::hit_shelf : haptics::Pattern::hit_obstacle,
                   zone_of(contact));
  }
}

haptics::Rumble Feedback::feel(double time, double dt) {
  const lessons::Taught& taught = deciders_->taught;
  if (taught.rumble) return *taught.rumble;
  const bool arrived = guidance_.value && guidance_.value->state == Guidance::State::arrived;
  const bool fresh = nearby_.link(time, config_.stale) == cues::Link::alive &&
                     motion_.link(time, config_.stale) != cues::Link::lost &&
                     !(arrived && config_.haptics.rest_at_goal);
  const haptics::Rumble near =
      taught.near.empty()
          ? deciders_->haptics.update(nearby_.value.value_or(std::vector<NearThing>{}), fresh, dt,
                                      off_course(time), deaf_)
          : deciders_->haptics.update(taught.near, true, dt);
  if (const auto pattern = deciders_->patterns.update(dt))
    return {config_.haptics.strength * pattern->left, config_.haptics.strength * pattern->right};
  const double share = important_ ? config_.haptics.duck : 1.0;
  return {share * near.left, share * near.right};
}

/// rad, clockwise from the nose to where to steer, if the person is to be told.
std::optional<double> Feedback::off_course(double time) {
  if (teaching() && deciders_->lesson->speaks()) return deciders_->taught.off;
  if (!guidance_fresh(time) || !deciders_->cues.leads() || idle_ > kIdle) return std::nullopt;
  return std::remainder(guidance_.value->steer_angle + turned_, 2.0 * kPi);
}

/// Takes what sounds out of what is to be said, and adds what sounds besides.
std::vector<sounds::Play> Feedback::sound(const Input& input, std::vector<cues::Cue>& cues,
                                          double time) {
  using sounds::Earcon;
  const sounds::SoundsConfig& config = config_.sounds;
  std::vector<sounds::Play> plays;
  const bool audible = config.enabled && input.sounds;
  for (cues::Cue& cue : cues)
    for (sounds::Play& play : cue.scan) {
      const sounds::FamilyConfig& family = config.family_of(play.earcon);
      play.volume = audible && family.on ? family.volume : 0.0;
    }
  if (!audible) return plays;
  const auto add = [&](Earcon earcon, const Eigen::Vector2d& from) {
    const sounds::FamilyConfig& family = config.family_of(earcon);
    if (family.on) plays.push_back({earcon, from, family.volume});
  };
  for (const cues::Cue& cue : cues) {
    if (cue.sound) add(cue.sound->earcon, cue.sound->from);
    if (cue.kind == "arrived") add(Earcon::arrived, Eigen::Vector2d::UnitX());
    if (cue.kind.rfind("collision_", 0) != 0) continue;
    for (const Contact& contact : contacts_)
      add(fixed(contact) ? Earcon::hit_shelf : Earcon::hit_obstacle, contact.seen_from_robot());
  }
  cues.erase(std::remove_if(cues.begin(), cues.end(),
                            [](const cues::Cue& cue) { return cue.sound.has_value(); }),
             cues.end());
  const lessons::Taught& taught = deciders_->taught;
  plays.insert(plays.end(), taught.plays.begin(), taught.plays.end());
  sounds::Soundscape::Input now;
  now.off = off_course(time);
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
  const std::vector<sounds::Play> recurring = deciders_->soundscape.update(now, time);
  plays.insert(plays.end(), recurring.begin(), recurring.end());
  // Words win, and yet a turn is counted down. What was hit is as loud as ever.
  for (sounds::Play& play : plays) {
    if (!input.voice_busy || &config.family_of(play.earcon) == &config.hit) continue;
    if (play.earcon == Earcon::turn) play.earcon = Earcon::turn_click;
    play.volume *= config.under_words;
  }
  return plays;
}

void Feedback::take(const TrialState& state, double /*time*/) {
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
  deciders_->haptics.use(config.haptics);
  deciders_->soundscape.use(config.sounds);
  deciders_->cues.use(config.cues.wording);
  deciders_->phrases.use(config.cues.wording);
}

void Feedback::obey(const std::vector<drive::Button>& pressed, Output& out) {
  deciders_->answer.reset();
  for (const drive::Button button : pressed) {
    const menu::Menu::Step step = deciders_->menu.press(button);
    if (step.told) deciders_->answer = step.told;
    if (step.goal) out.goal = step.goal;
    if (step.request) out.request = step.request;
    if (step.glossary) begin_lesson("glossary", "");
    if (step.change.empty()) continue;
    out.change = step.change;
    if (step.felt) deciders_->patterns.begin(haptics::Pattern::sample);
    if (step.heard)
      out.plays.push_back(
          {*step.heard, Eigen::Vector2d::UnitX(), config_.sounds.family_of(*step.heard).volume});
  }
}

std::vector<cues::Cue> Feedback::decide_cues(const Input& input,
                                             const std::vector<drive::Button>& pressed, Output& out,
                                             double time) {
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
  obey(pressed, out);
  if (alone()) {
    using cues::Link;
    now.links = {now.links.pad, Link::alive, Link::alive, Link::alive, input.audio};
    now.stick_held_unarmed = false;
  }
  now.menu = deciders_->answer;
  for (const drive::Button button : pressed)
    if (button <= drive::Button::help) now.question = static_cast<cues::Question>(button);
  now.voice_busy = input.voice_busy;
  now.touch = input.motors && config_.haptics.enabled && config_.haptics.patterns;
  now.notices = input.notices;
  if (intruder_) now.notices.push_back("intruder");
  now.person = input.person;
  const sounds::SoundsConfig& sounds = config_.sounds;
  if (sounds.enabled && input.sounds)
    now.sounds = {sounds.turn.on, sounds.shelf.on, sounds.near.on};
  return deciders_->cues.update(now, time);
}

void Feedback::begin_lesson(const std::string& name, const std::string& pad) {
  const cues::Phrases& phrases = deciders_->phrases;
  if (name == "glossary") {
    deciders_->lesson = std::make_unique<lessons::Glossary>(phrases, config_.buttons,
                                                            config_.haptics, config_.sounds);
  } else if (name == "tutorial") {
    deciders_->lesson = std::make_unique<lessons::Tutorial>(phrases, config_.buttons);
  } else if (name == "calibrate") {
    const double brakes = 0.5 * config_.drive.max_turn / config_.drive.turn_acceleration;
    deciders_->lesson = std::make_unique<lessons::Calibration>(phrases, config_.buttons,
                                                               config_.haptics, pad, brakes);
  }
}

void Feedback::teach(const Input& input, std::vector<drive::Button>& pressed, double time) {
  lessons::Taught& taught = deciders_->taught;
  taught = {};
  // Not before there are hands: a pad may be found a little later, and has motors or not.
  if (!deciders_->lesson && input.hands.live) begin_lesson(config_.lesson, input.pad);
  const bool by_menu = config_.lesson == "none";
  if (by_menu && trial_.state == TrialState::State::running) deciders_->lesson.reset();
  if (!teaching()) return;
  lessons::Seen seen;
  seen.pressed = pressed;
  seen.begun = begun_;
  seen.stick = deciders_->drive.shaped(input.hands.stick(config_.drive.stick == "right"));
  seen.keyboard = input.keyboard;
  seen.quiet = !input.voice_busy;
  seen.motors = input.felt && config_.haptics.enabled;
  seen.sounds = input.sounds && config_.sounds.enabled;
  seen.hit = !contacts_.empty();
  if (motion_.link(time, config_.stale) == cues::Link::alive) seen.motion = *motion_.value;
  seen.arrived = guidance_.value && guidance_.value->state == Guidance::State::arrived;
  seen.trial = trial_.state;
  taught = deciders_->lesson->update(seen, time);
  pressed.erase(
      std::remove_if(pressed.begin(), pressed.end(),
                     [&](drive::Button button) { return deciders_->lesson->takes(button); }),
      pressed.end());
}

void Feedback::hush(std::vector<cues::Cue>& cues) const {
  static const std::set<std::string> needed = {
      "arrived",       "stuck",      "stuck_unknown", "back_away", "release_stick", "pad_back",
      "keyboard_back", "audio_back", "settings_of",   "no_rumble", "second_pad",    "pad_firmware"};
  if (!teaching()) return;
  if (deciders_->lesson->speaks())
    cues.erase(std::remove_if(cues.begin(), cues.end(),
                              [](const cues::Cue& cue) {
                                return !cue.asked && cue.priority != Priority::important &&
                                       needed.count(cue.kind) == 0;
                              }),
               cues.end());
  const std::vector<cues::Cue>& told = deciders_->taught.cues;
  cues.insert(cues.end(), told.begin(), told.end());
}

bool Feedback::teaching() const { return deciders_->lesson && !deciders_->lesson->over(); }

bool Feedback::alone() const { return config_.lesson != "none" && config_.lesson != "tutorial"; }

cues::Link Feedback::pad_link(const drive::InputState& hands) const {
  if (hands.live) return cues::Link::alive;
  return seen_hands_ ? cues::Link::lost : cues::Link::never;
}

}  // namespace navvi_feedback::core
