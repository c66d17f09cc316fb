#include "devices/voice.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <string>

#include "sentences.hpp"

namespace navvi_feedback::devices {
namespace {

class EachLanguage : public testing::TestWithParam<const char*> {
 protected:
  ~EachLanguage() override { setenv("HOME", home_.c_str(), 1); }

  /// What lies on the stack of a process depends on its environment.
  unsigned unsaid_with(std::size_t longer, const Texts& texts) {
    setenv("HOME", (home_ + std::string(longer, 'x')).c_str(), 1);
    Voice voice(GetParam(), 50);
    return unsaid(voice, texts) + voice.losses();
  }

  const std::string home_ = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "/";
};
INSTANTIATE_TEST_SUITE_P(, EachLanguage, testing::Values("en", "es"));

TEST_P(EachLanguage, F4_has_phrases_that_its_voice_speaks_whatever_lies_on_the_stack) {
  Texts texts;
  for (const std::string& text : texts_in(phrases(GetParam())))
    texts.push_back(std::regex_replace(text, kGap, "7"));
  ASSERT_GT(texts.size(), 200U);
  for (const std::size_t longer : {0, 7, 14}) EXPECT_EQ(unsaid_with(longer, texts), 0U);
}

}  // namespace
}  // namespace navvi_feedback::devices
