#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <type_traits>
#include <vector>

#include "navvi_config/reader.hpp"
#include "people/traits.hpp"

namespace navvi_people::people {
namespace {

constexpr int kDraws = 4000;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Mean and standard deviation of what `draw` gives.
struct Moments {
  double mean = 0.0, deviation = 0.0;
};
Moments moments(const std::function<double()>& draw) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = draw();
    sum += value;
    squares += value * value;
  }
  const double mean = sum / kDraws;
  return {mean, std::sqrt(std::max(0.0, squares / kDraws - mean * mean))};
}

SimulatedOperatorConfig person(const std::string& type, int seed = 1) {
  SimulatedOperatorConfig config;
  navvi_config::read(
      config, navvi_config::read_words({"type:=" + type, "seed:=" + std::to_string(seed)}), "test");
  return config.typed();
}

// An ear gets words, sounds and their sides, a hand two forces: these members, of these types, and
// no more, so that no kind, pattern, map, pose or path can come along.
TEST(WhatIsPlayed, has_no_place_for_a_kind_a_pattern_or_a_state) {
  const auto [id, moment, text] = Speech{};
  static_assert(std::is_same_v<decltype(id), const std::uint32_t>);
  static_assert(std::is_same_v<decltype(moment), const Speech::Moment>);
  static_assert(std::is_same_v<decltype(text), const std::string>);
  const auto [earcon, left, right] = Sound{};
  static_assert(std::is_same_v<decltype(earcon), const Earcon>);
  static_assert(std::is_same_v<decltype(left), const double>);
  static_assert(std::is_same_v<decltype(right), const double>);
  const auto [left_motor, right_motor] = Felt{};
  static_assert(std::is_same_v<decltype(left_motor), const double>);
  static_assert(std::is_same_v<decltype(right_motor), const double>);
  static_assert(std::variant_size_v<Heard> == 2);
  static_assert(std::is_same_v<decltype(&SimulatedOperator::hear),
                               void (SimulatedOperator::*)(const Heard&, double)>);
  static_assert(std::is_same_v<decltype(&SimulatedOperator::feel),
                               void (SimulatedOperator::*)(const Felt&, double)>);
  EXPECT_TRUE(text.empty() && id == 0 && left == right && left_motor == right_motor);
  EXPECT_EQ(earcon, Earcon::turn);
  EXPECT_EQ(moment, Speech::Moment::begins);
}

TEST(WhatIsPlayed, is_the_same_for_every_kind_of_cue_with_the_same_words) {
  using navvi_types::CueKind;
  using navvi_types::CueStage;
  for (std::size_t i = 0; i < navvi_types::kCueKinds; ++i) {
    const auto sentence = heard({7, CueStage::started, static_cast<CueKind>(i), "go on"});
    ASSERT_TRUE(sentence);
    EXPECT_EQ(std::get<Speech>(*sentence).text, "go on");
    EXPECT_EQ(std::get<Speech>(*sentence).id, 7U);
  }
  CueEvent felt{1, CueStage::started, navvi_types::Felt{navvi_types::Pattern::halt}, ""};
  EXPECT_FALSE(heard(felt)) << "patterns are felt by the motors alone";
  EXPECT_FALSE(heard({1, CueStage::queued, CueKind::straight, "straight"}));
}

TEST(Hearing, misses_mistakes_and_masks_as_often_as_it_is_said_to_and_nothing_without_faults) {
  HearingConfig config = person("typical").hearing;
  Hearing ear(config, 3);
  int missed = 0, mirrored = 0, off = 0, quiet = 0, covered = 0;
  for (int i = 0; i < kDraws; ++i) {
    const auto sentence = ear.words("drive straight, 4 meters", 2.0);
    missed += sentence ? 0 : 1;
    mirrored += sentence && sentence->mirrored ? 1 : 0;
    off += sentence && sentence->hours_off != 0 ? 1 : 0;
    quiet += ear.sound({Earcon::turn, 0.6, 0.0}, false, 10.0 * i) ? 0 : 1;
    covered += ear.sound({Earcon::turn, 0.6, 0.0}, true, 10.0 * i + 5.0) ? 0 : 1;
  }
  EXPECT_NEAR(missed, config.missed_words * kDraws, 60);
  EXPECT_NEAR(mirrored, config.mirrored * kDraws, 40);
  EXPECT_NEAR(off, config.misheard * kDraws, 60);
  EXPECT_NEAR(quiet, config.missed_sounds * kDraws, 60);
  EXPECT_NEAR(covered, (1.0 - 0.95 * 0.9) * kDraws, 100);
  config.faults = false;
  Hearing ideal(config, 3);
  for (int i = 0; i < kDraws; ++i) {
    const auto tone = ideal.sound({Earcon::turn, 0.0, 0.6}, true, 0.01 * i);
    ASSERT_TRUE(tone);
    EXPECT_EQ(tone->side, Instruction::Side::right);
    EXPECT_EQ(tone->reaction, config.sound_reaction);
  }
  config.words = config.sounds = false;
  Hearing deaf(config, 1);
  EXPECT_FALSE(deaf.words("straight ahead", 1.0));
  EXPECT_FALSE(deaf.sound({Earcon::turn, 0.6, 0.0}, false, 0.0));
}

TEST(Hearing, spreads_reactions_within_a_person_and_follows_no_speech_that_is_too_fast) {
  const HearingConfig config = person("typical").hearing;
  Hearing ear(config, 4);
  const Moments reaction = moments([&] {
    const auto tone = ear.sound({Earcon::turn, 0.6, 0.0}, false, 0.0);
    return tone ? tone->reaction : config.sound_reaction;
  });
  EXPECT_NEAR(reaction.mean, config.sound_reaction, 0.05);
  EXPECT_GT(reaction.deviation, 0.1);
  EXPECT_FALSE(ear.words(std::string(100, 'a'), 100.0 / 2.1 / config.fastest_speech));
}

TEST(Turning, over_rotates_a_typical_person_as_much_as_was_measured_by_class_of_turn) {
  Turning turning(person("typical").turning, 5);
  for (const double sign : {1.0, -1.0}) {
    const Moments slight =
        moments([&] { return sign * turning.made(sign * 45.0 * kDegree) / kDegree - 45.0; });
    const Moments ample =
        moments([&] { return sign * turning.made(sign * 90.0 * kDegree) / kDegree - 90.0; });
    EXPECT_NEAR(slight.mean, 17.4, 0.5);
    EXPECT_NEAR(slight.deviation, 4.0, 0.5);
    EXPECT_NEAR(ample.mean, 13.4, 0.5);
    EXPECT_NEAR(ample.deviation, 3.7, 0.5);
  }
  TurningConfig exact;
  exact.faults = false;
  Turning ideal(exact, 5);
  EXPECT_EQ(ideal.made(1.0), 1.0);
  EXPECT_EQ(ideal.stop_delay(), 0.0);
}

TEST(Driving, trembles_and_veers_by_a_bias_and_a_larger_variable_error) {
  const DrivingConfig config = person("typical").driving;
  Driving hand(config, 6, 6);
  const Moments stick = moments([&] { return hand.trembling(0.5, 0.1); });
  EXPECT_NEAR(stick.mean, 0.5, 0.02);
  EXPECT_NEAR(stick.deviation, config.noise, 0.02);
  EXPECT_EQ(hand.trembling(0.0, 0.1), 0.0) << "a stick that is let go";
  EXPECT_EQ(hand.trembling(-1.0, 0.1), -1.0) << "a stick at its end stop";
  const Moments veer = moments([&] { return hand.veered(1.0) / kDegree; });
  EXPECT_NEAR(std::abs(veer.mean), config.veer, 0.1);
  EXPECT_NEAR(veer.deviation, config.veer_spread, 0.1);
  EXPECT_GT(veer.deviation, std::abs(veer.mean));
  DrivingConfig steady;
  steady.faults = false;
  Driving ideal(steady, 6, 6);
  EXPECT_EQ(ideal.trembling(0.5, 0.1), 0.5);
  EXPECT_EQ(ideal.veered(1.0), 0.0);
}

TEST(Driving, of_a_person_is_the_same_on_each_occasion_but_for_chance) {
  DrivingConfig config = person("typical").driving;
  Driving one(config, 6, 1);
  Driving other(config, 6, 2);
  EXPECT_EQ(one.turn_gain(), other.turn_gain());
  EXPECT_EQ(one.speed_gain(), other.speed_gain());
  EXPECT_NE(one.trembling(0.5, 0.1), other.trembling(0.5, 0.1));
  EXPECT_NE(one.turn_gain(), Driving(config, 7, 1).turn_gain());
}

TEST(Feeling, is_as_late_as_was_measured_and_feels_nothing_without_motors_or_below_its_threshold) {
  const FeelingConfig config = person("typical").feeling;
  EXPECT_GT(config.reading, 1.0) << "a pattern, Cosgun: 1 to 2 s";
  EXPECT_LT(config.reading, 2.0);
  EXPECT_GT(config.onset, 0.25) << "a vibration, PLoS ONE 2019, 0219737: 0.25 to 0.5 s";
  EXPECT_LT(config.onset, 0.5 + 0.13 + 0.12) << "and a second task, and its place";
  const auto felt_after = [](const FeelingConfig& skin, double force) {
    Feeling feeling(skin, 7);
    feeling.feel({force, 0.0}, 0.0);
    for (int i = 0; i < 500; ++i)
      if (feeling.update(0.02 * i).force.left > 0.0) return 0.02 * i;
    return 1e9;
  };
  EXPECT_NEAR(felt_after(config, 0.8), config.onset, 0.4);
  EXPECT_EQ(felt_after(config, 0.5 * config.threshold), 1e9);
  FeelingConfig none = config;
  none.motors = false;
  EXPECT_EQ(felt_after(none, 1.0), 1e9);
}

/// What a row of pulses, each of s, left, right, means to somebody who knows them all.
Meaning meaning_of(const std::vector<std::array<double, 3>>& beats, double before = 0.0) {
  FeelingConfig config;
  config.faults = false;
  config.threshold = 0.0;
  Feeling feeling(config, 1);
  double time = 0.0;
  Meaning found = Meaning::none;
  const auto play = [&](double seconds, double left, double right) {
    for (const double end = time + seconds - 1e-9; time < end; time += 0.02) {
      feeling.feel({left, right}, time);
      const Meaning now = feeling.update(time).meaning;
      if (now != Meaning::none) found = now;
    }
  };
  for (double force = 0.0; force < before; force += 0.1) play(0.02, force, force);
  play(0.5, before, before);
  for (const auto& [seconds, left, right] : beats) play(seconds, left, right);
  play(2.0, 0.0, 0.0);
  return found;
}

TEST(Feeling, knows_patterns_by_their_time_course) {
  EXPECT_EQ(meaning_of({{0.1, 1, 1}, {0.1, 0, 0}, {0.3, 1, 1}}), Meaning::halt);
  EXPECT_EQ(meaning_of({{0.1, 1, 1}, {0.1, 0, 0}, {0.3, 1, 1}}, 0.4), Meaning::halt);
  EXPECT_EQ(meaning_of({{0.35, 0.9, 0.9}, {0.15, 0, 0}, {0.35, 0.9, 0.9}}), Meaning::stop);
  EXPECT_EQ(meaning_of({{0.15, 1, 0}, {0.1, 0, 0}, {0.15, 1, 0}}), Meaning::hit);
  EXPECT_EQ(meaning_of({{0.5, 0, 1}}), Meaning::hit);
  EXPECT_EQ(meaning_of({{0.12, 0.6, 0}, {0.06, 0, 0}, {0.12, 0, 0.6}}), Meaning::new_way);
  EXPECT_EQ(meaning_of({{0.1, 0.5, 0.5}, {0.1, 0, 0}, {0.1, 0.5, 0.5}}), Meaning::ready);
  EXPECT_EQ(meaning_of({{0.2, 0.5, 0.5}}), Meaning::begun);
  EXPECT_EQ(meaning_of({{0.15, 0.3, 0.3}, {0.1, 0, 0}, {0.15, 0.6, 0.6}, {0.1, 0, 0}, {0.3, 1, 1}}),
            Meaning::arrived);
  std::vector<std::array<double, 3>> taps;
  for (int i = 0; i < 4; ++i) taps.insert(taps.end(), {{0.08, 0.8, 0.8}, {0.08, 0, 0}});
  EXPECT_EQ(meaning_of(taps), Meaning::stuck);
  EXPECT_EQ(meaning_of({{3.0, 0.9, 0.9}}), Meaning::none) << "a wall at the side";
}

TEST(Memory, loses_a_second_turn_soon_after_the_first_more_often_for_the_quick) {
  const auto lost = [](double speed, double gap, bool faults = true) {
    MemoryConfig config = person("typical").memory;
    config.faults = faults;
    Memory memory(config, 8);
    int count = 0;
    for (int i = 0; i < kDraws; ++i) {
      (void)memory.keeps(speed, 100.0 * i);
      count += memory.keeps(speed, 100.0 * i + gap) ? 0 : 1;
    }
    return count;
  };
  EXPECT_GT(lost(1.0, 0.5), 1.5 * lost(0.6, 0.5));
  EXPECT_GT(lost(0.8, 0.5), 2 * lost(0.8, 2.5));
  EXPECT_EQ(lost(0.8, 5.0), 0);
  EXPECT_EQ(lost(0.8, 0.0, false), 0);
}

TEST(Attention, wanders_and_gives_up_after_standing_for_too_long) {
  AttentionConfig config = person("typical").attention;
  const auto away = [](const AttentionConfig& of, bool moves, double until) {
    Attention attention(of, 9);
    double sum = 0.0;
    for (double time = 0.0; time < until; time += 0.02) {
      attention.update(moves, time, 0.02);
      sum += attention.elsewhere(time) ? 0.02 : 0.0;
    }
    return std::make_pair(sum / until, attention.gave_up());
  };
  EXPECT_NEAR(away(config, true, 60000.0).first, config.distractions * config.distracted / 60.0,
              0.003);
  EXPECT_FALSE(away(config, true, 1000.0).second);
  EXPECT_FALSE(away(config, false, config.gives_up - 1.0).second);
  EXPECT_TRUE(away(config, false, config.gives_up + 1.0).second);
  config.faults = false;
  EXPECT_FALSE(away(config, false, config.gives_up + 1.0).second);
}

TEST(Learning, makes_the_fourth_route_quicker_and_takes_up_what_words_leave_a_turn_short_by) {
  LearningConfig config;
  config.routes = 4;
  EXPECT_LT(Learning(config).factor(), 0.9);
  Learning learning(config);
  for (int i = 0; i < 30; ++i) learning.turned(1.0, 0.26 - learning.bias());
  EXPECT_NEAR(learning.bias(), 0.26, 0.01) << "an hour that is rounded down";
  config.on = false;
  EXPECT_EQ(Learning(config).factor(), 1.0);
}

TEST(Types, are_in_order_in_every_trait_and_what_is_set_besides_stays) {
  for (const Trait& trait : traits()) {
    const bool up = trait.able <= trait.typical && trait.typical <= trait.struggling;
    const bool down = trait.able >= trait.typical && trait.typical >= trait.struggling;
    EXPECT_TRUE(up || down) << trait.name;
  }
  SimulatedOperatorConfig config;
  navvi_config::read(config,
                     navvi_config::read_words({"hearing/words:=false", "type:=struggling"}), "test");
  config = config.typed();
  EXPECT_FALSE(config.hearing.words);
  EXPECT_EQ(config.hearing.missed_sounds, person("struggling").hearing.missed_sounds);
  SimulatedOperatorConfig shipped;
  SimulatedOperatorConfig able = person("typical");
  able.type = "able";
  able = able.typed();
  for (const Trait& trait : traits())
    EXPECT_EQ(trait.of(shipped), trait.of(able)) << trait.name << ": the default is able";
}

TEST(Types, of_drawn_people_differ_by_seed_around_the_published_means) {
  EXPECT_NE(person("drawn", 1).turning.over_slight, person("drawn", 2).turning.over_slight);
  EXPECT_EQ(person("drawn", 1).turning.over_slight, person("drawn", 1).turning.over_slight);
  int seed = 0;
  const Moments over = moments([&] { return person("drawn", ++seed).turning.over_slight; });
  EXPECT_NEAR(over.mean, 17.4, 1.0);
  EXPECT_GT(over.deviation, 2.0);
  seed = 0;
  const Moments delay = moments([&] { return person("drawn", ++seed).feeling.reading; });
  EXPECT_GT(delay.mean - delay.deviation, 0.9) << "Cosgun: 1 to 2 s";
  EXPECT_LT(delay.mean + delay.deviation, 2.0);
}

TEST(Types, are_worse_by_a_factor_in_all_but_what_they_like) {
  SimulatedOperatorConfig usual = person("struggling"), worse;
  navvi_config::read(worse, navvi_config::read_words({"type:=struggling", "worse:=1.5"}), "test");
  worse = worse.typed();
  EXPECT_NEAR(worse.tracking.delay, 1.5 * usual.tracking.delay, 1e-9);
  EXPECT_NEAR(worse.feeling.recognised, 0.55, 1e-9);
  EXPECT_NEAR(worse.hearing.fastest_speech, usual.hearing.fastest_speech / 1.5, 1e-9);
  EXPECT_EQ(worse.driving.cruise, usual.driving.cruise);
}

TEST(Types, deafblind_and_noise_are_typical_but_for_what_is_heard) {
  const SimulatedOperatorConfig typical = person("typical"), deafblind = person("deafblind"),
                                noise = person("noise");
  EXPECT_FALSE(deafblind.hearing.words || deafblind.hearing.sounds);
  EXPECT_EQ(deafblind.feeling.onset, typical.feeling.onset);
  EXPECT_EQ(noise.hearing.noise, 0.5);
  Hearing hearing(noise.hearing, 3);
  int heard = 0, covered = 0;
  for (int i = 0; i < 2000; ++i) heard += hearing.words("go on, 9 meters", 2.0) ? 1 : 0;
  for (int i = 0; i < 50000; ++i) covered += hearing.covered(0.02) ? 1 : 0;
  EXPECT_NEAR(heard / 2000.0, 0.5, 0.06) << "one cue in two";
  EXPECT_NEAR(covered / 50000.0, 0.5, 0.05);
}

TEST(Types, stand_in_the_document_as_they_are_in_the_code) {
  std::ifstream file(NAVVI_PEOPLE_TABLE);
  std::stringstream text;
  text << file.rdbuf();
  for (const Trait& trait : traits()) {
    std::ostringstream row;
    row << "\n| " << trait.name << " | " << trait.able << " | " << trait.typical << " | "
        << trait.struggling << " | " << trait.between << " | " << (*trait.unit ? trait.unit : "-")
        << " | ";
    EXPECT_NE(text.str().find(row.str()), std::string::npos)
        << NAVVI_PEOPLE_TABLE << " lacks a row that begins with" << row.str();
  }
}

}  // namespace
}  // namespace navvi_people::people
