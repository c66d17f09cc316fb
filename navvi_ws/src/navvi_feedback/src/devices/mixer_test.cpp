#include "devices/mixer.hpp"

#include <gtest/gtest.h>

#include "heard.hpp"

namespace navvi_feedback::devices {
namespace {

namespace fs = std::filesystem;
using Device = Mixer::Status::Device;

const Eigen::Vector2d kAhead(2.0, 0.0);
const Eigen::Vector2d kLeft(0.0, 2.0);
const Eigen::Vector2d kRight(0.0, -2.0);
const Eigen::Vector2d kBehind(-2.0, 0.0);

Sound tone(double frequency, double seconds) {
  Sound sound;
  const auto count = static_cast<std::size_t>(seconds * sound.rate);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * frequency * static_cast<double>(i) / sound.rate;
    sound.samples.push_back(static_cast<std::int16_t>(16000.0 * std::sin(angle)));
  }
  return sound;
}

/// What is heard of a short sound from there.
Heard heard_from(const Eigen::Vector2d& from, const std::string& hrtf) {
  MixerConfig config;
  config.hrtf = hrtf;
  Mixer mixer(config, Audio::on);
  EXPECT_EQ(mixer.status().two_ears, hrtf == "on");
  EXPECT_TRUE(mixer.play(tone(3000.0, 0.1), 1.0, from));
  pause(0.3);
  return heard();
}

TEST(Mixer, plays_a_sound_from_its_side) {
  for (const char* hrtf : {"off", "on"}) {
    const Heard left = heard_from(kLeft, hrtf);
    EXPECT_GT(tone_in(left.left, 3000.0), 2.0 * tone_in(left.right, 3000.0)) << hrtf;
    const Heard right = heard_from(kRight, hrtf);
    EXPECT_GT(tone_in(right.right, 3000.0), 2.0 * tone_in(right.left, 3000.0)) << hrtf;
    const Heard ahead = heard_from(kAhead, hrtf);
    EXPECT_NEAR(tone_in(ahead.left, 3000.0), tone_in(ahead.right, 3000.0), 0.02) << hrtf;
    EXPECT_GT(tone_in(ahead.left, 3000.0), 0.05) << hrtf;
  }
}

TEST(Mixer, plays_all_as_loud_as_it_is_set) {
  const auto loudness_at = [](double volume) {
    MixerConfig config;
    config.hrtf = "off";
    Mixer mixer(config, Audio::on);
    mixer.set_volume(volume);
    EXPECT_TRUE(mixer.play(tone(3000.0, 0.1), 1.0, kAhead));
    pause(0.3);
    return tone_in(heard().left, 3000.0);
  };
  EXPECT_NEAR(loudness_at(0.2), 0.2 * loudness_at(1.0), 0.01);
}

TEST(Mixer, makes_ahead_and_behind_differ_for_two_ears) {
  const double ahead = tone_in(heard_from(kAhead, "on").left, 3000.0);
  const double behind = tone_in(heard_from(kBehind, "on").left, 3000.0);
  EXPECT_GT(std::abs(ahead - behind), 0.1 * std::max(ahead, behind));
}

TEST(Mixer, plays_short_sounds_besides_the_voice) {
  Mixer mixer(MixerConfig{}, Audio::on);
  ASSERT_TRUE(mixer.speak(tone(400.0, 0.5), 1.0));
  pause(0.1);
  EXPECT_TRUE(mixer.play(tone(1500.0, 0.2), 1.0, kLeft));
  EXPECT_TRUE(mixer.play(tone(2500.0, 0.2), 1.0, kRight));
  EXPECT_TRUE(mixer.speaking());
  pause(0.7);
  EXPECT_FALSE(mixer.speaking());
  const Heard all = heard();
  EXPECT_GT(tone_in(all.left, 400.0), 0.1);
  EXPECT_GT(tone_in(all.left, 1500.0), 0.05);
  EXPECT_GT(tone_in(all.right, 2500.0), 0.05);
}

TEST(Mixer, silences_the_voice_alone_within_50_ms) {
  Mixer mixer(MixerConfig{}, Audio::on);
  ASSERT_TRUE(mixer.speak(tone(400.0, 1.0), 1.0));
  pause(0.3);
  const int mixed = mixer.mixed();
  mixer.mute();
  pause(0.2);
  mixer.stop();
  const std::vector<double> loud = loudness(heard().left, 441);
  const auto heard_for =
      std::count_if(loud.begin(), loud.end(), [](double peak) { return peak > 0.01; });
  EXPECT_GT(heard_for, 20);
  EXPECT_LT(heard_for, mixed / (Sound().rate / 100) + 5) << "in 10 ms";
}

TEST(Mixer, is_silent_by_intent_and_opens_nothing) {
  Mixer mixer(MixerConfig{}, Audio::off);
  mixer.tend();
  EXPECT_EQ(mixer.status().device, Device::off);
  EXPECT_FALSE(mixer.play(tone(400.0, 0.1), 1.0, kLeft));
  EXPECT_FALSE(mixer.speak(tone(400.0, 0.1), 1.0));
}

TEST(Mixer, F2_notices_the_loss_of_its_device_and_plays_again_once_there_is_one) {
  const fs::path file = recording_folder() / "heard.wav";
  fs::remove(file);
  fs::create_symlink("/dev/full", file);  // takes no sample
  MixerConfig config;
  config.reopen = 0.5;
  Mixer mixer(config, Audio::on);
  ASSERT_EQ(mixer.status().device, Device::open);
  for (int i = 0; i < 30 && mixer.play(tone(1500.0, 0.1), 1.0, kAhead); ++i) pause(0.1);
  EXPECT_FALSE(mixer.play(tone(1500.0, 0.1), 1.0, kAhead));
  fs::remove(file);
  for (int i = 0; i < 30 && !fs::is_regular_file(file); ++i) {
    pause(0.1);
    mixer.tend();
  }
  ASSERT_EQ(mixer.status().device, Device::open);
  EXPECT_TRUE(mixer.play(tone(1500.0, 0.1), 1.0, kAhead));
  pause(0.3);
  EXPECT_GT(tone_in(heard().left, 1500.0), 0.05);
}

}  // namespace
}  // namespace navvi_feedback::devices
