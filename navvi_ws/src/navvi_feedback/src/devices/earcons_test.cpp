#include "devices/earcons.hpp"

#include <gtest/gtest.h>

#include <map>

#include "heard.hpp"

namespace navvi_feedback::devices {
namespace {

using navvi_types::to_string;
using sounds::Earcon;

std::vector<Earcon> all() {
  std::vector<Earcon> earcons;
  for (std::size_t i = 0; i < names(Earcon{}).size(); ++i)
    earcons.push_back(static_cast<Earcon>(i));
  return earcons;
}

/// What is heard of it, in the left ear.
std::vector<double> listen(Earcon earcon) {
  Mixer mixer(MixerConfig{}, Audio::on);
  EarconPlayer player(mixer);
  EXPECT_EQ(player.play({{earcon, Eigen::Vector2d::UnitX(), 1.0}}).size(), 1U);
  pause(synthesize(earcon).duration() + 0.1);
  return heard().left;
}

/// What makes a sound its own: how much of each third of an octave there is in each 0.1 s.
std::vector<double> fingerprint(const std::vector<double>& ear) {
  const auto loud =
      std::find_if(ear.begin(), ear.end(), [](double s) { return std::abs(s) > 1e-3; });
  std::vector<double> print;
  double length = 0.0;
  for (std::ptrdiff_t slice = 0; slice < 9; ++slice) {
    const std::ptrdiff_t from =
        std::min((loud - ear.begin()) + slice * 4410, std::ptrdiff_t(ear.size()));
    const std::ptrdiff_t to = std::min(from + 4410, std::ptrdiff_t(ear.size()));
    const std::vector<double> part(ear.begin() + from, ear.begin() + to);
    for (double frequency = 80.0; frequency < 6000.0; frequency *= 1.26) {
      double most = 0.0;
      for (const double step : {1.0, 1.08, 1.17})
        most = std::max(most, tone_in(part, frequency * step));
      print.push_back(most);
      length += most * most;
    }
  }
  for (double& value : print) value /= std::sqrt(std::max(length, 1e-12));
  return print;
}

TEST(Earcons, are_short_begin_and_end_without_a_click_and_do_not_clip) {
  for (const Earcon earcon : all()) {
    const Sound sound = synthesize(earcon);
    ASSERT_FALSE(sound.samples.empty());
    if (earcon == Earcon::flow) continue;  // it has no ends
    EXPECT_LT(sound.duration(), 1.0) << to_string(earcon);
    EXPECT_LT(std::abs(sound.samples.front()), 300) << to_string(earcon);
    EXPECT_LT(std::abs(sound.samples.back()), 3000) << to_string(earcon);
    EXPECT_GT(*std::max_element(sound.samples.begin(), sound.samples.end()), 8000);
  }
  EXPECT_LT(synthesize(Earcon::turn).duration(), 0.1) << "its ticks must not run into each other";
}

/// Parts of it with a pause of 30 ms or more between two.
int bursts(const Sound& sound) {
  int count = 0;
  std::size_t silent = sound.samples.size();
  for (const std::int16_t sample : sound.samples) {
    const bool loud = std::abs(sample) > 300;
    if (loud && silent > static_cast<std::size_t>(0.03 * sound.rate)) ++count;
    silent = loud ? 0 : silent + 1;
  }
  return count;
}

TEST(Earcons, sound_once_of_what_is_near_and_twice_of_what_is_very_close) {
  for (const Earcon near : {Earcon::shelf_near, Earcon::worker_near, Earcon::forklift_near,
                            Earcon::pallet_robot_near, Earcon::thing_near}) {
    const auto close = static_cast<Earcon>(static_cast<int>(near) + 1);
    EXPECT_EQ(bursts(synthesize(near)), 1) << to_string(near);
    EXPECT_EQ(bursts(synthesize(close)), 2) << to_string(close);
  }
}

TEST(Earcons, have_one_that_can_be_repeated_without_a_click) {
  const std::vector<std::int16_t> samples = synthesize(Earcon::flow).samples;
  int most = 0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    most = std::max(most, std::abs(samples[i] - samples[i - 1]));
  EXPECT_LE(std::abs(samples.front() - samples.back()), most);
  EXPECT_GT(*std::max_element(samples.begin(), samples.end()), 4000);
  EXPECT_LT(*std::max_element(samples.begin(), samples.end()), 12000) << "it is quiet";
}

TEST(Earcons, are_told_apart_by_what_is_heard) {
  std::map<Earcon, std::vector<double>> prints;
  for (const Earcon earcon : all()) prints[earcon] = fingerprint(listen(earcon));
  for (const auto& [one, a] : prints) {
    for (const auto& [other, b] : prints) {
      if (one >= other) continue;
      double alike = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i) alike += a[i] * b[i];
      EXPECT_LT(alike, 0.85) << to_string(one) << " and " << to_string(other);
    }
  }
}

TEST(Earcons, a_tick_under_words_has_nothing_of_what_words_are_made_of) {
  const std::vector<double> ear = listen(Earcon::turn_click);
  for (double frequency = 200.0; frequency < 3000.0; frequency *= 1.2)
    EXPECT_LT(tone_in(ear, frequency), 0.25 * tone_in(ear, 4000.0)) << frequency << " Hz";
  EXPECT_LE(synthesize(Earcon::turn_click).duration(), 0.011);
}

TEST(EarconPlayer, tells_what_was_heard) {
  Mixer off(MixerConfig{}, Audio::off);
  EXPECT_TRUE(EarconPlayer(off).play({{}}).empty());
  Mixer on(MixerConfig{}, Audio::on);
  EXPECT_EQ(EarconPlayer(on).play({{}, {Earcon::beacon}}).size(), 2U);
}

}  // namespace
}  // namespace navvi_feedback::devices
