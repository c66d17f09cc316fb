#include "people/listener.hpp"

#include <gtest/gtest.h>

namespace navvi_study::people {
namespace {

TEST(Listener, understands_the_sentences_of_the_voice) {
  const auto understand = [listener = Listener(NAVVI_PHRASES)](const std::string& text) {
    const auto parts = listener.understand("", text);
    return parts.empty() ? Instruction{} : parts.front();
  };
  using Kind = Instruction::Kind;
  const std::vector<std::pair<const char*, Kind>> sentences = {
      {"", Kind::nothing},
      {"2 o'clock, 5 meters", Kind::turn},
      {"12 o'clock, 5 meters", Kind::straight},
      {"a little right, 3 meters", Kind::turn},
      {"straight ahead, 4 meters, then 2 o'clock", Kind::straight},
      {"no turn, straight ahead, 9 meters", Kind::straight},
      {"half right, 3 meters", Kind::turn},
      {"make room for a forklift, half right, 2 meters", Kind::turn},
      {"in 4 meters, turn right", Kind::turn_ahead},
      {"back away, shelf ahead", Kind::bump},
      {"forklift coming, behind", Kind::near},
      {"go on, straight ahead, 19 meters", Kind::straight},
      {"go on, make room for something, half right, 2 meters", Kind::turn},
      {"go on, straight ahead, 3 meters, goal 18 meters, 10 o'clock", Kind::straight},
      {"robot stopped, release the keys", Kind::halt},
      {"hit something ahead", Kind::bump},
      {"go on, a little left, 3 meters", Kind::turn},
      {"straight ahead, 1 meter", Kind::straight},
      {"turn to 9 o'clock now", Kind::turn},
      {"in 6 meters, turn to 3 o'clock", Kind::turn_ahead},
      {"new route, 4 o'clock, 3 meters", Kind::turn},
      {"Ready. Goal 20 meters, 3 o'clock", Kind::ready},
      {"shelf on the left", Kind::near},
      {"wall ahead", Kind::near},
      {"hit a pallet robot on the right", Kind::bump},
      {"stuck, shelf ahead", Kind::bump},
      {"no path from here, back away", Kind::bump},
      {"robot stopped, release the stick", Kind::halt},
      {"no route to the goal", Kind::halt},
      {"goal refused, it is off the map", Kind::halt},
      {"You have reached your destination", Kind::arrived},
      {"90 degrees left, 12 feet", Kind::turn},
      {"turn 180 degrees now", Kind::turn},
      {"3 o'clock", Kind::turn},
      {"straight, then 3 o'clock", Kind::straight},
      {"in 20 feet, 60 degrees right", Kind::turn_ahead},
      {"wait, worker", Kind::halt},
      {"wait, box in the way, I will say when to go on", Kind::halt},
      {"You have reached the goal", Kind::arrived}};
  for (const auto& [text, kind] : sentences) EXPECT_EQ(understand(text).kind, kind) << text;
  EXPECT_EQ(understand("turn to 11 o'clock now").hour, 11);
  EXPECT_EQ(understand("in 6 meters, turn to 3 o'clock").hour, 3);
  EXPECT_TRUE(understand("shelf very close, on the left").very_close);
  EXPECT_EQ(understand("a little left, 3 meters").hour, 11);
  EXPECT_TRUE(understand("a little left, 3 meters").slight);
  EXPECT_EQ(understand("straight ahead, 4 meters, then 2 o'clock").distance, 4.0);
  EXPECT_EQ(understand("half right, 3 meters").hour, 2);
  EXPECT_EQ(understand("turn sharp left now").hour, 8);
  EXPECT_EQ(understand("in 4 meters, turn right").hour, 3);
  EXPECT_EQ(understand("turn around now").hour, 6);
  EXPECT_EQ(understand("90 degrees left, 12 feet").hour, 9);
  EXPECT_EQ(understand("30 degrees right, 1 foot").hour, 1);
  EXPECT_NEAR(*understand("90 degrees left, 12 feet").distance, 3.66, 0.01);
  EXPECT_FALSE(understand("shelf on the left").very_close);
  EXPECT_EQ(understand("stop, worker ahead").kind, Instruction::Kind::near);
  EXPECT_EQ(understand("stop, worker ahead").side, Instruction::Side::ahead);
  EXPECT_EQ(understand("2 o'clock, 15 meters").distance, 15.0);
  EXPECT_EQ(understand("hit a wall on the right").side, Instruction::Side::right);
  EXPECT_EQ(understand("no path from here, back away").side, Instruction::Side::none);
}

TEST(Listener, takes_a_sentence_of_two_parts_as_both) {
  const Listener listener(NAVVI_PHRASES);
  const auto parts = listener.understand("shelf_near", "shelf ahead, a little left, 2 meters");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].kind, Instruction::Kind::near);
  EXPECT_EQ(parts[0].side, Instruction::Side::ahead);
  EXPECT_EQ(parts[1].kind, Instruction::Kind::turn);
  EXPECT_EQ(parts[1].hour, 11);
  EXPECT_TRUE(listener.understand("direction", "3 oranges, 2 meters").empty());
}

TEST(Listener, speaks_spanish) {
  const Listener listener(std::filesystem::path(NAVVI_PHRASES).replace_filename("es.yaml"));
  const auto stop = listener.understand("obstacle_stop", "pare, estantería delante");
  EXPECT_EQ(stop.size(), 1U);
  const auto go_on = listener.understand("straight", "libre, recto, 7 metros");
  ASSERT_EQ(go_on.size(), 1U);
  EXPECT_EQ(go_on[0].kind, Instruction::Kind::straight);
  EXPECT_TRUE(go_on[0].goes_on);
}

TEST(Listener, lets_go_at_the_first_word_of_what_startles) {
  const Listener listener(NAVVI_PHRASES);
  EXPECT_FALSE(listener.startles("obstacle_stop", "stop, worker ahead", 3.0));
  EXPECT_TRUE(listener.startles("obstacle_stop", "stop, worker ahead", 4.0));
  EXPECT_FALSE(listener.startles("obstacle_near", "worker ahead", 10.0));
}

}  // namespace
}  // namespace navvi_study::people
