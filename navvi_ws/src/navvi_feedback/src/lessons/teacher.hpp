#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cues/phrases.hpp"
#include "lessons/lesson.hpp"
#include "lessons/questionnaire.hpp"
#include "lessons/teller.hpp"
#include "sounds/sounds_config.hpp"

namespace navvi_feedback::lessons {

/// Gives the lesson that comes before all else, and those that the person chooses.
class Teacher {
 public:
  /// \param first  "glossary", "tutorial", "calibrate" or "questionnaire"; "none": no lesson first
  /// \param robot_delay  s, as Calibration takes it
  /// \param questions  path, as read_questions() takes it; of a questionnaire
  /// \throws navvi_config::ConfigError if they cannot be asked, or if the phrases lack a text of
  /// help, the glossary or the first lesson
  Teacher(std::string first, cues::Phrases phrases, const drive::ButtonsConfig& buttons,
          const haptics::HapticsConfig& haptics, const sounds::SoundsConfig& sounds,
          double robot_delay, const std::string& questions);

  /// For the lessons that begin from now on.
  void use(const haptics::HapticsConfig& haptics, const sounds::SoundsConfig& sounds,
           const cues::WordingConfig& wording);

  /// \param pad  whose motors are felt
  void begin(const std::string& lesson, const std::string& pad);
  /// Call it at 50 Hz. The first lesson begins as soon as there are hands; one that was chosen ends
  /// with the beginning of a trial. \param time  s, of a clock that does not run backwards
  void update(const Observation& seen, double time);

  /// Help tells what the buttons do; any other button ends that. \param keyboard  by the keys
  void press(drive::Button button, bool keyboard);
  /// That is being told.
  [[nodiscard]] bool helps() const { return !help_.done(); }

  [[nodiscard]] bool teaching() const { return lesson_ && !lesson_->over(); }
  /// The first lesson wants no robot: nothing else goes on.
  [[nodiscard]] bool alone() const { return first_ != "none" && first_ != "tutorial"; }
  /// The stick does not move the robot.
  [[nodiscard]] bool holds() const { return teaching() && !lesson_->drives(); }
  [[nodiscard]] bool speaks() const { return teaching() && lesson_->speaks(); }
  [[nodiscard]] bool takes(drive::Button button) const {
    return teaching() && lesson_->takes(button);
  }
  [[nodiscard]] const Taught& taught() const { return taught_; }
  /// Leaves what may be said while a lesson speaks, and adds what the lesson and help say.
  /// \param quiet  nothing is spoken or waits for it
  void join(std::vector<cues::Cue>& cues, bool quiet);

  [[nodiscard]] bool over() const { return first_ != "none" && lesson_ && lesson_->over(); }
  [[nodiscard]] std::string record() const { return lesson_ ? lesson_->record() : ""; }
  [[nodiscard]] std::vector<std::string> settings() const {
    return lesson_ ? lesson_->settings() : std::vector<std::string>();
  }

 private:
  std::string first_;
  cues::Phrases phrases_;
  drive::ButtonsConfig buttons_;
  haptics::HapticsConfig haptics_;
  sounds::SoundsConfig sounds_;
  double robot_delay_;
  std::vector<Question> questions_;
  std::unique_ptr<Lesson> lesson_;
  Taught taught_;  ///< now
  Teller help_;
};

}  // namespace navvi_feedback::lessons
