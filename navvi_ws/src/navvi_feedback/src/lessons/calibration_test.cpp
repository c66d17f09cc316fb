#include "lessons/calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <navvi_config/reader.hpp>

#include "sounds/sounds_config.hpp"

namespace navvi_feedback::lessons {
namespace {

using drive::Button;

/// A person who feels from a strength on, and lets go of the stick some time after the sound.
struct Person {
  double left = 0.05;
  double right = 0.12;
  double likes = 0.5;
  double delay = 0.35;  ///< s

  /// \return the settings
  std::vector<std::string> calibrate(Calibration& calibration) {
    Observation seen;
    seen.motors = motors;
    double speaks_until = 0.0;
    std::optional<double> felt;
    double go = 1e9;  ///< s, when the stick is let go
    for (double time = 10.0; time < 600.0 && !calibration.over(); time += 0.02) {
      seen.voice_busy = time < speaks_until;
      seen.pressed.clear();
      if (felt && time >= *felt) {
        seen.pressed = {Button::repeat};
        felt.reset();
      }
      if (kind == "calibrate_comfort" && !seen.voice_busy && strength > 0.0) {
        seen.pressed = {strength > likes + 0.01 ? Button::next : Button::start};
      }
      const bool stick =
          kind == "calibrate_halt" || kind == "calibrate_once_more" || kind == "calibrate_late";
      seen.stick.y = stick && !seen.voice_busy && time < go ? 1.0 : 0.0;
      if (time >= go + 0.1) go = 1e9;
      if (kind == "calibrate_confirm" && !seen.voice_busy) seen.pressed = {answer};
      const Taught taught = calibration.update(seen, time);
      for (const cues::Cue& cue : taught.cues) {
        kind = cue.word();
        told.push_back(cue.text);
        speaks_until = time + 1.0;
      }
      for (std::size_t i = 0; i < taught.plays.size(); ++i) go = time + delay;
      const bool feels =
          taught.rumble && (taught.rumble->left >= left || taught.rumble->right >= right);
      if (kind != "calibrate_comfort" && feels && !was && !felt) felt = time + 0.4;
      was = taught.rumble.has_value();
      strength = taught.rumble && kind == "calibrate_comfort" ? taught.rumble->left : 0.0;
    }
    EXPECT_TRUE(calibration.over()) << kind;
    return calibration.settings();
  }
  bool motors = true;
  bool was = false;
  double strength = 0.0;
  std::string kind;
  std::vector<std::string> told;
  Button answer = Button::start;  ///< to whether it is to be saved
};

Calibration calibration(const haptics::HapticsConfig& haptics = {}) {
  return {cues::Phrases(std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml"),
          {},
          haptics,
          "abc",
          0.1};
}

TEST(Calibration, finds_thresholds_strength_and_delay_and_keeps_other_pads) {
  haptics::HapticsConfig before;
  before.pads = {"abc 0.01 0.01 0.3", "other 0.05 0.05 1"};
  Calibration lesson = calibration(before);
  const auto words = Person{}.calibrate(lesson);
  ASSERT_EQ(words.size(), 2U);
  haptics::HapticsConfig found;
  sounds::TurnConfig turn;
  const YAML::Node node = navvi_config::read_words(words);
  navvi_config::read(found, node["haptics"], "test");
  navvi_config::read(turn, node["sounds"]["turn"], "test");
  ASSERT_EQ(found.pads.size(), 2U);
  EXPECT_EQ(found.pads[0], before.pads[1]);
  double left = 0.0, right = 0.0, gain = 0.0;
  ASSERT_EQ(std::sscanf(found.pads[1].c_str(), "abc %lf %lf %lf", &left, &right, &gain), 3);
  EXPECT_NEAR(left, 1.2 * 0.05, 0.02);
  EXPECT_NEAR(right, 1.2 * 0.12, 0.04);
  EXPECT_NEAR(gain, 0.5, 1e-9);
  EXPECT_NEAR(turn.stopping_delay, 0.35 + 0.1, 0.03);
}

TEST(Calibration, measures_the_stick_alone_where_there_are_no_motors) {
  Calibration lesson = calibration();
  Person person;
  person.motors = false;
  const auto words = person.calibrate(lesson);
  ASSERT_EQ(words.size(), 1U);
  EXPECT_EQ(words[0].rfind("sounds/turn/stopping_delay:=0.4", 0), 0U) << words[0];
}

TEST(Calibration, saves_nothing_if_it_is_ended_or_a_motor_is_not_felt) {
  Calibration lesson = calibration();
  Observation seen;
  (void)lesson.update(seen, 0.0);
  seen.pressed = {Button::end};
  (void)lesson.update(seen, 0.1);
  seen.pressed.clear();
  for (double time = 0.2; time < 1.0; time += 0.02) (void)lesson.update(seen, time);
  EXPECT_TRUE(lesson.over());
  EXPECT_TRUE(lesson.settings().empty());

  Calibration numb = calibration();
  Person person;
  person.right = 2.0;
  EXPECT_EQ(person.calibrate(numb).size(), 1U);
}

TEST(Calibration, says_what_it_found_and_saves_nothing_unless_that_is_wanted) {
  Calibration lesson = calibration();
  Person person;
  person.answer = Button::end;
  EXPECT_TRUE(person.calibrate(lesson).empty());
  EXPECT_NE(lesson.record().find("strength,0.50\n"), std::string::npos) << lesson.record();
  EXPECT_NE(lesson.record().find("saved,no\n"), std::string::npos) << lesson.record();
  const auto told = [&](const std::string& text) {
    return std::count(person.told.begin(), person.told.end(), text);
  };
  EXPECT_EQ(told("you like 50 percent of vibration"), 1);
  EXPECT_EQ(told("you let go 0.36 seconds after the notes") +
                told("you let go 0.34 seconds after the notes") +
                told("you let go 0.35 seconds after the notes"),
            1);
}

TEST(Calibration, asks_again_where_a_hand_holds_on_and_measures_nothing_from_it) {
  Calibration lesson = calibration();
  Person person;
  person.motors = false;
  person.delay = 1.0;
  EXPECT_TRUE(person.calibrate(lesson).empty());
  EXPECT_EQ(std::count(person.told.begin(), person.told.end(), "too late, once more"), 9);
}

TEST(Calibration, tells_a_prompt_again_after_a_silence_and_by_any_button) {
  Calibration lesson = calibration();
  Observation seen;
  seen.motors = false;
  int prompts = 0;
  const auto pass = [&](double from, double to) {
    for (double time = from; time < to; time += 0.02) {
      for (const cues::Cue& cue : lesson.update(seen, time).cues)
        prompts += cue.text == "push the stick and hold it" ? 1 : 0;
      seen.pressed.clear();
    }
  };
  pass(0.0, 5.0);
  EXPECT_EQ(prompts, 1);
  pass(5.0, 19.0);
  EXPECT_EQ(prompts, 2) << "after a silence";
  for (const Button button : {Button::repeat, Button::help, Button::next}) {
    seen.pressed = {button};
    const int before = prompts;
    pass(19.0, 19.2);
    EXPECT_EQ(prompts, before + 1);
  }
}

TEST(Staircase, finds_what_is_felt_wherever_it_lies) {
  for (const double threshold : {0.015, 0.03, 0.1, 0.25, 0.4}) {
    Staircase staircase;
    int answers = 0;
    for (; !staircase.done() && answers < 50; ++answers)
      staircase.answer(staircase.strength() >= threshold);
    ASSERT_TRUE(staircase.threshold()) << threshold;
    EXPECT_GT(*staircase.threshold() * 1.2, threshold * 0.9) << threshold;
    EXPECT_LT(*staircase.threshold(), threshold * 1.3) << threshold;
    EXPECT_LT(answers, 20);
  }
  Staircase always, never;
  while (!always.done()) always.answer(true);
  while (!never.done()) never.answer(false);
  EXPECT_EQ(always.threshold(), 0.01);
  EXPECT_FALSE(never.threshold());
}

}  // namespace
}  // namespace navvi_feedback::lessons
