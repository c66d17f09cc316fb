#include "navvi_people/people/simulated_operator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace navvi_people::people {
namespace {

using Moment = Speech::Moment;

constexpr double kStep = 0.02;

/// A stick with a dead zone, finer near the centre.
double shaped(double stick) {
  const double beyond = std::max(0.0, (std::abs(stick) - 0.12) / 0.88);
  return std::copysign(0.7 * beyond + 0.3 * beyond * beyond * beyond, stick);
}

/// Able, without what befalls people by chance, so that a test of one thing tests that alone.
SimulatedOperatorConfig steady(std::uint64_t seed) {
  SimulatedOperatorConfig config;
  config.seed = static_cast<int>(seed);
  config.hearing.missed_words = config.hearing.missed_sounds = config.hearing.misheard = 0.0;
  config.hearing.mirrored = config.hearing.masked = 0.0;
  config.hearing.fastest_speech = 1e6;  // sentences of tests end as they begin
  config.memory.faults = config.attention.faults = false;
  return config;
}

/// A robot without inertia on an empty floor, and a voice.
class Loop {
 public:
  explicit Loop(std::uint64_t seed = 1) : Loop(steady(seed), 1) {}
  Loop(const SimulatedOperatorConfig& config, int occasion)
      : person(config, Listener(NAVVI_PHRASES), occasion) {}

  /// The hand; the voice stays silent. \return the last of it
  StickAndButtons pass(int steps) {
    StickAndButtons hand;
    for (; steps > 0; --steps) {
      time += kStep;
      hand = person.update(time, kStep);
      const double speed = shaped(hand.forward) * (hand.forward > 0.0 ? 0.9 : 0.5);
      x += speed * std::cos(yaw) * kStep;
      y += speed * std::sin(yaw) * kStep;
      yaw += 1.2 * shaped(hand.left) * kStep;
      moved |= hand.forward != 0.0 || hand.left != 0.0;
      asked |= hand.repeat;
      presses += hand.start && !pressed_ ? 1 : 0;
      pressed_ = hand.start;
    }
    return hand;
  }

  void begin(const std::string& text) {
    person.hear(Speech{++id_, Moment::begins, text}, time);
  }
  void end(Moment moment = Moment::ends) { person.hear(Speech{id_, moment}, time); }
  /// From its first word to its last.
  void say(const std::string& text) {
    begin(text);
    end();
  }
  /// A short sound: from the left, the right or, with both, from ahead.
  void sound(Earcon earcon, double left, double right) {
    person.hear(Sound{earcon, left, right}, time);
  }

  SimulatedOperator person;
  double time = 100.0;
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  bool moved = false;
  bool asked = false;
  int presses = 0;  ///< of start

 private:
  std::uint32_t id_ = 0;
  bool pressed_ = false;
};

TEST(SimulatedOperator, asks_before_it_moves_and_then_tries_where_nobody_speaks) {
  Loop loop;
  double asked = 0.0, moved = 0.0;
  for (int i = 0; i < 500; ++i) {
    loop.pass(1);
    if (loop.asked && asked == 0.0) asked = loop.time;
    if (loop.moved && moved == 0.0) moved = loop.time;
  }
  EXPECT_GT(asked, 0.0);
  EXPECT_GT(moved, asked + 0.9);
}

TEST(SimulatedOperator, does_not_try_where_somebody_has_spoken) {
  Loop loop;
  loop.say("welcome, waiting for a goal");
  loop.pass(500);
  EXPECT_TRUE(loop.asked);
  EXPECT_FALSE(loop.moved);
}

TEST(SimulatedOperator, presses_start_once_where_words_ask_for_it_and_also_taps) {
  for (const bool tapped : {false, true}) {
    Loop loop;
    loop.pass(100);
    loop.begin("press start to begin");
    loop.pass(25);
    for (const double force : {0.5, 0.0, 0.5, 0.0}) {
      if (tapped) loop.person.feel({force, force}, loop.time);
      loop.pass(5);
    }
    if (!tapped) loop.end();
    loop.pass(155);
    EXPECT_EQ(loop.presses, 1) << tapped;
  }
}

TEST(SimulatedOperator, misses_a_first_sentence_on_some_occasions_and_not_on_all) {
  SimulatedOperatorConfig config = steady(1);
  config.hearing.faults = true;
  config.hearing.missed_words = 0.5;
  int drives = 0;
  for (int occasion = 1; occasion <= 40; ++occasion) {
    Loop loop(config, occasion);
    loop.pass(100);
    loop.begin("drive straight, 5 meters");
    loop.pass(70);
    loop.end();
    loop.pass(130);
    drives += loop.moved ? 1 : 0;
  }
  EXPECT_GT(drives, 10);
  EXPECT_LT(drives, 30);
}

/// Turns to `angle`, rad, counter-clockwise, by ticks that end `early` s before it is reached.
/// \return rad, turned too far
double turned_by_ear(std::uint64_t seed, double angle, double early) {
  Loop loop(seed);
  loop.begin("drive straight, 9 meters");
  loop.pass(200);
  bool over = false;
  bool told = false;
  double ticked = 0.0;
  double before = loop.yaw;
  const double target = loop.yaw + angle;
  for (int i = 0; i < 400; ++i) {
    const double off = target - loop.yaw;
    const double rate = (loop.yaw - before) / kStep;
    before = loop.yaw;
    over = over || (off - rate * early) * angle < 0.0;
    if (over && !told) loop.sound(Earcon::turn_stop, 0.3, 0.3);
    told = over;
    if (!over && loop.time - ticked > 0.1 + 0.4 * std::min(1.0, std::abs(off) / 1.57)) {
      ticked = loop.time;
      loop.sound(Earcon::turn, off > 0.0 ? 0.6 : 0.0, off > 0.0 ? 0.0 : 0.6);
    }
    loop.pass(1);
  }
  return (loop.yaw - target) * (angle > 0.0 ? 1.0 : -1.0);
}

TEST(SimulatedOperator, turns_by_what_sounds_and_too_far_where_that_ends_late) {
  for (const double angle : {1.5, -1.5, 3.0}) {
    double late = 0.0;
    double early = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      late += turned_by_ear(seed, angle, 0.0) / 10.0;
      early += turned_by_ear(seed, angle, 0.3) / 10.0;
    }
    EXPECT_GT(late, 0.12) << angle;
    EXPECT_NEAR(early, 0.0, 0.12) << angle;
  }
}

TEST(SimulatedOperator, does_not_turn_back_what_a_sound_led_while_it_was_told_to_go_on) {
  Loop loop;
  loop.begin("drive straight, 9 meters");
  loop.pass(200);
  loop.begin("go on, drive straight, 9 meters");
  for (int i = 0; i < 4; ++i) {
    loop.sound(Earcon::turn, 0.6, 0.0);
    loop.pass(10);
  }
  loop.sound(Earcon::turn_stop, 0.3, 0.3);
  loop.pass(30);
  const double turned = loop.yaw;
  EXPECT_GT(turned, 0.1);
  loop.end();
  loop.pass(100);
  EXPECT_NEAR(loop.yaw, turned, 0.1);
}

TEST(SimulatedOperator, does_not_act_on_what_was_cut_off) {
  Loop loop;
  loop.begin("drive straight, 8 meters");
  loop.pass(1);
  loop.end(Moment::breaks_off);
  loop.pass(250);
  EXPECT_FALSE(loop.moved);
}

TEST(SimulatedOperator, takes_time_to_react) {
  Loop loop;
  loop.pass(100);
  loop.say("drive straight, 8 meters");
  const double heard = loop.time;
  while (!loop.moved && loop.time < heard + 3.0) loop.pass(1);
  EXPECT_GE(loop.time - heard, 0.3);
  EXPECT_LE(loop.time - heard, 1.3);
}

TEST(SimulatedOperator, backs_off_when_it_hears_that_it_hit_something) {
  Loop loop;
  loop.pass(100);
  loop.say("hit a shelf ahead");
  loop.pass(150);
  EXPECT_LT(loop.x, -0.1);
}

TEST(SimulatedOperator, lets_go_at_the_word_that_something_was_hit) {
  Loop loop;
  loop.pass(100);
  loop.say("drive straight, 8 meters");
  loop.pass(150);
  loop.begin("hit a pallet robot on your right");
  EXPECT_EQ(loop.pass(46).forward, 0.0) << "the sentence is not over yet";
}

TEST(SimulatedOperator, takes_one_o_clock_for_less_after_straight_ahead) {
  const auto turned_by = [](std::uint64_t seed, const char* first) {
    Loop loop(seed);
    loop.pass(100);
    loop.say(first);
    loop.pass(150);
    const double before = loop.yaw;
    loop.say("turn to 1 o'clock, 8 meters");
    loop.pass(150);
    return before - loop.yaw;
  };
  double after_turn = 0.0, after_straight = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    after_turn += turned_by(seed, "turn to 1 o'clock, 8 meters") / 50.0;
    after_straight += turned_by(seed, "drive straight, 8 meters") / 50.0;
  }
  EXPECT_GT(after_turn, after_straight + 0.1);
}

TEST(SimulatedOperator, stops_for_what_is_ahead_until_it_is_told_to_go_on) {
  Loop loop;
  loop.pass(100);
  loop.say("drive straight, 8 meters");
  loop.pass(150);
  loop.say("shelf ahead");
  loop.pass(60);
  const double stopped = loop.x;
  loop.pass(100);
  EXPECT_EQ(loop.x, stopped);
  EXPECT_TRUE(loop.asked);
  loop.say("drive straight, 6 meters");
  loop.pass(100);
  EXPECT_GT(loop.x, stopped);
}

TEST(SimulatedOperator, who_is_led_by_hand_drives_off_to_the_other_side_of_what_holds_the_robot) {
  SimulatedOperatorConfig config = steady(1);
  config.lead = "hand";
  config.feeling.faults = false;
  Loop loop(config, 1);
  const auto feel_four_taps = [&] {
    for (int tap = 0; tap < 4; ++tap)
      for (const double force : {0.8, 0.0}) {
        loop.person.feel({force, force}, loop.time);
        loop.pass(4);
      }
  };
  /// The next move of the stick, forward, within 4 s.
  const auto pushes = [&] {
    double forward = 0.0;
    for (int i = 0; i < 200 && forward == 0.0; ++i) forward = loop.pass(1).forward;
    return forward;
  };
  loop.pass(100);
  loop.say("welcome, waiting for a goal");
  loop.pass(100);
  feel_four_taps();
  EXPECT_LT(pushes(), 0.0);
  feel_four_taps();
  while (loop.pass(1).forward < 0.0) continue;
  const double held = loop.x;
  EXPECT_GT(pushes(), 0.0);
  loop.pass(200);
  EXPECT_NEAR(loop.x, held + 0.5, 0.2) << "a little";
}

TEST(SimulatedOperator, goes_slower_while_both_motors_are_strong) {
  const auto covered = [](double motors) {
    Loop loop;
    loop.pass(100);
    loop.person.feel({motors, motors}, loop.time);
    loop.say("drive straight, 20 meters");
    loop.pass(200);
    return loop.x;
  };
  EXPECT_LT(covered(0.9), 0.75 * covered(0.0));
  EXPECT_GT(covered(0.9), 0.1);
}

}  // namespace
}  // namespace navvi_people::people
