#include "lessons/questionnaire.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <navvi_config/reader.hpp>
#include <utility>

namespace navvi_feedback::lessons {
namespace {

using drive::Button;
using navvi_config::ConfigError;

using Said = std::vector<std::string>;

/// Somebody who hears each sentence for half a second.
class AskedTest : public testing::Test {
 protected:
  explicit AskedTest(const Question& first)
      : asked_(cues::Phrases(NAVVI_FEEDBACK_CONFIG_DIR "/phrases/en.yaml"), {},
               {first, {"again", "Once more", {"no", "yes"}, {"no", "yes"}}}) {}

  /// \return what was said meanwhile
  Said live(double seconds, drive::Stick stick = {}, std::vector<Button> pressed = {}) {
    Said said;
    for (auto left = std::lround(seconds / 0.02); left > 0 && !asked_.over(); --left) {
      Observation seen;
      seen.pressed = std::exchange(pressed, {});
      seen.stick = stick;
      seen.voice_busy = time_ < speaks_until_;
      for (const cues::Cue& cue : asked_.update(seen, time_).cues) {
        said.push_back(cue.text);
        speaks_until_ = time_ + 0.5;
      }
      time_ += 0.02;
    }
    return said;
  }
  Said press(Button button) { return live(5.0, {}, {button}); }
  void expect_record(const std::string& row) const {
    EXPECT_NE(asked_.record().find("\n" + row), std::string::npos) << asked_.record();
  }

  Questionnaire asked_;
  double time_ = 0.0;
  double speaks_until_ = 0.0;
};

class QuestionnaireTest : public AskedTest {
 protected:
  QuestionnaireTest()
      : AskedTest(
            {"mental", "Mental demand. How much", {"0", "50", "100"}, {"low", "half", "high"}}) {
    live(60.0);
  }
};

TEST_F(QuestionnaireTest, takes_an_answer_only_once_one_was_chosen) {
  EXPECT_EQ(press(Button::start), Said{"choose first"});
  EXPECT_EQ(asked_.record(), "item,answer,seconds\n");
  EXPECT_EQ(press(Button::previous), Said{"half"});
  EXPECT_EQ(press(Button::previous), Said{"high"});
  EXPECT_EQ(press(Button::previous), Said{"high"}) << "there is no more";
  EXPECT_EQ(press(Button::start), Said{"Once more"});
  expect_record("mental,100,");
}

TEST_F(QuestionnaireTest, a_question_is_heard_again_and_its_answer_corrected_by_going_back) {
  press(Button::next);
  const Said question = {"Mental demand", "How much", "half"};
  EXPECT_EQ(press(Button::repeat), question) << "with what is chosen";
  press(Button::choose);
  EXPECT_EQ(press(Button::back), question);
  press(Button::next);
  press(Button::choose);
  expect_record("mental,0,");
  EXPECT_FALSE(asked_.over());
}

TEST_F(QuestionnaireTest, nobody_has_to_say) {
  EXPECT_EQ(press(Button::end), (Said{"rather not say", "Once more"}));
  expect_record("mental,declined,");
}

TEST_F(QuestionnaireTest, the_stick_chooses_too_step_by_step_while_it_is_held) {
  EXPECT_EQ(live(0.5, {0.0, 1.0}), Said{"half"});
  EXPECT_EQ(live(0.6, {0.0, 1.0}), Said{"high"});
  live(0.5);
  EXPECT_EQ(live(0.5, {0.0, -1.0}), Said{"half"});
}

TEST_F(QuestionnaireTest, it_ends_when_the_last_answer_is_confirmed) {
  press(Button::next);
  press(Button::choose);
  press(Button::previous);
  EXPECT_EQ(press(Button::choose).front(), "that was the last");
  EXPECT_FALSE(asked_.over());
  press(Button::choose);
  EXPECT_TRUE(asked_.over());
  expect_record("again,yes,");
}

TEST(Questions, are_read_from_a_file_and_wrong_ones_are_refused) {
  const std::string path = testing::TempDir() + "questions.yaml";
  const auto read = [&](const std::string& text) {
    std::ofstream(path) << text;
    return read_questions(path);
  };
  const auto questions =
      read("items: [{name: a, ask: How much, values: [0, 1], spoken: [none, all]}]");
  ASSERT_EQ(questions.size(), 1u);
  EXPECT_EQ(questions[0].spoken[1], "all");
  EXPECT_TRUE(read("items: [{name: a, ask: How, point: true}]").front().point);
  for (const char* wrong :
       {"", "{name: a, ask: How, point: false}", "{name: a, ask: How}",
        "{name: a, ask: How, point: true, values: [0], spoken: [a]}",
        "{name: a, ask: How, values: [0], spoken: [a, b]}",
        "{name: a, ask: \"How?\", values: [0], spoken: [a]}",
        "{name: a, ask: How, values: [\"0,1\"], spoken: [a]}",
        "{name: a, ask: How, value: [0], spoken: [a]}"})
    EXPECT_THROW(read("items: [" + std::string(wrong) + "]"), ConfigError) << wrong;
  EXPECT_THROW(read_questions("/nonexistent/questions.yaml"), ConfigError);
}

class PointingTest : public AskedTest {
 protected:
  PointingTest() : AskedTest({"goal", "Where is the goal", {}, {}, true}) {}
};

TEST_F(PointingTest, a_direction_is_pointed_corrected_and_confirmed) {
  live(60.0);
  EXPECT_EQ(press(Button::start), Said{"point first, with the stick"});
  EXPECT_EQ(press(Button::previous), Said{});
  EXPECT_EQ(live(2.0, {1.0, 0.0}), Said{"9 o'clock"});
  live(1.0);
  EXPECT_EQ(live(2.0, {-0.5, -0.87}), Said{"5 o'clock"}) << "behind, right";
  EXPECT_EQ(press(Button::start), Said{"Once more"});
  expect_record("goal,-150,");
  EXPECT_EQ(press(Button::back), (Said{"Where is the goal", "5 o'clock"}));
  press(Button::end);
  expect_record("goal,declined,");
}

TEST_F(PointingTest, a_correction_needs_a_push_of_its_own) {
  live(60.0);
  EXPECT_EQ(live(2.0, {0.0, 1.0}), Said{"straight ahead"});
  EXPECT_EQ(live(2.0, {-1.0, 0.0}), Said{}) << "not let go";
  live(1.0);
  EXPECT_EQ(live(2.0, {0.0, -1.0}), Said{"6 o'clock"});
  press(Button::start);
  expect_record("goal,180,");
}

TEST_F(PointingTest, a_direction_between_two_hours_is_said_as_those_of_the_guide_are) {
  live(60.0);
  EXPECT_EQ(live(2.0, {-0.7, -0.7}), Said{"5 o'clock"}) << "-135 degrees";
  live(1.0);
  EXPECT_EQ(live(2.0, {-0.7, -0.66}), Said{"4 o'clock"});
}

TEST(Pointed, is_said_as_the_person_wants_directions) {
  cues::WordingConfig wording;
  wording.directions = "degrees";
  Questionnaire asked(cues::Phrases(NAVVI_FEEDBACK_CONFIG_DIR "/phrases/es.yaml", wording), {},
                      {{"goal", "Meta", {}, {}, true}});
  std::string last;
  for (double time = 0.0; time < 62.0; time += 0.02) {
    Observation seen;
    if (time > 60.0) seen.stick = {1.0, 0.0};
    for (const cues::Cue& cue : asked.update(seen, time).cues) last = cue.text;
  }
  EXPECT_EQ(last, "90 grados a la izquierda");
}

TEST_F(PointingTest, a_stick_too_little_pushed_unsteady_or_not_long_enough_takes_nothing) {
  live(60.0);
  EXPECT_EQ(live(2.0, {0.5, 0.0}), Said{});
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(live(0.3, {1.0, 0.0}), Said{});
    EXPECT_EQ(live(0.3, {0.0, 1.0}), Said{});
  }
  EXPECT_EQ(live(0.4, {1.0, 0.0}), Said{});
  EXPECT_EQ(press(Button::start), Said{"point first, with the stick"});
}

TEST_F(PointingTest, a_stick_that_was_pushed_before_the_question_came_takes_nothing) {
  for (const std::string& said : live(60.0, {1.0, 0.0})) EXPECT_NE(said, "9 o'clock");
  EXPECT_EQ(press(Button::start), Said{"point first, with the stick"});
}

TEST_F(PointingTest, a_stick_that_still_points_takes_no_step_of_the_next_question) {
  live(60.0);
  live(2.0, {0.0, 1.0});
  EXPECT_EQ(live(5.0, {0.0, 1.0}, {Button::start}), Said{"Once more"});
  live(0.5);
  EXPECT_EQ(live(0.5, {0.0, 1.0}), Said{"yes"});
}

TEST_F(PointingTest, seconds_are_those_from_the_end_of_the_words_to_the_push) {
  while (live(0.02) != Said{"Where is the goal"}) ASSERT_LT(time_, 60.0);
  live(2.5 - 0.02);  // 0.5 s of them the voice speaks
  live(3.0, {0.0, -1.0});
  press(Button::start);
  expect_record("goal,180,2.0");
}

TEST_F(PointingTest, seconds_of_a_correction_are_those_to_its_own_push) {
  while (live(0.02) != Said{"Where is the goal"}) ASSERT_LT(time_, 60.0);
  live(1.5 - 0.02);
  live(1.0, {0.0, 1.0});
  live(1.0);
  live(1.0, {1.0, 0.0});
  press(Button::start);
  expect_record("goal,90,3.0");
}

TEST_F(PointingTest, a_push_before_the_words_ended_took_no_time) {
  live(0.1);
  live(2.0, {1.0, 0.0});
  press(Button::start);
  expect_record("goal,90,0.0");
}

}  // namespace
}  // namespace navvi_feedback::lessons
