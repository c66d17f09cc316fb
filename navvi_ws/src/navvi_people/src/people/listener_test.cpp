#include "navvi_people/people/listener.hpp"

#include <gtest/gtest.h>

namespace navvi_people::people {
namespace {

TEST(Listener, understands_the_sentences_of_the_voice) {
  const auto understand = [listener = Listener(NAVVI_PHRASES)](const std::string& text) {
    const auto parts = listener.understand(text);
    return parts.empty() ? Instruction{} : parts.front();
  };
  const std::vector<std::pair<const char*, Ask>> sentences = {
      {"", Ask::nothing},
      {"turn to 2 o'clock, 5 meters", Ask::turn},
      {"turn to 12 o'clock, 5 meters", Ask::go},
      {"keep a little right, 3 meters", Ask::turn},
      {"drive straight, 4 meters, then turn to 2 o'clock", Ask::go},
      {"no turn, drive straight, 9 meters", Ask::go},
      {"turn half right, 3 meters", Ask::turn},
      {"move half right, 2 meters, to let a forklift pass", Ask::turn},
      {"in 4 meters, turn right", Ask::turn_ahead},
      {"back away, shelf ahead", Ask::back},
      {"forklift coming, behind you", Ask::beware},
      {"go on, drive straight, 19 meters", Ask::go},
      {"go on, move to 2 o'clock, 2 meters, to let something pass", Ask::turn},
      {"go on, drive straight, 3 meters, the goal is 18 meters on, at 10 o'clock", Ask::go},
      {"robot stopped, release the keys", Ask::halt},
      {"hit something ahead", Ask::back},
      {"go on, keep a little left, 3 meters", Ask::turn},
      {"drive straight, 1 meter", Ask::go},
      {"turn to 9 o'clock now", Ask::turn},
      {"in 6 meters, turn to 3 o'clock", Ask::turn_ahead},
      {"new route, 4 o'clock, 3 meters", Ask::turn},
      {"the goal is 20 meters along the path, at 3 o'clock", Ask::ready},
      {"packing table, pick, then press start", Ask::begin},
      {"shelf on your left", Ask::beware},
      {"wall ahead", Ask::beware},
      {"hit a pallet robot on your right", Ask::back},
      {"stuck, shelf ahead", Ask::back},
      {"no path starts here, back up a little", Ask::back},
      {"robot stopped, release the stick", Ask::halt},
      {"there is no route to the goal", Ask::halt},
      {"goal refused, it is off the map, choose it again to go toward it", Ask::halt},
      {"not all of that place is seen yet, going toward it", Ask::ready},
      {"the goal is seen now, 12 meters along the path", Ask::ready},
      {"you have reached the goal", Ask::rest},
      {"turn 90 degrees left, 12 feet", Ask::turn},
      {"turn 180 degrees now", Ask::turn},
      {"3 o'clock", Ask::turn},
      {"straight, then 3 o'clock", Ask::go},
      {"in 20 feet, 60 degrees right", Ask::turn_ahead},
      {"wait, worker", Ask::halt},
      {"wait, box in the way", Ask::halt},
      {"goal reached", Ask::rest},
      {"push the stick forward", Ask::go},
      {"wrong way, turn to 6 o'clock", Ask::turn}};
  for (const auto& [text, kind] : sentences) EXPECT_EQ(understand(text).asks, kind) << text;
  EXPECT_EQ(understand("turn to 11 o'clock now").hour, 11);
  EXPECT_EQ(understand("in 6 meters, turn to 3 o'clock").hour, 3);
  EXPECT_TRUE(understand("shelf very close, on your left").very_close);
  EXPECT_EQ(understand("keep a little left, 3 meters").hour, 11);
  EXPECT_TRUE(understand("keep a little left, 3 meters").slight);
  EXPECT_EQ(understand("drive straight, 4 meters, then turn to 2 o'clock").distance, 4.0);
  EXPECT_EQ(understand("turn half right, 3 meters").hour, 2);
  EXPECT_EQ(understand("turn sharp left now").hour, 8);
  EXPECT_EQ(understand("in 4 meters, turn right").hour, 3);
  EXPECT_EQ(understand("turn around now").hour, 6);
  EXPECT_EQ(understand("turn 90 degrees left, 12 feet").hour, 9);
  EXPECT_EQ(understand("turn 30 degrees right, 1 foot").hour, 1);
  EXPECT_NEAR(*understand("turn 90 degrees left, 12 feet").distance, 3.66, 0.01);
  EXPECT_FALSE(understand("shelf on your left").very_close);
  EXPECT_EQ(understand("stop, worker ahead").asks, Ask::beware);
  EXPECT_EQ(understand("stop, worker ahead").side, Instruction::Side::ahead);
  EXPECT_EQ(understand("turn to 2 o'clock, 15 meters").distance, 15.0);
  EXPECT_EQ(understand("hit a wall on your right").side, Instruction::Side::right);
  EXPECT_EQ(understand("no path starts here, back up a little").side, Instruction::Side::none);
}

TEST(Listener, takes_a_sentence_of_two_parts_as_both) {
  const Listener listener(NAVVI_PHRASES);
  const auto parts =
      listener.understand(CueKind::near, "shelf ahead, keep a little left, 2 meters");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].asks, Ask::beware);
  EXPECT_EQ(parts[0].side, Instruction::Side::ahead);
  EXPECT_EQ(parts[1].asks, Ask::turn);
  EXPECT_EQ(parts[1].hour, 11);
  EXPECT_TRUE(listener.understand(CueKind::direction, "3 oranges, 2 meters").empty());
}

TEST(Listener, speaks_spanish) {
  const Listener listener(std::filesystem::path(NAVVI_PHRASES).replace_filename("es.yaml"));
  const auto stop = listener.understand(CueKind::obstacle_stop, "pare, estantería delante");
  EXPECT_EQ(stop.size(), 1U);
  const auto go_on = listener.understand(CueKind::straight, "siga, vaya recto, 7 metros");
  ASSERT_EQ(go_on.size(), 1U);
  EXPECT_EQ(go_on[0].asks, Ask::go);
  EXPECT_TRUE(go_on[0].goes_on);
}

TEST(Listener, lets_go_at_the_first_word_of_what_startles) {
  const Listener listener(NAVVI_PHRASES);
  EXPECT_FALSE(listener.first_word("stop, worker ahead", 3.0).startles);
  EXPECT_TRUE(listener.first_word("stop, worker ahead", 4.0).startles);
  EXPECT_TRUE(listener.first_word("stop, worker ahead", 4.0).holds);
  EXPECT_TRUE(listener.first_word("hit a shelf ahead", 10.0).startles);
  EXPECT_FALSE(listener.first_word("hit a shelf ahead", 10.0).holds);
  EXPECT_FALSE(listener.first_word("worker ahead", 10.0).startles);
}

TEST(Listener, makes_the_same_of_words_alone_as_of_words_whose_kind_it_knows) {
  const Listener listener(NAVVI_PHRASES);
  const std::vector<std::pair<CueKind, const char*>> sentences = {
      {CueKind::direction, "turn to 2 o'clock, 5 meters"},
      {CueKind::obstacle_stop, "stop, worker ahead"},
      {CueKind::blocked, "wait, pallet robot in the way"},
      {CueKind::close, "shelf very close, on your left"},
      {CueKind::collision, "hit again, wall ahead"},
      {CueKind::slight, "keep more to the left, 3 meters"},
      {CueKind::around, "shelf 1 meter left"},
      {CueKind::around, "shelf left"},
      {CueKind::goal_info, "the goal is 18 meters on, at 10 o'clock"}};
  for (const auto& [kind, text] : sentences) {
    const auto known = listener.understand(kind, text);
    const auto alone = listener.understand(text);
    ASSERT_FALSE(known.empty()) << text;
    const Instruction first = alone.empty() ? Instruction{} : alone.front();
    EXPECT_EQ(first.asks, known.front().asks) << text;
    EXPECT_EQ(first.very_close, known.front().very_close) << text;
    EXPECT_EQ(first.holds, known.front().holds) << text;
    if (alone.empty()) continue;
    EXPECT_EQ(first.hour, known.front().hour) << text;
    EXPECT_EQ(first.side, known.front().side) << text;
  }
}

}  // namespace
}  // namespace navvi_people::people
