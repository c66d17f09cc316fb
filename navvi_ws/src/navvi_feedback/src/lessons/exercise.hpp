#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

#include "lessons/lesson.hpp"
#include "lessons/teller.hpp"

namespace navvi_feedback::lessons {

enum class Task {
  drive,      ///< straight on, and let go
  halt,       ///< let go at a word
  wait,       ///< let go at a word, and drive on at another
  back_away,  ///< at a word
  turn,       ///< and stop in time
  by_sound,   ///< follow a sound that lasts to a place
  by_hand,    ///< follow the motors, likewise
  make_room,  ///< drive to where a word sends
  side,       ///< tell on which side something is near
  press,      ///< a button
  goal,       ///< a trial
};

struct Step {
  const char* name;  ///< also in the keys of its texts
  Task task;
  double amount = 0.0;                           ///< m, s or deg clockwise, by the task
  cues::Side side = cues::Side::ahead;           ///< of the thing
  drive::Button button = drive::Button::repeat;  ///< to be pressed
};

/// What a try came to: nothing yet, well done, or the key of what went wrong.
struct Verdict {
  bool passed = false;
  std::string wrong = {};
};

/// Where the robot is, seen from where a try began.
struct Moved {
  double driven = 0.0;                           ///< m, forward
  double turned = 0.0;                           ///< rad, counter-clockwise
  Eigen::Vector2d to = Eigen::Vector2d::Zero();  ///< m, in base_link as it was then
  std::optional<double> still = {};  ///< s, since when the stick is let go and the robot stands

  /// \param dt  s, since the last call \param time  s
  void observe(const Observation& seen, double dt, double time);
};

/// One instant of a try, and the ways to be heard and felt in it.
struct Instant {
  const Observation& seen;
  const Moved& moved;
  double time;  ///< s
  Teller& teller;
  Taught& taught;

  /// The stick is let go, and the robot stands.
  [[nodiscard]] bool settled() const;
};

/// One try at what a step asks for, to be called at 50 Hz.
using Exercise = std::function<Verdict(const Instant& now)>;

/// \param tries  at this step so far, with this one
[[nodiscard]] Exercise begin_exercise(const Step& step, int tries);

/// The stick is let go, and the robot stands now.
[[nodiscard]] bool stands(const Observation& seen);

[[nodiscard]] std::string tutorial_key(const std::string& name);

}  // namespace navvi_feedback::lessons
