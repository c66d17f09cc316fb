#include "guide/second_ask.hpp"

#include <gtest/gtest.h>

namespace navvi_nav::guide {
namespace {

using Refusal = Guidance::Refusal;

const Point kThere{20.0, 3.0};

/// After a goal there that was stamped 10 s was refused at 11 s.
SecondAsk refused(Refusal why = Refusal::not_seen) {
  SecondAsk ask;
  EXPECT_FALSE(ask.agrees(kThere, 10.0));
  ask.refused(kThere, why, 11.0);
  return ask;
}

TEST(SecondAsk, is_a_goal_at_the_refused_place_with_a_newer_stamp) {
  for (const Refusal why : {Refusal::not_seen, Refusal::off_the_map})
    EXPECT_TRUE(refused(why).agrees({20.3, 3.3}, 12.0));
  EXPECT_FALSE(refused().agrees({20.5, 3.5}, 12.0)) << "another place";
}

TEST(SecondAsk, is_no_goal_that_a_program_sends_again) {
  SecondAsk ask = refused();
  for (const double stamp : {10.0, 0.0, 11.0}) EXPECT_FALSE(ask.agrees(kThere, stamp)) << stamp;
  EXPECT_TRUE(ask.agrees(kThere, 12.0));
}

TEST(SecondAsk, holds_for_the_same_message_sent_again_until_that_is_refused_too) {
  SecondAsk ask = refused();
  ASSERT_TRUE(ask.agrees(kThere, 12.0));
  EXPECT_TRUE(ask.agrees(kThere, 12.0));
  EXPECT_FALSE(ask.agrees(kThere, 13.0)) << "nothing was refused since";
  ask.refused(kThere, Refusal::not_seen, 14.0);
  EXPECT_FALSE(ask.agrees(kThere, 12.0));
  EXPECT_TRUE(ask.agrees(kThere, 15.0));
}

TEST(SecondAsk, is_forgotten_for_another_goal_of_the_person_and_not_for_one_that_is_restored) {
  SecondAsk restored = refused();
  EXPECT_FALSE(restored.agrees({5.0, 5.0}, 9.0));
  EXPECT_TRUE(restored.agrees(kThere, 13.0));
  SecondAsk other = refused();
  EXPECT_FALSE(other.agrees({5.0, 5.0}, 12.0));
  EXPECT_FALSE(other.agrees(kThere, 13.0));
}

TEST(SecondAsk, leaves_what_was_agreed_to_while_another_goal_is_refused) {
  SecondAsk ask = refused();
  ASSERT_TRUE(ask.agrees(kThere, 12.0));
  ASSERT_FALSE(ask.agrees({40.0, 3.0}, 20.0));
  ask.refused({40.0, 3.0}, Refusal::off_the_map, 20.5);
  EXPECT_TRUE(ask.agrees(kThere, 12.0)) << "restored";
  EXPECT_TRUE(ask.agrees({40.0, 3.0}, 25.0));
}

TEST(SecondAsk, is_of_no_use_where_something_stands) {
  for (const Refusal why : {Refusal::inside_obstacle, Refusal::unreachable, Refusal::unknown_frame})
    EXPECT_FALSE(refused(why).agrees(kThere, 12.0));
}

}  // namespace
}  // namespace navvi_nav::guide
