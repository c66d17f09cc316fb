#include "navvi_config/writer.hpp"

#include <gtest/gtest.h>

#include "navvi_config/reader.hpp"

namespace navvi_config {
namespace {

struct Inner {
  std::string text;
  std::vector<double> numbers;
  void describe(Visitor& visit) {
    visit(text, "text", Any{}, "", "any");
    visit(numbers, "numbers", Any{}, "", "some");
  }
};

struct Config {
  double number = 0.0;
  int count = 0;
  bool on = false;
  std::vector<std::string> words;
  Inner inner;
  void describe(Visitor& visit) {
    visit(number, "number", Any{}, "", "any");
    visit(count, "count", Any{}, "", "any");
    visit(on, "on", Any{}, "", "whether");
    visit(words, "words", Any{}, "", "some");
    visit.group("inner", inner);
  }
};

TEST(Writer, what_is_written_is_read_back_bit_for_bit) {
  for (const double number : {0.1, 1.0 / 3.0, -2.5e-17, 1e300, -0.0, 3.0}) {
    Config config{number, -7, true, {"a b", "it's: \"so\"", ""}, {"1,-9,1.57\n", {number, 0.2}}};
    Config again;
    read(again, YAML::Load(write(config)), "what was written");
    EXPECT_EQ(again.number, config.number);
    EXPECT_EQ(again.count, config.count);
    EXPECT_EQ(again.on, config.on);
    EXPECT_EQ(again.words, config.words);
    EXPECT_EQ(again.inner.text, config.inner.text);
    EXPECT_EQ(again.inner.numbers, config.inner.numbers);
  }
}

TEST(Writer, empty_lists_and_texts_stay_empty) {
  Config again;
  again.words = {"gone"};
  again.inner.text = "gone";
  read(again, YAML::Load(write(Config{})), "what was written");
  EXPECT_TRUE(again.words.empty());
  EXPECT_EQ(again.inner.text, "");
}

}  // namespace
}  // namespace navvi_config
