#include "lessons/teacher.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "lessons/calibration.hpp"
#include "lessons/glossary.hpp"
#include "lessons/tutorial.hpp"

namespace navvi_feedback::lessons {

Teacher::Teacher(std::string first, cues::Phrases phrases, const drive::ButtonsConfig& buttons,
                 const haptics::HapticsConfig& haptics, const sounds::SoundsConfig& sounds,
                 double robot_delay, const std::string& questions)
    : first_(std::move(first)),
      phrases_(std::move(phrases)),
      buttons_(buttons),
      haptics_(haptics),
      sounds_(sounds),
      robot_delay_(robot_delay),
      help_(phrases_, buttons_, {"help"}) {
  if (first_ == "questionnaire") questions_ = read_questions(questions);
  // A text that is missing is told now, and not once a lesson is chosen.
  begin("glossary", "");
  begin(first_, "");
  lesson_.reset();
}

void Teacher::use(const haptics::HapticsConfig& haptics, const sounds::SoundsConfig& sounds,
                  const cues::WordingConfig& wording) {
  haptics_ = haptics;
  sounds_ = sounds;
  phrases_.use(wording);
}

void Teacher::begin(const std::string& lesson, const std::string& pad) {
  if (lesson == "glossary") {
    lesson_ = std::make_unique<Glossary>(phrases_, buttons_, haptics_, sounds_);
  } else if (lesson == "tutorial") {
    lesson_ = std::make_unique<Tutorial>(phrases_, buttons_);
  } else if (lesson == "calibrate") {
    lesson_ = std::make_unique<Calibration>(phrases_, buttons_, haptics_, pad, robot_delay_);
  } else if (lesson == "questionnaire") {
    lesson_ = std::make_unique<Questionnaire>(phrases_, buttons_, questions_);
  }
}

void Teacher::update(const Observation& seen, double time) {
  taught_ = {};
  // A pad may be found a little later, and has motors or not.
  if (!lesson_ && seen.devices.hands.live) begin(first_, seen.devices.pad);
  if (first_ == "none" && seen.trial == TrialState::State::running) lesson_.reset();
  if (teaching()) taught_ = lesson_->update(seen, time);
}

void Teacher::press(drive::Button button, bool keyboard) {
  help_.forget();
  help_.hands(keyboard);
  if (button == drive::Button::help) help_.tell("help");
}

void Teacher::join(std::vector<cues::Cue>& cues, bool quiet) {
  static const std::set<Content> needed = {
      CueKind::arrived, CueKind::stuck, CueKind::stuck_unknown, CueKind::back_away,
      CueKind::release_stick, CueKind::pad_back, {CueKind::back, About::keyboard},
      {CueKind::back, About::audio}, {CueKind::back, About::picture},
      {CueKind::settings, About::of}, {CueKind::settings, About::not_saved},
      {CueKind::notice, About::no_rumble},
      {CueKind::notice, About::second_pad}, {CueKind::notice, About::pad_firmware}};
  if (speaks())
    cues.erase(std::remove_if(cues.begin(), cues.end(),
                              [](const cues::Cue& cue) {
                                return !cue.asked && cue.priority != Priority::important &&
                                       needed.count(cue) == 0;
                              }),
               cues.end());
  // A lesson speaks meanwhile only where that cannot wait.
  if (!taught_.cues.empty()) help_.forget();
  cues.insert(cues.end(), taught_.cues.begin(), taught_.cues.end());
  const std::vector<cues::Cue> help = help_.update(quiet && cues.empty());
  cues.insert(cues.end(), help.begin(), help.end());
}

}  // namespace navvi_feedback::lessons
