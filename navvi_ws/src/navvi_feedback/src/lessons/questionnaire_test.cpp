#include "lessons/questionnaire.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <navvi_config/reader.hpp>
#include <utility>

namespace navvi_feedback::lessons {
namespace {

using drive::Button;
using navvi_config::ConfigError;

class QuestionnaireTest : public testing::Test {
 protected:
  QuestionnaireTest()
      : asked_(cues::Phrases(NAVVI_FEEDBACK_CONFIG_DIR "/phrases/en.yaml"), {},
               {{"mental", "Mental demand. How much", {"0", "50", "100"}, {"low", "half", "high"}},
                {"again", "Once more", {"no", "yes"}, {"no", "yes"}}}) {
    live(60.0);
  }

  /// \return what was said meanwhile
  std::vector<std::string> live(double seconds, std::vector<Button> pressed = {},
                                double forward = 0.0) {
    std::vector<std::string> said;
    for (const double end = time_ + seconds; time_ < end && !asked_.over(); time_ += 0.02) {
      Observation seen;
      seen.pressed = std::exchange(pressed, {});
      seen.stick.y = forward;
      seen.voice_busy = time_ < speaks_until_;
      for (const cues::Cue& cue : asked_.update(seen, time_).cues) {
        said.push_back(cue.text);
        speaks_until_ = time_ + 0.5;
      }
    }
    return said;
  }
  std::vector<std::string> press(Button button) { return live(5.0, {button}); }
  [[nodiscard]] std::string answer(const std::string& item) const {
    const std::string table = asked_.record();
    const std::size_t at = table.find("\n" + item + ",");
    if (at == std::string::npos) return "";
    const std::size_t begin = at + item.size() + 2;
    return table.substr(begin, table.find(',', begin) - begin);
  }

  Questionnaire asked_;
  double time_ = 0.0;
  double speaks_until_ = 0.0;
};

using Said = std::vector<std::string>;

TEST_F(QuestionnaireTest, takes_an_answer_only_once_one_was_chosen) {
  EXPECT_EQ(press(Button::start), Said{"choose first"});
  EXPECT_EQ(answer("mental"), "");
  EXPECT_EQ(press(Button::previous), Said{"half"});
  EXPECT_EQ(press(Button::previous), Said{"high"});
  EXPECT_EQ(press(Button::previous), Said{"high"}) << "there is no more";
  EXPECT_EQ(press(Button::start), Said{"Once more"});
  EXPECT_EQ(answer("mental"), "100");
}

TEST_F(QuestionnaireTest, an_answer_is_corrected_by_going_back) {
  press(Button::next);
  press(Button::choose);
  EXPECT_EQ(press(Button::back), (Said{"Mental demand", "How much", "half"}));
  press(Button::next);
  press(Button::choose);
  EXPECT_EQ(answer("mental"), "0");
  EXPECT_FALSE(asked_.over());
}

TEST_F(QuestionnaireTest, nobody_has_to_say) {
  EXPECT_EQ(press(Button::end), (Said{"rather not say", "Once more"}));
  EXPECT_EQ(answer("mental"), Questionnaire::kDeclined);
}

TEST_F(QuestionnaireTest, a_question_is_heard_again_with_what_is_chosen) {
  press(Button::next);
  EXPECT_EQ(press(Button::repeat), (Said{"Mental demand", "How much", "half"}));
}

TEST_F(QuestionnaireTest, the_stick_chooses_too_step_by_step_while_it_is_held) {
  EXPECT_EQ(live(0.5, {}, 1.0), Said{"half"});
  EXPECT_EQ(live(0.6, {}, 1.0), Said{"high"});
  live(0.5);
  EXPECT_EQ(live(0.5, {}, -1.0), Said{"half"});
}

TEST_F(QuestionnaireTest, it_ends_when_the_last_answer_is_confirmed) {
  press(Button::next);
  press(Button::choose);
  press(Button::previous);
  EXPECT_EQ(press(Button::choose).front(), "that was the last");
  EXPECT_FALSE(asked_.over());
  press(Button::choose);
  EXPECT_TRUE(asked_.over());
  EXPECT_EQ(answer("again"), "yes");
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
  EXPECT_THROW(read("items: []"), ConfigError);
  EXPECT_THROW(read("items: [{name: a, ask: How, values: [0], spoken: [a, b]}]"), ConfigError);
  EXPECT_THROW(read("items: [{name: a, ask: \"How?\", values: [0], spoken: [a]}]"), ConfigError);
  EXPECT_THROW(read("items: [{name: a, ask: How, values: [\"0,1\"], spoken: [a]}]"), ConfigError);
  EXPECT_THROW(read("items: [{name: a, ask: How, value: [0], spoken: [a]}]"), ConfigError);
  EXPECT_THROW(read_questions("/nonexistent/questions.yaml"), ConfigError);
}

}  // namespace
}  // namespace navvi_feedback::lessons
