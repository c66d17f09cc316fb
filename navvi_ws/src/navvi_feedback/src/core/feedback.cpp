#include "core/feedback.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>
#include <utility>

#include "core/auditory_display.hpp"
#include "core/haptic_display.hpp"
#include "core/side_question.hpp"
#include "cues/cue_policy.hpp"
#include "lead/flow.hpp"
#include "lessons/teacher.hpp"
#include "menu/menu.hpp"
#include "navvi_config/reader.hpp"

namespace navvi_feedback::core {
namespace {

constexpr double kLongestTick = 0.1;  // s; a longer delay is not made up for
constexpr double kIdle = 6.0;         // s; who does not drive for so long needs no ticks to turn by

constexpr double kPlans = 5.0;        // s; no planner needs longer
constexpr double kSameGoal = 0.05;    // m

bool deflected(const drive::Stick& stick) { return stick.x != 0.0 || stick.y != 0.0; }

constexpr std::pair<drive::Button, cues::Question> kQuestions[] = {
    {drive::Button::repeat, cues::Question::way},    {drive::Button::goal, cues::Question::goal},
    {drive::Button::around, cues::Question::around}, {drive::Button::where, cues::Question::where},
    {drive::Button::turn, cues::Question::turn},     {drive::Button::help, cues::Question::help}};

std::optional<cues::Question> question_of(drive::Button button) {
  for (const auto& [of, question] : kQuestions)
    if (of == button) return question;
  return std::nullopt;
}

/// m, in map; nullopt where the robot is not known to be there now
std::optional<Eigen::Vector2d> place_of(const Observation& now) {
  const bool lost = !now.measured || now.links.guidance != Link::alive ||
                    now.guidance->state == Guidance::State::pose_stale;
  if (lost || !now.devices.robot) return std::nullopt;
  return now.devices.robot->position;
}

}  // namespace

struct Feedback::Deciders {
  Deciders(const FeedbackConfig& config, const cues::Phrases& phrases)
      : drive(config.drive),
        assistance(config.drive.assistance),
        buttons(config.buttons),
        touch(config.haptics),
        sounds(config.sounds),
        phrases(phrases),
        cues(config.cues, phrases),
        teacher(config.lesson, phrases, config.buttons, config.haptics, config.sounds,
                0.5 * config.drive.max_turn / config.drive.turn_acceleration, config.questions) {
    menu.lock(config.locked);
    if (!config.places.empty()) menu.take(menu::read_places(config.places));
  }

  drive::Drive drive;
  drive::Assistance assistance;
  drive::Buttons buttons;
  HapticDisplay touch;
  AuditoryDisplay sounds;
  cues::Phrases phrases;
  cues::CuePolicy cues;
  SideQuestion side;
  menu::Menu menu;
  lessons::Teacher teacher;
};

Feedback::Feedback(const FeedbackConfig& config, const std::filesystem::path& phrases)
    : config_(config),
      deciders_(new Deciders(config, cues::Phrases(phrases, config.cues.wording))),
      senses_(config.kStale) {
  if (config.lead == "hand" && !config.haptics.enabled)
    throw navvi_config::ConfigError(
        "lead is hand, but haptics/enabled is false; the motors lead only where they are on");
}

Feedback::~Feedback() = default;

void Feedback::note(const std::vector<CueEvent>& events) {
  deciders_->cues.note(events);
  for (const CueEvent& event : events) {
    const auto* const spoken = std::get_if<navvi_types::Spoken>(&event.what);
    if (event.stage == CueStage::ended && event.kind() == CueKind::which_side)
      deciders_->side.told();
    if (event.stage == CueStage::started && spoken) begun_.push_back(spoken->lesson);
    if (event.stage == CueStage::started && event.priority == Priority::important)
      important_ = event.id;
    else if (event.id == important_ && event.stage != CueStage::queued)
      important_.reset();
  }
}

Feedback::Decided Feedback::update(const Devices& devices, bool voice_busy, double time) {
  const double dt = std::clamp(time - last_update_.value_or(time), 0.0, kLongestTick);
  last_update_ = time;
  auto& [drive, assistance, buttons, touch, sounds, phrases, cues, side, menu, teacher] =
      *deciders_;
  Decided out;
  out.command = command(devices, dt);
  Observation now = observe(devices, voice_busy, dt, time);
  ask_side(now, time, out);
  out.share = assist(out.command, now);
  touch.use_pad(devices.pad);
  out.alarm_begins = touch.report(devices.audio, devices.motors);
  teacher.update(now, time);
  const cues::Asked asked = obey(now, dt, out);
  out.cues = cues.update(now, asked, time);
  teacher.join(out.cues);
  if (!teacher.speaks()) lesson_.reset();
  if (teacher.speaks() && !teacher.taught().cues.empty()) lesson_ = teacher.taught().cues.back();
  touch.begin(out.cues, now.contacts, teacher.taught(), now.lead == Lead::hand);
  out.cues.erase(std::remove_if(out.cues.begin(), out.cues.end(),
                                [](const cues::Cue& cue) { return cue.felt; }),
                 out.cues.end());
  out.answers =
      std::any_of(out.cues.begin(), out.cues.end(), [](const cues::Cue& cue) { return cue.asked; });
  const sounds::Soundscape::Steering led = lead(now, dt);
  for (const sounds::Play& play : sounds.update(out.cues, now, led, teacher.taught(), time))
    out.plays.push_back(play);
  auto course = pilot_.update(lasts(now.lead) && !teacher.speaks() ? led.off : std::nullopt,
                              now.nearby, now.motion().linear, config_.drive.max_forward,
                              now.lead == Lead::hand, time);
  if (now.lead == Lead::flow) following_.update(course, now.motion(), time);
  if (const auto& shown = teacher.taught().course) {
    course = shown->course;
    now.lead = shown->lead;
  }
  if (now.lead == Lead::flow && course) out.flow = lead::flow_of(*course);
  out.flow_gain = (voice_busy ? config_.sounds.kFlowUnderWords : 1.0) * config_.sounds.turn.volume;
  out.rumble = touch.update(now, course, teacher.taught(), important_.has_value(), dt);
  out.pattern = touch.playing();
  out.lesson_over = teacher.over();
  out.record = teacher.record();
  out.settings = teacher.settings();
  if (teacher.alone()) out.command.reset();
  return out;
}

std::optional<Velocity> Feedback::command(const Devices& devices, double dt) {
  const drive::InputState& hands = devices.hands;
  // A device that was opened anew between two ticks was lost between them.
  const bool live = hands.live && (!last_hands_.live || hands.session == last_hands_.session);
  // A key that drives is itself held.
  const int enable = devices.keyboard ? -1 : config_.drive.enable;
  const bool enabled = enable < 0 || hands.button(static_cast<std::size_t>(enable));
  const lessons::Teacher& teacher = deciders_->teacher;
  const bool held = teacher.teaching() ? teacher.holds() : senses_.trial().holds();
  // Where the motors led and no longer do, nobody drives on.
  felt_ = felt_ || devices.felt;
  const bool numb = config_.lead == "hand" && felt_ && !devices.felt && !teacher.teaching();
  if (held || !enabled || numb) deciders_->drive.disarm();
  const drive::Stick stick = hands.stick(config_.drive.stick == "right");
  const std::optional<Velocity> velocity =
      deciders_->drive.update(live ? std::optional(stick) : std::nullopt, dt);
  commanded_ = velocity.value_or(Velocity{});
  const bool pushed = live && deflected(deciders_->drive.shaped(stick));
  held_unarmed_ = pushed && enabled && !deciders_->drive.armed();
  pushed_disabled_ = pushed && !enabled && !held;
  // The last command of a lost stick is zero; none follows it.
  const bool last = std::exchange(last_hands_, hands).live;
  return velocity || last ? std::optional(commanded_) : std::nullopt;
}

Observation Feedback::observe(const Devices& devices, bool voice_busy, double dt, double time) {
  Observation now = senses_.observe(devices, dt, time);
  now.pressed = deciders_->buttons.update(devices.hands);
  now.pressed.insert(now.pressed.end(), devices.asked.begin(), devices.asked.end());
  now.stick = deciders_->drive.shaped(devices.hands.stick(config_.drive.stick == "right"));
  now.robotless = deciders_->teacher.alone();
  now.stick_held_unarmed = held_unarmed_ && !now.robotless;
  now.stick_disabled = pushed_disabled_ && !now.robotless;
  now.commanded = commanded_;
  now.voice_busy = voice_busy;
  now.begun = std::exchange(begun_, {});
  const haptics::HapticsConfig& haptics = config_.haptics;
  now.motors = devices.felt && haptics.enabled;
  now.touch = devices.motors && haptics.enabled && haptics.patterns;
  const sounds::SoundsConfig& sounds = config_.sounds;
  now.audible = devices.sounds && sounds.enabled;
  if (now.audible)
    now.sounds = {sounds.shelf.on, sounds.near.on};
  now.lead = leading(now);
  return now;
}

/// As far as the person hears or feels it.
Lead Feedback::leading(const Observation& now) const {
  // A lesson teaches turns by ticks, whatever leads later.
  if (deciders_->teacher.speaks()) return now.audible ? Lead::ticks : Lead::words;
  const Lead wanted = navvi_types::from_word<Lead>(config_.lead).value_or(Lead::words);
  const bool deaf = deciders_->touch.deaf() && !now.devices.sounds;
  if ((wanted == Lead::hand || deaf) && now.motors) return Lead::hand;
  if (!now.audible) return Lead::words;
  if (wanted == Lead::flow && following_.follows()) return Lead::flow;
  return wanted != Lead::words && deciders_->sounds.leads() ? Lead::ticks : Lead::words;
}

/// Before a trial, of a person whom sounds are to lead, by each sound device once.
void Feedback::ask_side(Observation& now, double time, Output& out) {
  AuditoryDisplay& sounds = deciders_->sounds;
  SideQuestion& side = deciders_->side;
  const Devices& devices = now.devices;
  const bool known = devices.ears.empty() || devices.ears == config_.sounds.sides;
  const bool may = !known && now.lead != Lead::words && devices.sounds && devices.words && devices.hands.live &&
                   !deciders_->teacher.teaching() && now.trial == TrialState::State::ready;
  const std::optional<bool> right = side.update(may, !now.voice_busy, now.stick.x, time);
  if (right == false) sounds.find_sides_wrong();
  if (right == true && !devices.person.empty()) out.change = "sounds/sides:=" + devices.ears;
  now.side_asked = side.asks();
  if (side.sounds()) {
    out.plays.push_back(sounds.sample(sounds::Earcon::turn));
    out.plays.back().from = {0.0, *side.sounds()};
  }
  if (const auto learnt = sounds.learnt(); learnt && learnt->sides_wrong)
    now.notices.push_back(CueKind::sides_wrong);
}

/// What the person asked for stays the measure of being stuck. \return the share that is left
double Feedback::assist(std::optional<Velocity>& command, const Observation& now) const {
  if (!command) return 1.0;
  double share =
      deciders_->assistance.share(*command, now.nearby, now.links.proximity == Link::alive);
  if (now.devices.hands.late) {
    share = std::min(share, config_.drive.assistance.least);
    command->angular *= config_.drive.assistance.least;
  }
  command->linear *= share;
  const double turning = std::abs(command->angular);
  const double most = deciders_->sounds.most_rate().value_or(turning);
  if (turning <= most) return share;
  command->angular *= most / turning;
  return std::min(share, most / turning);
}

cues::Asked Feedback::obey(const Observation& now, double dt, Output& out) {
  auto& [drive, assistance, buttons, touch, sounds, phrases, cues, side, menu, teacher] =
      *deciders_;
  std::vector<drive::Button> pressed;
  for (const drive::Button button : now.pressed)
    if (!teacher.takes(button)) pressed.push_back(button);
  cues::Asked asked;
  for (const drive::Button button : pressed) {
    if (const auto question = question_of(button)) asked.question = question;
    if (asked.question == cues::Question::goal && now.lead == Lead::hand && now.goal_angle)
      touch.answer(*now.goal_angle, now.goal_straight);
    const menu::Menu::Step step = menu.press(button);
    if (step.goal) {
      out.goal = step.goal;
      const std::uint32_t plans = now.guidance ? now.guidance->plans : 0;
      chosen_ = Chosen{*step.goal, *step.told, plans, kPlans};
    } else if (step.told) {
      asked.menu = step.told;
    }
    if (step.request) out.request = step.request;
    if (step.remember) asked.menu = remember(place_of(now), out);
    if (step.glossary) teacher.begin("glossary", now.devices.pad);
    if (step.change.empty()) continue;
    out.change = step.change;
    if (step.felt) touch.begin(haptics::Pattern::sample);
    if (step.heard) out.plays.push_back(sounds.sample(*step.heard));
  }
  if (const auto at = std::exchange(shown_, std::nullopt); at && !menu.locked())
    asked.menu = remember(at, out);
  if (const auto answer = heed_planner(now, dt); answer && !asked.menu) asked.menu = answer;
  asked.menu_closed = menu.pass(dt);
  return asked;
}

std::optional<cues::Utterance> Feedback::heed_planner(const Observation& now, double dt) {
  if (!chosen_) return std::nullopt;
  const std::optional<Guidance>& plan = now.guidance;
  const bool answered = plan && plan->plans != chosen_->plans &&
                        (plan->goal - chosen_->goal).norm() < kSameGoal;
  chosen_->left -= dt;
  if (!answered && chosen_->left > 0.0) return std::nullopt;
  const Chosen chosen = *std::exchange(chosen_, std::nullopt);
  if (!answered) return cues::Utterance{CueKind::menu_closed};
  // Why there is no way is told by itself.
  if (!plan->leads() && plan->state != Guidance::State::arrived) return std::nullopt;
  return chosen.words;
}

cues::Utterance Feedback::remember(const std::optional<Eigen::Vector2d>& at, Output& out) {
  if (config_.places.empty()) return {CueKind::place_no_file};
  if (!at) return {CueKind::place_no_pose};
  out.place = deciders_->menu.remember(*at, deciders_->phrases);
  if (!out.place) return {CueKind::place_not_saved};
  cues::Utterance told{CueKind::place_saved};
  told.fillings.place_name = out.place->name;
  return told;
}

sounds::Soundscape::Steering Feedback::lead(const Observation& now, double dt) {
  const bool drives = now.commanded.linear != 0.0 || now.commanded.angular != 0.0;
  idle_ = deciders_->cues.leads() && !drives ? idle_ + dt : 0.0;
  return {off_course(now), deciders_->cues.leads_off(),
          deciders_->teacher.taught().motion.value_or(now.last_measured)};
}

std::optional<double> Feedback::off_course(const Observation& now) const {
  if (deciders_->teacher.speaks()) return deciders_->teacher.taught().off;
  const bool awake = lasts(now.lead) || idle_ <= kIdle;
  const bool led = now.links.guidance == Link::alive && deciders_->cues.leads() && awake;
  if (!led) return std::nullopt;
  return navvi_types::wrap(now.guidance->steer_angle + now.turned);
}

std::optional<cues::Cue> Feedback::order() const {
  std::optional<cues::Cue> order = deciders_->cues.order();
  const bool urgent =
      order && (order->priority == Priority::important || traits(order->kind).shown);
  if (!lesson_ || urgent) return order;
  order = lesson_;
  order->kind = CueKind::lesson;  // also where it says what the guide would say
  return order;
}

std::optional<sounds::Learnt> Feedback::learnt() const {
  return config_.lead == "ticks" ? deciders_->sounds.learnt() : std::nullopt;
}

void Feedback::take(const TrialState& state, double time) {
  const bool begins = state.state == TrialState::State::running &&
                      senses_.trial().state != TrialState::State::running;
  if (begins) following_.forgive();
  senses_.take(state, time);
  deciders_->menu.take(state);
}

void Feedback::take(const Scenario& scenario, double /*time*/) {
  senses_.take(scenario);
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

}  // namespace navvi_feedback::core
