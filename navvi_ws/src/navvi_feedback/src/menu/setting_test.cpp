#include "menu/setting.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

namespace navvi_feedback::menu {
namespace {

TEST(Setting, steps_up_and_down_and_stays_at_its_ends) {
  const Setting& rate = settings().front();
  EXPECT_EQ(rate.step("220", true), "240");
  EXPECT_EQ(rate.step("220", false), "200");
  EXPECT_EQ(rate.step("80", false), "80");
  EXPECT_EQ(rate.step("440", true), "449");
  EXPECT_EQ(rate.step("449", true), "449");
}

TEST(Setting, steps_from_a_value_that_is_none_of_its_own_to_the_next_that_is) {
  const Setting& rate = settings().front();
  EXPECT_EQ(rate.step("230", true), "240");
  EXPECT_EQ(rate.step("230", false), "220");
  EXPECT_EQ(rate.step("81", false), "80");
}

TEST(Setting, each_value_can_be_said) {
  for (const char* language : {"en", "es"}) {
    const cues::Phrases phrases(std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/" + language +
                                ".yaml");
    for (const Setting& setting : settings())
      for (const std::string& value : setting.values) {
        const cues::Utterance told = setting.say(About::setting_open, value);
        EXPECT_TRUE(cues::speakable(phrases.say(told, told.fillings)));
      }
  }
  const cues::Phrases english(std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml");
  const auto said = [&](std::size_t setting, const char* value) {
    const cues::Utterance told = settings()[setting].say(About::setting_changed, value);
    return english.say(told, told.fillings);
  };
  EXPECT_EQ(said(0, "240"), "speech rate 240");
  EXPECT_EQ(said(2, "0.7"), "strength of vibration 70 percent");
  EXPECT_EQ(said(3, "full"), "amount of speech full");
  EXPECT_EQ(said(4, "false"), "vibration for near things off");
}

}  // namespace
}  // namespace navvi_feedback::menu
