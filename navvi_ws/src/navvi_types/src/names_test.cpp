#include "navvi_types/names.hpp"

#include <gtest/gtest.h>

#include "navvi_types/drive_state.hpp"
#include "navvi_types/guidance.hpp"

namespace navvi_types {
namespace {

TEST(Names, EachValueIsFoundAgainByItsWordAndByItsNumber) {
  for (int i = 0; i <= static_cast<int>(ThingClass::other); ++i) {
    const auto thing = static_cast<ThingClass>(i);
    EXPECT_EQ(from_word<ThingClass>(to_string(thing)), thing);
    EXPECT_EQ(from_number<ThingClass>(static_cast<std::uint8_t>(i)), thing);
  }
  EXPECT_STREQ(to_string(ThingClass::pallet_robot), "pallet_robot");
  EXPECT_STREQ(to_string(Guidance::Refusal::unreachable), "unreachable");
  EXPECT_STREQ(to_string(Guidance::Replan::map_changed), "map_changed");
}

TEST(Names, AnotherWordOrNumberIsNothing) {
  for (const char* word : {"", "dragon", "Shelf", "shelf ", "pallet robot"})
    EXPECT_FALSE(from_word<ThingClass>(word)) << word;
  EXPECT_FALSE(from_number<DriveState::State>(3));
  EXPECT_FALSE(from_number<DriveState::State>(255));
}

}  // namespace
}  // namespace navvi_types
