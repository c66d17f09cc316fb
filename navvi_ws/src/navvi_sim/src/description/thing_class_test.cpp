#include <gtest/gtest.h>

#include "description/sentence.hpp"

namespace navvi_sim {
namespace {

TEST(ThingClassNames, come_back_as_the_class_they_name) {
  for (int i = 0; i <= static_cast<int>(ThingClass::other); ++i) {
    const auto thing_class = static_cast<ThingClass>(i);
    EXPECT_EQ(navvi_types::from_word<ThingClass>(to_string(thing_class)), thing_class);
  }
}

TEST(ThingClassNames, are_the_only_words_taken) {
  for (const char* word : {"", "Shelf", "shelf ", "robot", "pallet robot"})
    EXPECT_FALSE(navvi_types::from_word<ThingClass>(word).has_value()) << word;
}

}  // namespace
}  // namespace navvi_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
