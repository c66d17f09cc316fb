#include "core/side_question.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::core {
namespace {

/// A person who is asked, and moves the stick `hand` times to the side of the sound.
struct Asked {
  std::optional<bool> answer;
  int sounds = 0;
  bool asks = false;
};
Asked ask(SideQuestion& question, double hand, double seconds, bool may = true) {
  Asked asked;
  double side = 0.0;
  for (double time = 7.0; time < 7.0 + seconds; time += 0.02) {
    const double aside = time > 9.0 ? hand * side : 0.0;
    if (const auto answer = question.update(may, true, aside, time)) asked.answer = answer;
    if (question.sounds()) {
      side = *question.sounds();
      ++asked.sounds;
    }
  }
  asked.asks = question.asks();
  return asked;
}

TEST(SideQuestion, is_answered_by_the_stick_once_its_words_were_heard) {
  SideQuestion question;
  EXPECT_EQ(ask(question, 1.0, 5.0).sounds, 0);
  EXPECT_TRUE(question.asks());
  question.told();
  const Asked asked = ask(question, 1.0, 5.0);
  EXPECT_GE(asked.sounds, 2);
  EXPECT_EQ(asked.answer, true);
  EXPECT_FALSE(asked.asks);
  EXPECT_EQ(ask(question, 1.0, 20.0).sounds, 0) << "once";
}

TEST(SideQuestion, knows_the_wrong_side) {
  SideQuestion question;
  question.told();
  EXPECT_EQ(ask(question, -1.0, 5.0).answer, false);
}

TEST(SideQuestion, waits_for_no_answer_for_ever_and_ends_with_the_begin_of_a_trial) {
  SideQuestion silent;
  silent.told();
  const Asked asked = ask(silent, 0.0, 13.0);
  EXPECT_FALSE(asked.answer);
  EXPECT_FALSE(asked.asks);
  SideQuestion begun;
  begun.told();
  EXPECT_TRUE(ask(begun, 0.0, 2.0).asks);
  EXPECT_FALSE(ask(begun, 0.0, 0.1, false).asks);
  EXPECT_FALSE(ask(begun, 0.0, 1.0).asks);
}

TEST(SideQuestion, takes_a_stick_that_is_held_before_the_sound_for_no_answer) {
  SideQuestion question;
  question.told();
  for (double time = 7.0; time < 9.0; time += 0.02)
    EXPECT_FALSE(question.update(true, true, 1.0, time));
}

}  // namespace
}  // namespace navvi_feedback::core
