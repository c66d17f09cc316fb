#pragma once

#include <algorithm>
#include <navvi_types/angles.hpp>
#include <optional>
#include <string>
#include <utility>

#include "lessons/exercise.hpp"

namespace navvi_feedback::lessons {

constexpr double kBack = 0.1;                           // m; as much the wrong way is a mistake
constexpr double kHaltSpeed = 0.3;                      // m/s; faster, it may be told to stop
constexpr double kHaltAfter = 0.8;                      // s, at that speed; more with each try
constexpr double kAstray = navvi_types::radians(25.0);  // from straight on

[[nodiscard]] inline bool neutral(const drive::Stick& stick) {
  return stick.x == 0.0 && stick.y == 0.0;
}

/// Something that is told in the midst of a try, once.
class Word {
 public:
  void observe(const Instant& now) {
    if (told_ && !heard_ &&
        std::find(now.seen.begun.begin(), now.seen.begun.end(), key_) != now.seen.begun.end())
      heard_ = now.time;
  }
  /// A text of the tutorial.
  void tell(const Instant& now, const std::string& name) {
    if (!begin(name)) return;
    now.teller.tell(key_);
  }
  /// What the guide says in a session, in its words, and felt as there.
  void say(const Instant& now, const std::string& name, const cues::Utterance& words) {
    if (!begin(name)) return;
    now.teller.tell_phrase(key_, words);
    now.taught.pattern = traits(words.kind).felt;
  }
  /// s, when it began to be heard
  [[nodiscard]] const std::optional<double>& heard() const { return heard_; }

 private:
  bool begin(const std::string& name) {
    key_ = tutorial_key(name);
    return !std::exchange(told_, true);
  }

  std::string key_;
  bool told_ = false;
  std::optional<double> heard_;
};

/// A word that comes in full drive.
class WordInMotion {
 public:
  /// \param tries  it does not come after the same time again
  explicit WordInMotion(int tries) : after_(kHaltAfter + 0.3 * ((tries - 1) % 3)) {}

  /// \return it is time for the word
  bool due(const Instant& now) {
    if (now.seen.motion().linear < kHaltSpeed)
      moving_.reset();
    else if (!moving_)
      moving_ = now.time;
    return moving_ && now.time - *moving_ >= after_;
  }

 private:
  double after_;
  std::optional<double> moving_;  ///< s, since when the robot is fast enough
};

/// Where there are ticks, they lead; else a word ends the turn.
/// \param off  rad, clockwise, what is left of `target`
inline void count_down(const Instant& now, double off, double target, Word& stop) {
  now.taught.off = off;
  if (!now.seen.audible && off * target < 0.3 * target * target) stop.tell(now, "stop");
}

/// Let go at "wait", stand until "go on", and then drive `amount` m straight on, as it says.
/// \param tries  at this step so far, with this one
[[nodiscard]] Exercise begin_wait(const Step& step, int tries);

/// Back by `amount` m, straight, when the guide says so.
[[nodiscard]] Exercise begin_back_away(const Step& step);

/// Turn by `amount` degrees clockwise, which are whole hours, and drive a metre, when the guide
/// says so.
[[nodiscard]] Exercise begin_make_room(const Step& step);

}  // namespace navvi_feedback::lessons
