#include "lessons/tutorial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace navvi_feedback::lessons {
using drive::Button;

const std::vector<Step>& Tutorial::steps() {
  static const std::vector<Step> all = {
      {"let_go", Task::drive, 0.1},
      {"ahead", Task::drive, 1.5},
      {"halt", Task::halt, 1.0},
      {"wait", Task::wait, 1.0},
      {"back_away", Task::back_away, 0.4},
      {"turn_right", Task::turn, 90.0},
      {"turn_left", Task::turn, -60.0},
      {"make_room", Task::make_room, -60.0},
      {"by_sound", Task::by_sound, 50.0},
      {"by_hand", Task::by_hand, -50.0},
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
  std::istringstream names(
      "welcome buttons keys good skipped enough stop practice well done end wrong_hit "
      "wrong_back wrong_crooked wrong_driven wrong_short wrong_early wrong_late wrong_moved "
      "wrong_stood wrong_soon wrong_forward wrong_not_back wrong_place wrong_side wrong_too_far "
      "wrong_too_little wrong_was_left wrong_was_right wrong_was_ahead wrong_button wrong_no_goal");
  for (std::string name; names >> name;) keys.push_back(tutorial_key(name));
  for (const Step& step : steps()) keys.push_back(tutorial_key(step.name));
  return keys;
}

Tutorial::Tutorial(const cues::Phrases& phrases, const drive::ButtonsConfig& buttons)
    : teller_(phrases, buttons, texts()), buttons_(buttons) {}

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
  teller_.then(tutorial_key(steps()[step].name));
}

void Tutorial::attempt() {
  phase_ = Phase::doing;
  since_ = time_;
  if (!step_since_) step_since_ = time_;
  moved_ = {};
  exercise_ = begin_exercise(step(), results_.back().tries);
}

void Tutorial::finish(bool passed) {
  results_.back().seconds = time_ - step_since_.value_or(time_);
  results_.back().passed = passed;
  in_trial_ = false;
  next();
}

/// What leads in it reaches the person, and there is the button.
bool Tutorial::given(const Step& step) const {
  if (step.task == Task::press) return buttons_.index[static_cast<std::size_t>(step.button)] >= 0;
  return step.task == Task::by_sound ? audible_ : step.task != Task::by_hand || motors_;
}

void Tutorial::next() {
  if (!practising_) {
    std::size_t at = at_ + 1;
    while (at < steps().size() && !given(steps()[at])) ++at;
    if (at < steps().size()) return begin(at);
  }
  if (const auto weak = weakest(); weak && !practising_) {
    practising_ = true;
    teller_.then(tutorial_key("practice"));
    return begin(*weak);
  }
  const auto well = std::count_if(results_.begin(), results_.end(), [](const Result& result) {
    return result.passed && result.tries == 1 && !result.practice;
  });
  const auto all = std::count_if(steps().begin(), steps().end(),
                                 [&](const Step& step) { return given(step); });
  phase_ = Phase::leaving;
  teller_.then(tutorial_key(well == all ? "well" : "done"),
               {{"count", std::to_string(well)}, {"all", std::to_string(all)}});
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
      teller_.tell(tutorial_key("end"));
      phase_ = Phase::leaving;
    } else if (button == Button::next) {
      teller_.tell(tutorial_key("skipped"));
      finish(false);
    } else if (button == Button::repeat) {
      phase_ = Phase::telling;
      teller_.tell(tutorial_key(step().name));
    }
  }
}

Taught Tutorial::update(const Observation& seen, double time) {
  constexpr double kLongestTick = 0.1;  // s
  const double dt = std::clamp(time - time_, 0.0, kLongestTick);
  time_ = time;
  trial_ = seen.trial;
  audible_ = seen.audible;
  motors_ = seen.motors;
  teller_.hands(seen.devices.keyboard);
  if (results_.empty()) {
    teller_.tell(tutorial_key("welcome"));
    teller_.then(tutorial_key("buttons"));
    if (seen.devices.keyboard) teller_.then(tutorial_key("keys"));
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

void Tutorial::act(const Observation& seen, double dt, Taught& taught) {
  constexpr double kIdle = 15.0;  // s without a try, before it is told again
  constexpr int kManyTries = 4;   // after which the ways out are told once more
  const bool to_goal = step().task == Task::goal;
  in_trial_ = in_trial_ || (to_goal && seen.trial == TrialState::State::running);
  moved_.observe(seen, dt, time_);
  const Verdict verdict = !seen.contacts.empty() && !to_goal
                              ? Verdict{false, "hit"}
                              : exercise_({seen, moved_, time_, teller_, taught});
  const bool idle = !in_trial_ && std::abs(moved_.driven) < 0.05 && std::abs(moved_.turned) < 0.05;
  if (verdict.passed) {
    teller_.then(tutorial_key("good"));
    finish(true);
  } else if (!verdict.wrong.empty()) {
    ++results_.back().tries;
    phase_ = Phase::telling;
    teller_.tell(tutorial_key("wrong_" + verdict.wrong));
    if (to_goal) return finish(false);
    teller_.then(tutorial_key(step().name));
    if (results_.back().tries == kManyTries) teller_.then(tutorial_key("buttons"));
  } else if (idle && time_ - since_ > kIdle) {
    phase_ = Phase::telling;
    teller_.tell(tutorial_key(step().name));
  }
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
