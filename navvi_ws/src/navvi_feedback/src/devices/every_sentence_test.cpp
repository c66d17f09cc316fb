#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "sentences.hpp"

namespace navvi_feedback::devices {
namespace {

/// Each phrase once for each distance in its gap for one, or for each word in another.
Texts sentences(const std::string& language) {
  const YAML::Node file = phrases(language);
  const Texts words = texts_in(file["words"]);
  Texts distances;
  for (int i = 0; i <= 300; ++i)
    for (const char* unit : {"meters", "feet"})
      distances.push_back(std::to_string(i) + " " + file["words"][unit].as<std::string>());
  std::set<std::string> all(distances.begin(), distances.end());
  for (const std::string& text : texts_in(file)) {
    const bool far = text.find("{distance}") != text.npos;
    const bool has_gap = std::regex_search(text, kGap);
    for (const std::string& filling : far ? distances : has_gap ? words : Texts{""})
      all.insert(std::regex_replace(text, kGap, filling));
  }
  return {all.begin(), all.end()};
}

class EverySentence : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, EverySentence, testing::Values("en", "es"));

TEST_P(EverySentence, F4_is_spoken_by_one_voice) {
  const Texts texts = sentences(GetParam());
  ASSERT_GT(texts.size(), 15'000U);
  Voice voice(GetParam(), 50);
  EXPECT_EQ(unsaid(voice, texts), 0U);
  EXPECT_EQ(voice.losses(), 0U);
}

}  // namespace
}  // namespace navvi_feedback::devices
