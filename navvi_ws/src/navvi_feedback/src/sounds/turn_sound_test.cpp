#include "sounds/turn_sound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace navvi_feedback::sounds {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kTick = 0.02;  // s

/// A person at a stick who turns to the side of the ticks, and lets go some time after the stop, on
/// a robot that turns no faster than it is led.
class Turner {
 public:
  explicit Turner(const TurnConfig& config) : sound_(config) {}

  /// Makes a turn. \param off  deg, clockwise \return deg, turned too far; negative: too little
  /// \param missed  sounds to stop at that are not heard
  double turn(double off, double delay, double rate = 1.2, int missed = 0) {
    const double asked = off;
    std::optional<double> let_go;
    double speed = 0.0;  // rad/s, counter-clockwise
    ticks.clear();
    stops = 0;
    for (int i = 0; i < 500; ++i) {
      time_ += kTick;
      const auto play = sound_.update(off * kDegree, false, {0.0, rate_}, time_);
      if (play && play->earcon == Earcon::turn) {
        ticks.push_back(time_);
        side = play->from.y();
        if (!let_go && hears_ticks) speed = std::copysign(rate, mirrored ? -side : side);
      }
      if (play && play->earcon == Earcon::turn_stop) {
        ++stops;
        if (!let_go && stops > missed) let_go = time_ + delay;
      }
      if (let_go && time_ >= *let_go) speed = 0.0;
      const double most = slowed ? sound_.most_rate().value_or(rate) : rate;
      off += std::clamp(speed, -most, most) * kTick / kDegree;
      rate_ = std::clamp(speed, -most, most);
    }
    return asked > 0.0 ? -off : off;
  }

  TurnSound sound_;
  std::vector<double> ticks;  ///< s
  int stops = 0;
  double side = 0.0;
  bool slowed = false;  ///< by the guide
  bool hears_ticks = true;
  bool mirrored = false;  ///< hears them from the other side

 private:
  double rate_ = 0.0;  // rad/s
  double time_ = 0.0;  // s
};

TEST(TurnSound, is_silent_where_there_is_nothing_to_turn) {
  TurnSound sound{TurnConfig{}};
  for (double time = 0.0; time < 2.0; time += kTick) {
    EXPECT_FALSE(sound.update(std::nullopt, false, {}, time));
    EXPECT_FALSE(sound.update(10.0 * kDegree, false, {}, 2.0 + time));
  }
}

TEST(TurnSound, passes_over_a_heading_that_is_off_for_a_moment) {
  TurnSound sound{TurnConfig{}};
  for (int i = 0; i < 100; ++i)
    EXPECT_FALSE(sound.update((i % 8 < 6 ? 40.0 : 5.0) * kDegree, false, {}, i * kTick)) << i;
}

TEST(TurnSound, ticks_from_the_side_to_turn_to_and_the_faster_the_less_is_left) {
  for (const double off : {120.0, -120.0}) {
    Turner person{TurnConfig{}};
    person.turn(off, 0.4, 0.6);
    EXPECT_EQ(person.side, off > 0.0 ? -1.0 : 1.0);
    ASSERT_GT(person.ticks.size(), 6U);
    const std::vector<double>& ticks = person.ticks;
    EXPECT_NEAR(ticks[1] - ticks[0], 0.5, 0.03);
    EXPECT_LT(ticks.back() - ticks[ticks.size() - 2], 0.35);
    for (std::size_t i = 2; i < ticks.size(); ++i)
      EXPECT_LT(ticks[i] - ticks[i - 1], ticks[i - 1] - ticks[i - 2] + 0.03);
  }
}

TEST(TurnSound, tells_to_stop_so_early_that_the_person_stops_at_the_angle) {
  for (const double off : {30.0, -60.0, 90.0, 170.0}) {
    TurnConfig config;
    config.stopping_delay = 0.4;
    Turner person{config};
    EXPECT_NEAR(person.turn(off, 0.4), 0.0, 5.0) << off;
    EXPECT_LE(person.stops, 2) << off << ": once more where the first was not heard yet";
    config.stopping_delay = 0.0;
    config.learn = false;
    Turner late{config};
    EXPECT_GT(late.turn(off, 0.4), 20.0) << off;
  }
}

TEST(TurnSound, learns_how_long_a_person_takes_to_stop) {
  TurnConfig config;
  config.stopping_delay = 0.2;
  Turner person{config};
  for (int i = 0; i < 15; ++i) person.turn(i % 2 == 0 ? 80.0 : -80.0, 0.6);
  EXPECT_NEAR(person.sound_.learnt().stopping_delay, 0.6, 0.07);
  EXPECT_NEAR(person.turn(80.0, 0.6), 0.0, 6.0);
}

TEST(TurnSound, learns_little_from_a_stop_that_was_missed_first) {
  TurnConfig config;
  config.stopping_spread = 0.05;
  Turner person{config};
  for (int i = 0; i < 15; ++i) person.turn(i % 2 == 0 ? 80.0 : -80.0, 0.4);
  const double before = person.sound_.learnt().stopping_delay;
  person.turn(80.0, 0.4, 1.2, 4);
  EXPECT_GT(person.stops, 4);
  EXPECT_GT(person.sound_.learnt().stopping_delay, before);
  EXPECT_LT(person.sound_.learnt().stopping_delay, before + 0.04) << "it was 1.4 s late";
}

TEST(TurnSound, learns_how_alike_the_stops_of_a_person_are) {
  Turner alike{TurnConfig{}};
  Turner unlike{TurnConfig{}};
  for (int i = 0; i < 30; ++i) {
    alike.turn(i % 2 == 0 ? 80.0 : -80.0, 0.6);
    unlike.turn(i % 2 == 0 ? 80.0 : -80.0, i % 3 == 0 ? 1.1 : 0.5);
  }
  EXPECT_LT(alike.sound_.learnt().stopping_spread, 0.06);
  EXPECT_NEAR(unlike.sound_.learnt().stopping_spread, 0.3, 0.1);
}

TEST(TurnSound, learns_nothing_where_it_is_not_to) {
  TurnConfig config;
  config.learn = false;
  Turner late{config};
  for (int i = 0; i < 8; ++i) late.turn(80.0, 1.5);
  EXPECT_EQ(late.sound_.learnt().stopping_delay, config.stopping_delay);
  EXPECT_EQ(late.sound_.learnt().stopping_spread, config.stopping_spread);
  EXPECT_TRUE(late.sound_.leads()) << "however much was left";
  EXPECT_GT(late.sound_.learnt().turn_error, 0.5);
}

TEST(TurnSound, does_not_learn_from_who_turns_on) {
  Turner person{TurnConfig{}};
  person.turn(80.0, 4.0);
  EXPECT_EQ(person.sound_.learnt().stopping_delay, TurnConfig{}.stopping_delay);
}

TEST(TurnSound, learns_what_is_left_of_turns) {
  Turner late{TurnConfig{}};
  (void)late.turn(80.0, 0.8);
  EXPECT_NEAR(late.sound_.learnt().turn_error, 0.4 * 1.2, 0.1) << "0.4 s late, at 1.2 rad/s";
}

TEST(TurnSound, ends_turns_the_slower_the_less_alike_the_stops_are) {
  // deg, what is left of a turn by a person who stops now sooner, now later
  const auto error = [](double slow_down) {
    TurnConfig config;
    config.slow_down = slow_down;
    Turner person{config};
    person.slowed = true;
    double sum = 0.0;
    for (int i = 0; i < 40; ++i) {
      const double delay = std::vector<double>{0.6, 1.0, 1.7}[static_cast<std::size_t>(i % 3)];
      const double left = std::abs(person.turn(i % 2 == 0 ? 80.0 : -80.0, delay));
      if (i >= 20) sum += left / 20.0;
    }
    return sum;
  };
  EXPECT_LT(error(2.0), 8.0);
  EXPECT_GT(error(0.0), 20.0);
}

TEST(TurnSound, slows_the_robot_down_towards_the_end_of_a_turn_and_until_it_stands) {
  TurnConfig config;
  config.stopping_spread = 0.5;
  TurnSound sound{config};
  double time = 0.0;
  const auto most_at = [&](double off, double rate) {
    for (int i = 0; i < 20; ++i)
      (void)sound.update(off * kDegree, false, {0.0, rate}, time += kTick);
    return sound.most_rate();
  };
  EXPECT_FALSE(most_at(0.0, 1.2)) << "nothing to turn";
  EXPECT_NEAR(most_at(90.0, -0.5).value(), M_PI / 4.0, 0.01) << "half a right angle a second";
  EXPECT_NEAR(most_at(45.0, -0.5).value(), M_PI / 8.0, 0.01);
  EXPECT_NEAR(most_at(8.0, -0.3).value(), 0.2, 0.01);
  EXPECT_NEAR(most_at(-5.0, -0.3).value(), 0.15, 0.01) << "told to stop, and turns on too far";
  EXPECT_FALSE(most_at(-8.0, 0.0));
  TurnConfig plain;
  plain.slow_down = 0.0;
  TurnSound free{plain};
  for (int i = 0; i < 20; ++i) (void)free.update(1.0, false, {}, i * kTick);
  EXPECT_FALSE(free.most_rate());
}

TEST(TurnSound, is_silent_where_words_lead_better_and_is_tried_again) {
  Turner person{TurnConfig{}};
  int turns = 0;
  for (; person.sound_.leads() && turns < 20; ++turns) person.turn(80.0, 2.0);
  EXPECT_GE(turns, 2) << "one that leaves more than 20 deg may happen to anybody";
  EXPECT_LE(turns, 3);
  EXPECT_TRUE(person.sound_.learnt().words_lead);
  EXPECT_EQ(person.turn(80.0, 0.4), -80.0) << "in silence";
  // Words lead it well, four times.
  double time = 1000.0;
  for (int turn = 0; turn < 4; ++turn) {
    EXPECT_FALSE(person.sound_.leads());
    for (int i = 0; i < 100; ++i)
      (void)person.sound_.update(5.0 * kDegree, false, {0.0, i < 50 ? -1.0 : 0.0}, time += kTick);
  }
  EXPECT_TRUE(person.sound_.leads());
}

TEST(TurnSound, F7_gives_way_to_words_for_good_where_three_turns_went_the_wrong_way) {
  Turner person{TurnConfig{}};
  person.turn(80.0, 0.4);
  person.mirrored = true;
  for (const double off : {60.0, -80.0, 90.0}) {
    EXPECT_FALSE(person.sound_.learnt().sides_wrong);
    person.turn(off, 0.4, 0.3);
  }
  EXPECT_TRUE(person.sound_.learnt().sides_wrong);
  EXPECT_FALSE(person.sound_.leads());
  double time = 1000.0;
  for (int turn = 0; turn < 40; ++turn)
    for (int i = 0; i < 100; ++i)
      (void)person.sound_.update(5.0 * kDegree, false, {0.0, i < 50 ? -1.0 : 0.0}, time += kTick);
  EXPECT_FALSE(person.sound_.leads()) << "however well words lead";
}

TEST(TurnSound, forgives_sides_that_are_mistaken_now_and_then) {
  Turner person{TurnConfig{}};
  for (int turn = 0; turn < 30; ++turn) {
    person.mirrored = turn % 3 == 0;
    person.turn(turn % 2 == 0 ? 80.0 : -80.0, 0.4, person.mirrored ? 0.3 : 1.2);
  }
  EXPECT_FALSE(person.sound_.learnt().sides_wrong);
}

TEST(TurnSound, gives_way_to_words_where_nobody_turns_to_it) {
  Turner person{TurnConfig{}};
  person.hears_ticks = false;
  person.turn(80.0, 0.4);
  EXPECT_TRUE(person.sound_.leads());
  person.turn(80.0, 0.4);
  EXPECT_FALSE(person.sound_.leads());
}

TEST(TurnSound, tells_now_and_then_that_a_robot_drives_where_it_should) {
  for (const double speed : {0.0, 0.5}) {
    TurnSound sound{TurnConfig{}};
    int heard = 0;
    for (int i = 0; i < 1000; ++i)
      if (const auto play = sound.update(3.0 * kDegree, false, {speed, 0.0}, i * kTick))
        heard += play->earcon == Earcon::on_course ? 1 : 100;
    EXPECT_EQ(heard, speed > 0.0 ? 4 : 0);
  }
}

TEST(TurnSound, counts_a_small_turn_down_where_that_matters) {
  for (const bool fine : {false, true}) {
    TurnSound sound{TurnConfig{}};
    int ticks = 0;
    for (int i = 0; i < 50; ++i)
      if (const auto play = sound.update(10.0 * kDegree, fine, {}, i * kTick))
        ticks += play->earcon == Earcon::turn ? 1 : 0;
    EXPECT_EQ(ticks > 0, fine);
  }
}

TEST(TurnSound, ends_without_a_word_where_there_is_no_way_any_more) {
  TurnSound sound{TurnConfig{}};
  int sounds = 0;
  for (int i = 0; i < 50; ++i)
    sounds += sound.update(90.0 * kDegree, false, {}, i * kTick).has_value() ? 1 : 0;
  EXPECT_GT(sounds, 0);
  for (int i = 50; i < 150; ++i)
    EXPECT_FALSE(sound.update(std::nullopt, false, {}, i * kTick)) << i;
}

}  // namespace
}  // namespace navvi_feedback::sounds
