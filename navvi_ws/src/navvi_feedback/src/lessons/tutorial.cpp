#include "lessons/tutorial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <navvi_types/angles.hpp>

namespace navvi_feedback::lessons {
namespace {

using drive::Button;
using navvi_types::TrialState;

constexpr double kDegree = navvi_types::radians(1.0);
constexpr double kStill = 0.03;             // m/s and rad/s
constexpr double kSettled = 0.4;            // s, of standing, before a try is judged
constexpr double kAstray = 25.0 * kDegree;  // from straight on
constexpr double kTurnError = 15.0 * kDegree;
constexpr double kIdle = 15.0;        // s without a try, before it is told again
constexpr int kManyTries = 4;         // after which the ways out are told once more
constexpr double kHaltSpeed = 0.3;    // m/s; faster, it may be told to stop
constexpr double kHaltAfter = 0.8;    // s, at that speed; more with each try
constexpr double kClick = 1.2;        // s, from one to the next
constexpr double kNearGap = 0.3;      // m
constexpr double kDeflected = 0.4;    // of the stick, to be an answer
constexpr double kLongestTick = 0.1;  // s

bool neutral(const drive::Stick& stick) { return stick.x == 0.0 && stick.y == 0.0; }

bool stands(const Observation& seen) {
  return neutral(seen.stick) && std::abs(seen.motion().linear) < kStill &&
         std::abs(seen.motion().angular) < kStill;
}

std::string key(const std::string& name) { return "tutorial_" + name; }

}  // namespace

const std::vector<Tutorial::Step>& Tutorial::steps() {
  static const std::vector<Step> all = {
      {"let_go", Task::drive, 0.1},
      {"ahead", Task::drive, 1.5},
      {"halt", Task::halt, 1.0},
      {"turn_right", Task::turn, 90.0},
      {"turn_left", Task::turn, -60.0},
      {"near_right", Task::side, 0.0, cues::Side::right},
      {"near_ahead", Task::side, 0.0, cues::Side::ahead},
      {"near_left", Task::side, 0.0, cues::Side::left},
      {"press_help", Task::press, 0.0, {}, Button::help},
      {"press_around", Task::press, 0.0, {}, Button::around},
      {"press_where", Task::press, 0.0, {}, Button::where},
      {"goal", Task::goal},
  };
  return all;
}

std::vector<std::string> Tutorial::texts() {
  std::vector<std::string> keys;
  for (const char* name : {"welcome",
                           "buttons",
                           "keys",
                           "good",
                           "skipped",
                           "enough",
                           "stop",
                           "practice",
                           "well",
                           "done",
                           "end",
                           "wrong_hit",
                           "wrong_back",
                           "wrong_crooked",
                           "wrong_driven",
                           "wrong_short",
                           "wrong_early",
                           "wrong_late",
                           "wrong_side",
                           "wrong_too_far",
                           "wrong_too_little",
                           "wrong_was_left",
                           "wrong_was_right",
                           "wrong_was_ahead",
                           "wrong_button",
                           "wrong_no_goal"})
    keys.push_back(key(name));
  for (const Step& step : steps()) keys.push_back(key(step.name));
  return keys;
}

Tutorial::Tutorial(const cues::Phrases& phrases, const drive::ButtonsConfig& buttons)
    : teller_(phrases, buttons, texts()) {}

bool Tutorial::drives() const {
  if (step().task == Task::goal && phase_ != Phase::leaving)
    return trial_ == TrialState::State::free || trial_ == TrialState::State::running;
  return step().task != Task::side && phase_ != Phase::leaving;
}

bool Tutorial::takes(Button button) const {
  if (in_trial_) return false;
  if (button == Button::start) return step().task != Task::goal;
  return button == Button::repeat || button > Button::help;
}

void Tutorial::begin(std::size_t step) {
  at_ = step;
  results_.push_back({steps()[step].name, 1, 0.0, false, practising_});
  step_since_.reset();
  phase_ = Phase::telling;
  teller_.then(key(steps()[step].name));
}

void Tutorial::attempt() {
  phase_ = Phase::doing;
  since_ = time_;
  if (!step_since_) step_since_ = time_;
  driven_ = turned_ = 0.0;
  told_ = false;
  for (auto* moment : {&moving_, &heard_, &still_, &clicked_}) moment->reset();
}

void Tutorial::leave(const std::string& text, const Teller::Fillings& fillings) {
  phase_ = Phase::leaving;
  teller_.then(key(text), fillings);
}

void Tutorial::finish(bool passed) {
  results_.back().seconds = time_ - step_since_.value_or(time_);
  results_.back().passed = passed;
  in_trial_ = false;
  next();
}

void Tutorial::next() {
  if (!practising_ && at_ + 1 < steps().size()) return begin(at_ + 1);
  if (const auto weak = weakest(); weak && !practising_) {
    practising_ = true;
    teller_.then(key("practice"));
    return begin(*weak);
  }
  const auto well = std::count_if(results_.begin(), results_.end(), [](const Result& result) {
    return result.passed && result.tries == 1 && !result.practice;
  });
  leave(static_cast<std::size_t>(well) == steps().size() ? "well" : "done",
        {{"count", std::to_string(well)}, {"all", std::to_string(steps().size())}});
}

/// The step that took the most tries, and of those the longest.
std::optional<std::size_t> Tutorial::weakest() const {
  const Result* worst = nullptr;
  const auto rank = [](const Result& result) { return std::pair(result.tries, result.seconds); };
  for (const Result& result : results_)
    if (result.passed && result.step != "goal" && (!worst || rank(result) > rank(*worst)))
      worst = &result;
  if (!worst) return std::nullopt;
  const auto found = std::find_if(steps().begin(), steps().end(),
                                  [&](const Step& step) { return worst->step == step.name; });
  return static_cast<std::size_t>(found - steps().begin());
}

void Tutorial::buttons(const Observation& seen) {
  for (const Button button : seen.pressed) {
    if (!takes(button) || phase_ == Phase::leaving) continue;
    if (button == Button::end) {
      teller_.tell(key("end"));
      phase_ = Phase::leaving;
    } else if (button == Button::next) {
      teller_.tell(key("skipped"));
      finish(false);
    } else if (button == Button::repeat) {
      phase_ = Phase::telling;
      teller_.tell(key(step().name));
    }
  }
}

Taught Tutorial::update(const Observation& seen, double time) {
  const double dt = std::clamp(time - time_, 0.0, kLongestTick);
  time_ = time;
  trial_ = seen.trial;
  teller_.hands(seen.devices.keyboard);
  if (results_.empty()) {
    teller_.tell(key("welcome"));
    teller_.then(key("buttons"));
    if (seen.devices.keyboard) teller_.then(key("keys"));
    begin(0);
  }
  buttons(seen);
  if (phase_ == Phase::telling && step().task == Task::goal &&
      seen.trial == TrialState::State::running) {
    teller_.forget();
    attempt();  // begun before the last word
  }
  Taught taught;
  taught.cues = teller_.update(!seen.voice_busy);
  if (phase_ == Phase::doing)
    act(seen, dt, taught);
  else if (phase_ == Phase::leaving)
    over_ = over_ || (teller_.done() && taught.cues.empty() && !seen.voice_busy);
  // Who knows what to do does not wait for the last word. What is still in motion is no try.
  else if (teller_.done() && stands(seen))
    attempt();
  return taught;
}

/// The stick is let go, and the robot stands.
bool Tutorial::settled() const { return still_ && time_ - *still_ >= kSettled; }

/// A try.
void Tutorial::act(const Observation& seen, double dt, Taught& taught) {
  driven_ += seen.motion().linear * dt;
  turned_ += seen.motion().angular * dt;
  if (!stands(seen))
    still_.reset();
  else if (!still_)
    still_ = time_;
  const Verdict verdict = judge(seen, taught);
  const bool idle = !in_trial_ && std::abs(driven_) < 0.05 && std::abs(turned_) < 0.05;
  if (verdict.passed) {
    teller_.then(key("good"));
    finish(true);
  } else if (!verdict.wrong.empty()) {
    ++results_.back().tries;
    phase_ = Phase::telling;
    teller_.tell(key("wrong_" + verdict.wrong));
    if (step().task == Task::goal) return finish(false);
    teller_.then(key(step().name));
    if (results_.back().tries == kManyTries) teller_.then(key("buttons"));
  } else if (idle && time_ - since_ > kIdle) {
    phase_ = Phase::telling;
    teller_.tell(key(step().name));
  }
}

Tutorial::Verdict Tutorial::judge(const Observation& seen, Taught& taught) {
  if (!seen.contacts.empty() && step().task != Task::goal) return {false, "hit"};
  switch (step().task) {
    case Task::drive:
      return judge_drive(seen);
    case Task::halt:
      return judge_halt(seen);
    case Task::turn:
      return judge_turn(seen, taught);
    case Task::side:
      return judge_side(seen, taught);
    case Task::press:
      return judge_press(seen);
    case Task::goal:
      break;
  }
  return judge_goal(seen);
}

Tutorial::Verdict Tutorial::judge_drive(const Observation& seen) {
  if (std::abs(turned_) > kAstray) return {false, "crooked"};
  if (driven_ < -0.1) return {false, "back"};
  if (step().amount > 1.0 && driven_ >= step().amount && !neutral(seen.stick) && !told_) {
    told_ = true;
    teller_.tell(key("enough"));
  }
  if (!settled() || driven_ < 0.03) return {};
  return driven_ >= step().amount ? Verdict{true} : Verdict{false, "short"};
}

Tutorial::Verdict Tutorial::judge_halt(const Observation& seen) {
  if (driven_ < -0.1) return {false, "back"};
  if (seen.motion().linear < kHaltSpeed)
    moving_.reset();
  else if (!moving_)
    moving_ = time_;
  // Not after the same time again.
  const double after = kHaltAfter + 0.3 * ((results_.back().tries - 1) % 3);
  if (!told_ && moving_ && time_ - *moving_ >= after) {
    told_ = true;
    teller_.tell(key("stop"));
  }
  if (!heard_ && std::find(seen.begun.begin(), seen.begun.end(), key("stop")) != seen.begun.end())
    heard_ = time_;
  if (!heard_) return settled() && driven_ > 0.05 ? Verdict{false, "early"} : Verdict{};
  if (neutral(seen.stick)) return {true};
  return time_ - *heard_ > step().amount ? Verdict{false, "late"} : Verdict{};
}

Tutorial::Verdict Tutorial::judge_turn(const Observation& seen, Taught& taught) {
  const double target = step().amount * kDegree;
  const double off = target + turned_;
  taught.off = off;
  if (std::abs(driven_) > 0.5) return {false, "driven"};
  if (turned_ * target > 0.0 && std::abs(turned_) > kAstray) return {false, "side"};
  // Where no ticks are heard, a word does their work.
  if (!seen.audible && !told_ && off * target < 0.3 * target * target) {
    told_ = true;
    teller_.tell(key("stop"));
  }
  if (std::abs(turned_) < 0.1 || !settled()) return {};
  if (std::abs(off) <= kTurnError) return {true};
  return {false, off * target < 0.0 ? "too_far" : "too_little"};
}

Tutorial::Verdict Tutorial::judge_side(const Observation& seen, Taught& taught) {
  if (!clicked_ && seen.voice_busy) return {};
  const cues::Side side = step().side;
  navvi_types::NearThing thing;
  thing.thing_class = navvi_types::ThingClass::box;
  thing.gap = kNearGap;
  thing.nearest = 2.0 * cues::direction_of(side);
  taught.near.push_back(thing);
  if (!clicked_ || time_ - *clicked_ > kClick) {
    clicked_ = time_;
    if (seen.audible)
      taught.plays.push_back({sounds::Earcon::shelf_near, cues::direction_of(side), 0.8});
  }
  if (std::max(std::abs(seen.stick.x), std::abs(seen.stick.y)) < kDeflected) return {};
  if (cues::side_of({seen.stick.y, seen.stick.x}) == side) return {true};
  return {false, side == cues::Side::left    ? "was_left"
                 : side == cues::Side::right ? "was_right"
                                             : "was_ahead"};
}

Tutorial::Verdict Tutorial::judge_press(const Observation& seen) const {
  for (const Button button : seen.pressed)
    if (button <= Button::help && button != Button::repeat)
      return button == step().button ? Verdict{true} : Verdict{false, "button"};
  return {};
}

Tutorial::Verdict Tutorial::judge_goal(const Observation& seen) {
  const bool runs = seen.trial == TrialState::State::running;
  in_trial_ = in_trial_ || runs;
  if (in_trial_ && seen.arrived()) return {true};
  return in_trial_ && !runs ? Verdict{false, "no_goal"} : Verdict{};
}

std::string Tutorial::record() const {
  std::string table = "step,tries,seconds,passed,practice\n";
  for (const Result& result : results_) {
    char row[96];
    std::snprintf(row, sizeof row, "%s,%d,%.1f,%s,%s\n", result.step.c_str(), result.tries,
                  result.seconds, result.passed ? "yes" : "no", result.practice ? "yes" : "no");
    table += row;
  }
  return table;
}

}  // namespace navvi_feedback::lessons
