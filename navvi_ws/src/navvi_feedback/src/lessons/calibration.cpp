#include "lessons/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_files/printable.hpp>

namespace navvi_feedback::lessons {
namespace {

constexpr double kWeakest = 0.01;
constexpr double kStrongest = 0.5;  // what haptics/start_left may be
constexpr double kCoarse = 2.0;     // factor
constexpr double kFine = 1.41;
constexpr std::size_t kCounted = 4;

using drive::Button;

constexpr double kPulse = 0.5;   // s, that a motor turns
constexpr double kAnswer = 1.5;  // s, from the begin of a pulse to the end of its answer
constexpr double kEvery = 1.2;   // s, from pulse to pulse while the strength is chosen
constexpr double kStep = 0.1;    // of the strength
constexpr double kLeastGain = 0.2;
constexpr double kMargin = 1.2;      // what is felt half the time, times this, is felt
constexpr std::size_t kSignals = 5;  // to let go of the stick
constexpr double kDeflected = 0.4;   // of the stick
constexpr double kLate = 0.8;        // s; a hand that lets go later did not let go at the sound
constexpr int kMostLate = 10;        // then it is not measured
constexpr double kSilence = 12.0;    // s, until the prompt is told again

std::string key(const char* name) { return std::string("calibrate_") + name; }

bool pressed(const Observation& seen, Button button) {
  return std::find(seen.pressed.begin(), seen.pressed.end(), button) != seen.pressed.end();
}

std::string number(double value) { return navvi_files::fixed(value, 2); }

}  // namespace

void Staircase::answer(bool felt) {
  if (last_ && *last_ != felt) turns_.push_back(strength_);
  last_ = felt;
  const double factor = turns_.empty() ? kCoarse : kFine;
  const double next =
      std::clamp(felt ? strength_ / factor : strength_ * factor, kWeakest, kStrongest);
  ends_ = next == strength_ ? ends_ + 1 : 0;
  strength_ = next;
}

std::optional<double> Staircase::threshold() const {
  if (turns_.size() < 6) return last_ == true ? std::optional(strength_) : std::nullopt;
  double sum = 0.0;
  for (std::size_t i = turns_.size() - kCounted; i < turns_.size(); ++i) sum += std::log(turns_[i]);
  return std::exp(sum / kCounted);
}

std::vector<std::string> Calibration::texts() {
  std::vector<std::string> keys = {"tutorial_keys"};
  for (const char* name :
       {"welcome", "no_motors", "left", "right", "only_felt", "not_felt", "comfort", "halt",
        "early", "late", "once_more", "not_measured", "found_motors", "found_strength",
        "found_delay", "found_nothing", "confirm", "done", "end"})
    keys.push_back(key(name));
  return keys;
}

Calibration::Calibration(const cues::Phrases& phrases, const drive::ButtonsConfig& buttons,
                         const haptics::HapticsConfig& haptics, std::string pad, double robot_delay)
    : haptics_(haptics),
      pad_(std::move(pad)),
      robot_delay_(robot_delay),
      teller_(phrases, buttons, texts()) {}

/// s; no two in succession are alike.
double Calibration::pause() { return 1.0 + 0.37 * (++signals_ * 3 % 5); }

void Calibration::enter(Stage stage, const Observation& seen) {
  if (!seen.motors && stage < Stage::halt) {
    teller_.then(key("no_motors"));
    stage = Stage::halt;
  }
  stage_ = stage;
  staircase_ = {};
  due_.reset();
  signalled_.reset();
  silent_since_.reset();
  if (stage == Stage::confirm) tell_found();
  prompt();
}

void Calibration::prompt() {
  const char* const texts[] = {"left", "right", "comfort", "halt", "confirm", "done"};
  teller_.then(key(texts[static_cast<std::size_t>(stage_)]));
}

/// Nobody who has missed a prompt is left in silence.
void Calibration::prompt_again(const Observation& seen) {
  const bool signals = signalled_ || (due_ && stage_ != Stage::comfort);
  if (!silent_since_ || !seen.pressed.empty() || signals) silent_since_ = time_;
  using Buttons = std::vector<Button>;
  const Buttons useful =
      stage_ == Stage::left || stage_ == Stage::right ? Buttons{Button::repeat}
      : stage_ == Stage::halt
          ? Buttons{}
          : Buttons{Button::previous, Button::next, Button::start, Button::choose, Button::repeat};
  const bool asks = std::any_of(seen.pressed.begin(), seen.pressed.end(), [&](Button button) {
    return std::find(useful.begin(), useful.end(), button) == useful.end();
  });
  if (!asks && time_ - *silent_since_ < kSilence) return;
  silent_since_.reset();
  due_.reset();
  prompt();
}

Taught Calibration::update(const Observation& seen, double time) {
  Taught taught;
  time_ = time;
  teller_.hands(seen.devices.keyboard);
  if (!begun_) {
    begun_ = true;
    teller_.tell(key("welcome"));
    if (seen.devices.keyboard) teller_.then("tutorial_keys");
    enter(Stage::left, seen);
  }
  if (pressed(seen, Button::end) && stage_ != Stage::end) {
    stage_ = Stage::end;
    teller_.tell(key("end"));
  }
  if (teller_.done() && !seen.voice_busy) {
    switch (stage_) {
      case Stage::left:
      case Stage::right:
        feel(seen, taught);
        break;
      case Stage::comfort:
        choose(seen, taught);
        break;
      case Stage::halt:
        halt(seen, taught);
        break;
      case Stage::confirm:
        confirm(seen);
        break;
      case Stage::end:
        over_ = true;
        break;
    }
    if (stage_ != Stage::end && teller_.done()) prompt_again(seen);
  } else {
    // What is spoken stands between two signals.
    due_.reset();
    signalled_.reset();
    silent_since_.reset();
  }
  taught.cues = teller_.update(!seen.voice_busy);
  return taught;
}

void Calibration::feel(const Observation& seen, Taught& taught) {
  if (!due_) due_ = time_ + pause();
  const double since = time_ - *due_;
  const bool felt = pressed(seen, Button::repeat);
  if (since < 0.0) {
    if (felt) teller_.tell(key("only_felt"));
    return;
  }
  if (since < kPulse)
    taught.rumble = stage_ == Stage::left ? haptics::Rumble{staircase_.strength(), 0.0}
                                          : haptics::Rumble{0.0, staircase_.strength()};
  if (!felt && since < kAnswer) return;
  staircase_.answer(felt);
  due_.reset();
  if (!staircase_.done()) return;
  const std::optional<double> threshold = staircase_.threshold();
  if (!threshold) teller_.then(key("not_felt"));
  (stage_ == Stage::left ? left_ : right_) = threshold;
  enter(stage_ == Stage::left ? Stage::right : Stage::comfort, seen);
}

void Calibration::choose(const Observation& seen, Taught& taught) {
  if (pressed(seen, Button::previous)) gain_ = std::min(1.0, gain_ + kStep);
  if (pressed(seen, Button::next)) gain_ = std::max(kLeastGain, gain_ - kStep);
  if (pressed(seen, Button::previous) || pressed(seen, Button::next) || !due_) due_ = time_;
  if (std::fmod(time_ - *due_, kEvery) < kPulse) taught.rumble = haptics::Rumble{gain_, gain_};
  for (const Button button : {Button::start, Button::choose, Button::repeat})
    if (pressed(seen, button)) return enter(Stage::halt, seen);
}

void Calibration::halt(const Observation& seen, Taught& taught) {
  const bool held = std::max(std::abs(seen.stick.x), std::abs(seen.stick.y)) > kDeflected;
  const bool let_go = seen.stick.x == 0.0 && seen.stick.y == 0.0;
  if (signalled_) {
    const double delay = time_ - *signalled_;
    if (let_go || delay > kLate) this->let_go(delay, seen);
    return;
  }
  if (!due_) {
    if (held) due_ = time_ + pause();
    return;
  }
  if (let_go) {
    teller_.then(key("early"));
  } else if (time_ >= *due_) {
    signalled_ = time_;
    taught.plays.push_back({sounds::Earcon::turn_stop, Eigen::Vector2d::UnitX(), 1.0});
    if (!seen.audible) taught.rumble = haptics::Rumble{gain_, gain_};
  }
}

void Calibration::let_go(double delay, const Observation& seen) {
  signalled_.reset();
  due_.reset();
  if (delay > kLate) {
    if (++late_ < kMostLate) return teller_.then(key("late"));
    teller_.then(key("not_measured"));
    return enter(Stage::confirm, seen);
  }
  delays_.push_back(delay);
  if (delays_.size() >= kSignals) return enter(Stage::confirm, seen);
  teller_.then(key("once_more"));
}

/// s, the median. Call it where there are enough.
double Calibration::delay() const {
  std::vector<double> delays = delays_;
  std::sort(delays.begin(), delays.end());
  return delays[delays.size() / 2];
}

void Calibration::tell_found() {
  const auto percent = [](double strength) {
    return std::to_string(static_cast<int>(std::lround(100.0 * strength)));
  };
  const bool motors = left_ && right_;
  if (motors) {
    teller_.then(key("found_motors"), {{"count", percent(*left_)}, {"all", percent(*right_)}});
    teller_.then(key("found_strength"), {{"count", percent(gain_)}});
  }
  if (delays_.size() >= kSignals) teller_.then(key("found_delay"), {{"text", number(delay())}});
  if (!motors && delays_.size() < kSignals) teller_.then(key("found_nothing"));
}

void Calibration::confirm(const Observation& seen) {
  if (pressed(seen, Button::start) || pressed(seen, Button::choose)) {
    complete_ = true;
    return enter(Stage::end, seen);
  }
  if (!pressed(seen, Button::repeat)) return;
  left_.reset();
  right_.reset();
  delays_.clear();
  late_ = 0;
  enter(Stage::left, seen);
}

std::string Calibration::record() const {
  if (stage_ != Stage::end) return "";
  std::string rows = "measured,value\n";
  if (left_) rows += "left_threshold," + number(*left_) + "\n";
  if (right_) rows += "right_threshold," + number(*right_) + "\n";
  if (left_ && right_) rows += "strength," + number(gain_) + "\n";
  for (const double delay : delays_) rows += "delay_s," + number(delay) + "\n";
  rows += std::string("saved,") + (complete_ ? "yes" : "no") + "\n";
  return rows;
}

std::vector<std::string> Calibration::settings() const {
  std::vector<std::string> words;
  if (!complete_) return words;
  if (left_ && right_) {
    std::string pads;
    for (const std::string& other : haptics_.pads)
      if (other.rfind(pad_ + " ", 0) != 0) pads += "\"" + other + "\", ";
    const auto start = [](double threshold) { return number(std::min(0.5, kMargin * threshold)); };
    words.push_back("haptics/pads:=[" + pads + "\"" + pad_ + " " + start(*left_) + " " +
                    start(*right_) + " " + number(gain_) + "\"]");
  }
  if (delays_.size() >= kSignals)
    words.push_back("sounds/turn/stopping_delay:=" + number(delay() + robot_delay_));
  return words;
}

}  // namespace navvi_feedback::lessons
