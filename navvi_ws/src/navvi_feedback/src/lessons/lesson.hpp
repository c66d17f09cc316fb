#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cues/cue.hpp"
#include "haptics/haptics.hpp"
#include "haptics/pattern.hpp"
#include "lead/course.hpp"
#include "navvi_feedback/sounds/earcon.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::lessons {

/// A course that a lesson shows, and the way of leading.
struct Shown {
  lead::Course course;
  Lead lead = Lead::flow;
};

/// What a lesson wants to be heard and felt, by the ways of a session.
struct Taught {
  std::vector<cues::Cue> cues;
  std::vector<sounds::Play> plays;
  std::optional<haptics::Pattern> pattern;
  haptics::Zone side = haptics::Zone::center;  ///< of the pattern
  std::vector<NearThing> near;                 ///< felt as if they were there
  std::optional<haptics::Rumble> rumble;       ///< instead of what is near
  std::optional<double> off;                   ///< rad, as TurnSound takes it
  std::optional<Velocity> motion;              ///< likewise, where not the robot's own
  std::optional<Shown> course;
};

/// Something to learn by ear and hand, one step after another.
class Lesson {
 public:
  virtual ~Lesson() = default;

  /// Call it at 50 Hz. \param time  s, of a clock that does not run backwards
  [[nodiscard]] virtual Taught update(const Observation& seen, double time) = 0;
  [[nodiscard]] virtual bool over() const = 0;
  /// The stick moves the robot.
  [[nodiscard]] virtual bool drives() const { return false; }
  /// It speaks: the guide says what is urgent, or asked for, and nothing else.
  [[nodiscard]] virtual bool speaks() const { return true; }
  /// The button is for the lesson alone.
  [[nodiscard]] virtual bool takes(drive::Button /*button*/) const { return true; }
  /// What came of it so far, as a table in CSV; empty for nothing.
  [[nodiscard]] virtual std::string record() const { return ""; }
  /// What is to be kept for the person, as parameters such as haptics/enabled:=true.
  [[nodiscard]] virtual std::vector<std::string> settings() const { return {}; }
};

}  // namespace navvi_feedback::lessons
