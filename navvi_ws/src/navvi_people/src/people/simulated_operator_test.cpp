#include "navvi_people/people/simulated_operator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace navvi_people::people {
namespace {

using Moment = Speech::Moment;

constexpr double kStep = 0.02;
constexpr double kPi = 3.14159265358979323846;

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

struct Point {
  double x;
  double y;
};

/// A robot without inertia on an empty floor, and a voice that leads it from corner to corner.
class Loop {
 public:
  Loop(std::uint64_t seed, std::vector<Point> corners)
      : person(steady(seed), NAVVI_PHRASES, 1), corners_(std::move(corners)) {}

  /// One step of the hand; the voice stays silent.
  StickAndButtons step() {
    time += kStep;
    const auto hand = person.update(time, kStep);
    const double speed = shaped(hand.forward) * (hand.forward > 0.0 ? 0.9 : 0.5);
    x += speed * std::cos(yaw) * kStep;
    y += speed * std::sin(yaw) * kStep;
    yaw += 1.2 * shaped(hand.left) * kStep;
    moved |= hand.forward != 0.0 || hand.left != 0.0;
    asked |= hand.repeat;
    return hand;
  }

  void say(const std::string& text) {
    ++id_;
    person.hear(Speech{id_, Moment::begins, text}, time);
    speaking_until_ = time + 0.4 + static_cast<double>(text.size()) / 18.0;
    speaking_ = true;
  }

  /// Leads to the last corner. False if it takes longer than `limit` seconds.
  bool lead(double limit) {
    const double end = time + limit;
    while (time < end && !person.arrived()) {
      const auto hand = step();
      if (speaking_ && time >= speaking_until_) {
        person.hear(Speech{id_, Moment::ends}, time);
        speaking_ = false;
      }
      if (distance() < 1.0 && next_ + 1 < corners_.size()) {
        ++next_;
        last_hour_ = 0;
      }
      if (!speaking_) speak(hand.repeat);
    }
    return person.arrived();
  }

  SimulatedOperator person;
  double time = 100.0;
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  bool moved = false;
  bool asked = false;

 private:
  [[nodiscard]] double distance() const {
    return std::hypot(corners_[next_].x - x, corners_[next_].y - y);
  }

  void speak(bool repeat) {
    // What is said refers to where the robot points when it is said: it has to be done by then.
    if (time < speaking_until_ + 1.5) return;
    if (next_ + 1 == corners_.size() && distance() < 1.0) {
      return say("you have reached the goal");
    }
    double angle = yaw - std::atan2(corners_[next_].y - y, corners_[next_].x - x);
    while (angle < 0.0) angle += 2.0 * kPi;
    const int hour = static_cast<int>(std::lround(angle / (kPi / 6.0))) % 12;
    const double patience = hour == 0 ? 8.0 : 4.0;
    if (!repeat && hour == last_hour_ && time - said_ < patience) return;
    last_hour_ = hour;
    said_ = time;
    const std::string meters = std::to_string(std::lround(distance())) + " meters";
    say(hour == 0 ? "drive straight, " + meters
                  : "turn to " + std::to_string(hour) + " o'clock, " + meters);
  }

  std::vector<Point> corners_;
  std::size_t next_ = 0;
  std::uint32_t id_ = 0;
  bool speaking_ = false;
  double speaking_until_ = 0.0;
  int last_hour_ = -1;
  double said_ = -1e9;
};

const std::vector<Point> kAroundACorner = {{8.0, 0.0}, {8.0, -6.0}, {2.0, -6.0}};

TEST(SimulatedOperator, asks_before_it_moves_and_then_tries_where_nobody_speaks) {
  Loop loop(1, kAroundACorner);
  double asked = 0.0, moved = 0.0;
  for (int i = 0; i < 500; ++i) {
    (void)loop.step();
    if (loop.asked && asked == 0.0) asked = loop.time;
    if (loop.moved && moved == 0.0) moved = loop.time;
  }
  EXPECT_GT(asked, 0.0);
  EXPECT_GT(moved, asked + 0.9);
}

TEST(SimulatedOperator, does_not_try_where_somebody_has_spoken) {
  Loop loop(1, kAroundACorner);
  loop.say("welcome, waiting for a goal");
  loop.person.hear(Speech{1, Moment::ends}, loop.time);
  for (int i = 0; i < 500; ++i) (void)loop.step();
  EXPECT_TRUE(loop.asked);
  EXPECT_FALSE(loop.moved);
}

TEST(SimulatedOperator, presses_start_when_it_is_told_to) {
  SimulatedOperator person(steady(1), NAVVI_PHRASES, 1);
  int presses = 0;
  bool down = false;
  for (int tick = 0; tick < 300; ++tick) {
    const double time = 0.02 * tick;
    if (tick == 100) person.hear(Speech{1, Moment::begins, "press start to begin"}, time);
    if (tick == 150) person.hear(Speech{1, Moment::ends}, time);
    const bool start = person.update(time, 0.02).start;
    presses += start && !down ? 1 : 0;
    down = start;
  }
  EXPECT_EQ(presses, 1);
}

TEST(SimulatedOperator, presses_start_once_where_words_and_taps_ask_for_it) {
  SimulatedOperator person(steady(1), NAVVI_PHRASES, 1);
  int presses = 0;
  bool down = false;
  for (int tick = 0; tick < 300; ++tick) {
    const double time = 0.02 * tick;
    if (tick == 100) person.hear(Speech{1, Moment::begins, "press start to begin"}, time);
    const bool tapped = (tick >= 125 && tick < 130) || (tick >= 135 && tick < 140);
    person.feel(tapped ? Felt{0.5, 0.5} : Felt{}, time);
    const bool start = person.update(time, 0.02).start;
    presses += start && !down ? 1 : 0;
    down = start;
  }
  EXPECT_EQ(presses, 1);
}

TEST(SimulatedOperator, misses_a_first_sentence_on_some_occasions_and_not_on_all) {
  SimulatedOperatorConfig config = steady(1);
  config.hearing.faults = true;
  config.hearing.missed_words = 0.5;
  int drives = 0;
  for (int occasion = 1; occasion <= 40; ++occasion) {
    SimulatedOperator person(config, NAVVI_PHRASES, occasion);
    bool moved = false;
    for (int tick = 0; tick < 300; ++tick) {
      const double time = 0.02 * tick;
      if (tick == 100) person.hear(Speech{1, Moment::begins, "drive straight, 5 meters"}, time);
      if (tick == 170) person.hear(Speech{1, Moment::ends}, time);
      moved |= person.update(time, 0.02).forward > 0.0;
    }
    drives += moved ? 1 : 0;
  }
  EXPECT_GT(drives, 10);
  EXPECT_LT(drives, 30);
}

TEST(SimulatedOperator, reaches_a_goal_around_corners_by_ear) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Loop loop(seed, kAroundACorner);
    EXPECT_TRUE(loop.lead(240.0)) << "seed " << seed << ": " << loop.x << ", " << loop.y;
  }
}

/// A short sound: from the left, the right or, with both, from ahead.
Heard sound(Earcon earcon, double left, double right) { return Sound{earcon, left, right}; }

/// Turns to `angle`, rad, counter-clockwise, by ticks that end `early` s before it is reached.
/// \return rad, turned too far
double turned_by_ear(std::uint64_t seed, double angle, double early) {
  Loop loop(seed, {{100.0, 0.0}});
  loop.say("drive straight, 9 meters");
  for (int i = 0; i < 200; ++i) loop.step();
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
    if (over && !told) loop.person.hear(sound(Earcon::turn_stop, 0.3, 0.3), loop.time);
    told = over;
    if (!over && loop.time - ticked > 0.1 + 0.4 * std::min(1.0, std::abs(off) / 1.57)) {
      ticked = loop.time;
      loop.person.hear(off > 0.0 ? sound(Earcon::turn, 0.6, 0.0) : sound(Earcon::turn, 0.0, 0.6),
                       loop.time);
    }
    loop.step();
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
  Loop loop(1, {{100.0, 0.0}});
  loop.say("drive straight, 9 meters");
  for (int i = 0; i < 200; ++i) loop.step();
  loop.say("go on, drive straight, 9 meters");
  for (int i = 0; i < 40; ++i) {
    if (i % 10 == 0) loop.person.hear(sound(Earcon::turn, 0.6, 0.0), loop.time);
    loop.step();
  }
  loop.person.hear(sound(Earcon::turn_stop, 0.3, 0.3), loop.time);
  for (int i = 0; i < 30; ++i) loop.step();
  const double turned = loop.yaw;
  EXPECT_GT(turned, 0.1);
  loop.person.hear(Speech{2, Moment::ends}, loop.time);
  for (int i = 0; i < 100; ++i) loop.step();
  EXPECT_NEAR(loop.yaw, turned, 0.1);
}

TEST(SimulatedOperator, finds_a_goal_behind_its_back) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Loop loop(seed, {{-5.0, 0.5}});
    EXPECT_TRUE(loop.lead(120.0)) << "seed " << seed << ": " << loop.x << ", " << loop.y;
  }
}

TEST(SimulatedOperator, does_the_same_again_with_the_same_seed) {
  Loop first(5, kAroundACorner);
  Loop second(5, kAroundACorner);
  Loop other(6, kAroundACorner);
  ASSERT_TRUE(first.lead(240.0));
  ASSERT_TRUE(second.lead(240.0));
  ASSERT_TRUE(other.lead(240.0));
  EXPECT_EQ(first.time, second.time);
  EXPECT_EQ(first.x, second.x);
  EXPECT_NE(first.x, other.x);
}

TEST(SimulatedOperator, does_not_act_on_what_was_cut_off) {
  Loop loop(1, kAroundACorner);
  loop.say("drive straight, 8 meters");
  (void)loop.step();
  loop.person.hear(Speech{1, Moment::breaks_off}, loop.time);
  for (int i = 0; i < 250; ++i) (void)loop.step();
  EXPECT_FALSE(loop.moved);
}

TEST(SimulatedOperator, takes_time_to_react) {
  Loop loop(1, kAroundACorner);
  for (int i = 0; i < 100; ++i) (void)loop.step();
  loop.say("drive straight, 8 meters");
  loop.person.hear(Speech{1, Moment::ends}, loop.time);
  const double heard = loop.time;
  while (!loop.moved && loop.time < heard + 3.0) (void)loop.step();
  EXPECT_GE(loop.time - heard, 0.3);
  EXPECT_LE(loop.time - heard, 1.3);
}

TEST(SimulatedOperator, backs_off_when_it_hears_that_it_hit_something) {
  Loop loop(1, kAroundACorner);
  for (int i = 0; i < 100; ++i) (void)loop.step();
  loop.say("hit a shelf ahead");
  loop.person.hear(Speech{1, Moment::ends}, loop.time);
  for (int i = 0; i < 150; ++i) (void)loop.step();
  EXPECT_LT(loop.x, -0.1);
}

TEST(SimulatedOperator, lets_go_at_the_word_that_something_was_hit) {
  Loop loop(1, kAroundACorner);
  for (int i = 0; i < 100; ++i) (void)loop.step();
  loop.say("drive straight, 8 meters");
  loop.person.hear(Speech{1, Moment::ends}, loop.time);
  for (int i = 0; i < 150; ++i) (void)loop.step();
  loop.say("hit a pallet robot on your right");
  for (int i = 0; i < 45; ++i) (void)loop.step();
  EXPECT_EQ(loop.step().forward, 0.0) << "the sentence is not over yet";
}

TEST(SimulatedOperator, takes_one_o_clock_for_less_after_straight_ahead) {
  const auto turned_by = [](std::uint64_t seed, const char* first) {
    Loop loop(seed, kAroundACorner);
    for (int i = 0; i < 100; ++i) (void)loop.step();
    loop.say(first);
    loop.person.hear(Speech{1, Moment::ends}, loop.time);
    for (int i = 0; i < 150; ++i) (void)loop.step();
    const double before = loop.yaw;
    loop.say("turn to 1 o'clock, 8 meters");
    loop.person.hear(Speech{2, Moment::ends}, loop.time);
    for (int i = 0; i < 150; ++i) (void)loop.step();
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
  Loop loop(1, kAroundACorner);
  const auto say = [&](std::uint32_t id, const char* text) {
    loop.say(text);
    loop.person.hear(Speech{id, Moment::ends}, loop.time);
  };
  for (int i = 0; i < 100; ++i) (void)loop.step();
  say(1, "drive straight, 8 meters");
  for (int i = 0; i < 150; ++i) (void)loop.step();
  say(2, "shelf ahead");
  for (int i = 0; i < 60; ++i) (void)loop.step();
  const double stopped = loop.x;
  for (int i = 0; i < 100; ++i) (void)loop.step();
  EXPECT_EQ(loop.x, stopped);
  EXPECT_TRUE(loop.asked);
  say(3, "drive straight, 6 meters");
  for (int i = 0; i < 100; ++i) (void)loop.step();
  EXPECT_GT(loop.x, stopped);
}

TEST(SimulatedOperator, goes_slower_while_both_motors_are_strong) {
  const auto covered = [](double motors) {
    Loop loop(1, kAroundACorner);
    for (int i = 0; i < 100; ++i) (void)loop.step();
    loop.person.feel({motors, motors}, loop.time);
    loop.say("drive straight, 20 meters");
    loop.person.hear(Speech{1, Moment::ends}, loop.time);
    for (int i = 0; i < 200; ++i) (void)loop.step();
    return loop.x;
  };
  EXPECT_LT(covered(0.9), 0.75 * covered(0.0));
  EXPECT_GT(covered(0.9), 0.1);
}

}  // namespace
}  // namespace navvi_people::people
