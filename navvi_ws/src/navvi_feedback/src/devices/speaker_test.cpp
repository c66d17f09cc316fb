#include "devices/speaker.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <navvi_config/reader.hpp>
#include <vector>

#include "devices/device_error.hpp"
#include "heard.hpp"
#include "measured.hpp"

namespace navvi_feedback::devices {
namespace {

using navvi_test::Clock;

double since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

/// Waits until `done`; false if that takes longer than 10 s.
template <typename Done>
bool wait_for(const Done& done) {
  const auto start = Clock::now();
  while (!done()) {
    if (since(start) > 10.0) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// s of the recording that are not silent.
double loud_time() {
  double time = 0.0;
  for (const double peak : loudness(heard().left, 441)) time += peak > 0.01 ? 0.01 : 0.0;
  return time;
}

class SilentSpeaker : public testing::Test {
 protected:
  /// \return whether it comes to the end of it
  bool says(const std::string& text) {
    speaker.start(text);
    return wait_for([&] { return !speaker.busy(); });
  }

  Mixer mixer{MixerConfig{}, Audio::off};
  Speaker speaker{SpeakerConfig{}, mixer};
};

TEST(SpeakerConfig, allows_no_rate_that_the_voice_does_not_keep) {
  for (const int rate : {79, 450}) {
    SpeakerConfig config;
    EXPECT_THROW(navvi_config::read(config, YAML::Load("rate: " + std::to_string(rate)), "test"),
                 navvi_config::ConfigError);
  }
}

TEST(Speaker, rejects_a_voice_that_does_not_exist) {
  SpeakerConfig config;
  config.voice = "no-such-voice";
  Mixer mixer(MixerConfig{}, Audio::off);
  EXPECT_THROW(Speaker(config, mixer), DeviceError);
}

TEST_F(SilentSpeaker, keeps_quiet_for_as_long_as_speaking_takes_when_it_has_no_device) {
  const auto start = Clock::now();
  ASSERT_TRUE(says("drive straight, 8 meters"));
  EXPECT_GT(since(start), 0.5);
  EXPECT_EQ(speaker.status().spoken, 1U);
}

TEST_F(SilentSpeaker, speaks_faster_at_a_higher_rate) {
  std::vector<double> times;
  for (const int rate : {160, 440}) {
    speaker.set_rate(rate);
    const auto start = Clock::now();
    ASSERT_TRUE(says("drive straight, 8 meters"));
    times.push_back(since(start));
  }
  EXPECT_GT(times[0], 1.4 * times[1]);
}

TEST(Speaker, speaks_another_language_with_its_letters) {
  SpeakerConfig config;
  config.voice = "es";
  Mixer mixer(MixerConfig{}, Audio::off);
  Speaker speaker(config, mixer);
  speaker.start("estanter\u00eda muy cerca, detr\u00e1s");
  ASSERT_TRUE(wait_for([&] { return !speaker.busy(); }));
  EXPECT_EQ(speaker.status().spoken, 1U);
  EXPECT_EQ(speaker.status().failed, 0U);
}

Sound whole(const std::string& text, int rate, Voice& voice) {
  Sound sound = voice.begin(text, rate).value();
  const Sound rest = voice.rest().value();
  sound.samples.insert(sound.samples.end(), rest.samples.begin(), rest.samples.end());
  return sound;
}

/// The mean difference between a loudness and that of an ear in windows of 440 samples, at the place
/// of the windows where that is least, by 44 samples: a sound begins anywhere in a window.
double unlike(const std::vector<double>& said, const std::vector<double>& ear) {
  double least = 1.0;
  for (std::ptrdiff_t phase = 0; phase < 440; phase += 44) {
    const std::vector<double> heard = loudness({ear.begin() + phase, ear.end()}, 440);
    for (std::size_t offset = 0; offset + said.size() <= heard.size(); ++offset) {
      double sum = 0.0;
      for (std::size_t i = 0; i < said.size(); ++i) sum += std::abs(said[i] - heard[offset + i]);
      least = std::min(least, sum / static_cast<double>(said.size()));
    }
  }
  return least;
}

TEST(Speaker, plays_a_sentence_that_comes_in_two_parts_without_a_gap) {
  const std::string text = "the goal is 20 meters on, at 9 o'clock";
  Voice voice("en", 50);  // one of its own: espeak-ng says a sentence a little otherwise a second time
  std::size_t first = 0;
  std::vector<double> samples;
  for (const Sound& part : {voice.begin(text, 220).value(), voice.rest().value()}) {
    if (samples.empty()) first = part.samples.size();
    for (const std::int16_t sample : part.samples) samples.push_back(sample / 32768.0);
  }
  EXPECT_GT(samples.size(), 2 * first);
  {
    Mixer mixer(MixerConfig{}, Audio::on);
    Speaker speaker(SpeakerConfig{}, mixer);
    speaker.start(text);
    ASSERT_TRUE(wait_for([&] { return !speaker.busy(); }));
    pause(0.2);
  }
  std::vector<double> said = loudness(samples, 220);
  const std::vector<double> played = heard().left;
  std::vector<double> gap = said;
  gap.insert(gap.begin() + static_cast<std::ptrdiff_t>(first / 220), 3, 0.0);
  const std::vector<double> peaks = loudness(played, 440);
  const double level = *std::max_element(peaks.begin(), peaks.end()) /
                       *std::max_element(said.begin(), said.end());
  for (std::vector<double>* const one : {&gap, &said})
    for (double& peak : *one) peak *= level;
  EXPECT_LT(unlike(said, played), 0.3 * unlike(gap, played));
}

TEST_F(SilentSpeaker, F4_says_a_sentence_whose_voice_is_killed_by_the_next_voice) {
  for (unsigned i = 1; i <= 20; ++i) {
    ASSERT_EQ(voices().size(), 1U);
    ::kill(voices().front(), SIGKILL);
    const auto killed = Clock::now();
    speaker.start("stop");
    ASSERT_TRUE(wait_for([&] { return speaker.status().losses == i; }));
    navvi_test::expect_within(500, killed, "voice replaced " + std::to_string(i));
    ASSERT_TRUE(wait_for([&] { return !speaker.busy(); }));
    EXPECT_EQ(speaker.status().spoken, i);
    EXPECT_EQ(speaker.status().losses, i);
  }
  EXPECT_EQ(speaker.status().failed, 0U);
}

TEST_F(SilentSpeaker, F4_kills_a_voice_that_hangs_and_says_its_sentence_by_another) {
  const pid_t hangs = voices().at(0);
  ::kill(hangs, SIGSTOP);
  ASSERT_TRUE(says("stop"));
  EXPECT_EQ(speaker.status().spoken, 1U);
  EXPECT_EQ(speaker.status().losses, 1U);
  EXPECT_NE(voices().at(0), hangs);
}

TEST_F(SilentSpeaker, F4_replaces_a_voice_that_ends_while_nothing_is_said) {
  ::kill(voices().at(0), SIGKILL);
  EXPECT_TRUE(wait_for([&] { return speaker.status().losses == 1; }));
  EXPECT_TRUE(speaker.status().works);
}

#ifndef __SANITIZE_ADDRESS__  // which opens files, too
TEST_F(SilentSpeaker, F4_plays_a_sound_for_words_that_no_voice_says) {
  const pid_t voice = voices().at(0);
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  const rlimit none{3, files.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &none);  // no process can be started
  ::kill(voice, SIGKILL);
  EXPECT_TRUE(says("stop"));
  ::setrlimit(RLIMIT_NOFILE, &files);
  EXPECT_EQ(speaker.take_played().size(), 1U);
  EXPECT_EQ(speaker.status().failed, 1U);
  EXPECT_FALSE(speaker.status().works);
  EXPECT_FALSE(speaker.status().heard);
  speaker.start("stop");
  EXPECT_TRUE(wait_for([&] { return speaker.status().spoken == 1; }));
  EXPECT_TRUE(speaker.status().works);
}
#endif

/// Hz, of the lag at which a vowel is most like itself.
double fundamental(const Sound& sound) {
  const auto like = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = 4000; i < 8000; ++i) sum += sound.samples[i] * sound.samples[i + lag];
    return sum;
  };
  std::size_t best = 60;
  for (std::size_t lag = 60; lag < 350; ++lag)
    if (like(lag) > like(best)) best = lag;
  return sound.rate / static_cast<double>(best);
}

TEST(Speaker, speaks_higher_at_a_higher_pitch) {
  const auto pitch = [](int value) {
    Voice voice("en", value);
    return fundamental(whole("ah ah ah", 80, voice));
  };
  EXPECT_GT(pitch(80), 1.2 * pitch(20));
}

TEST_F(SilentSpeaker, F3_does_not_speak_what_could_harm_it) {
  std::string hostile;
  for (int i = 0; i < 68; ++i) hostile += "s'";
  for (const std::string& text : {hostile, std::string("<speak>"), std::string(), std::string(" ")})
    speaker.start(text);
  EXPECT_FALSE(speaker.busy());
  EXPECT_EQ(speaker.status().failed, 4U);
}

TEST_F(SilentSpeaker, survives_many_starts_and_stops) {
  for (int i = 0; i < 500; ++i) {
    speaker.start("turn to 3 o'clock, 8 meters");
    if (i % 3 == 0) speaker.stop();
    if (i % 50 == 0) pause(0.005);
  }
  speaker.stop();
  EXPECT_FALSE(speaker.busy());
}

TEST(Speaker, is_heard_and_falls_silent_at_once_when_stopped) {
  double whole = 0.0;
  {
    Mixer mixer(MixerConfig{}, Audio::on);
    Speaker speaker(SpeakerConfig{}, mixer);
    ASSERT_EQ(mixer.status().device, Mixer::Status::Device::open) << mixer.status().detail;
    EXPECT_FALSE(mixer.status().name.empty());
    const auto start = Clock::now();
    speaker.start("you have reached the goal");
    ASSERT_TRUE(wait_for([&] { return !speaker.busy(); }));
    EXPECT_TRUE(speaker.status().heard);
    whole = since(start);
    pause(0.2);
  }
  const double loud = loud_time();
  EXPECT_GT(loud, 0.6 * whole);
  const std::vector<double> all = loudness(heard().left, 22);
  ASSERT_FALSE(all.empty());
  EXPECT_LT(all.front(), 0.01) << "begins with a click";

  {
    Mixer mixer(MixerConfig{}, Audio::on);
    Speaker speaker(SpeakerConfig{}, mixer);
    speaker.start("you have reached the goal");
    pause(0.5);
    speaker.stop();
    EXPECT_FALSE(speaker.busy());
    pause(1.0);
  }
  EXPECT_GT(loud_time(), 0.2);
  EXPECT_LT(loud_time(), 0.75) << "went on after stop()";
}

TEST(Speaker, F2_a_device_that_takes_a_sentence_and_does_not_play_it_counts_as_lost_until_it_does) {
  const std::filesystem::path pipe = recording_folder() / "heard.wav";  // full, and nobody reads it
  std::filesystem::remove(pipe);
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  std::thread reader;
  {
    Mixer mixer(MixerConfig{}, Audio::on);
    Speaker speaker(SpeakerConfig{}, mixer);
    for (const char* text : {"drive straight, 8 meters", "turn to 3 o'clock, 8 meters"}) {
      speaker.start(text);
      EXPECT_TRUE(wait_for([&] { return !speaker.busy(); })) << text;
      EXPECT_EQ(mixer.status().device, Mixer::Status::Device::lost) << text;
      EXPECT_FALSE(mixer.play({22050, {1, 2, 3}}, 1.0, {1.0, 0.0})) << text;
      EXPECT_FALSE(speaker.status().heard) << text;
    }
    // A device that is closed waits for what it still plays.
    ::fcntl(end, F_SETFL, 0);
    reader = std::thread([end] {
      for (char bytes[4096]; ::read(end, bytes, sizeof bytes) > 0;) continue;
    });
    pause(0.5);
    speaker.start("go on, drive straight");
    EXPECT_TRUE(wait_for([&] { return !speaker.busy(); }));
    EXPECT_EQ(mixer.status().device, Mixer::Status::Device::open) << "it plays again";
    EXPECT_TRUE(speaker.status().heard);
  }
  reader.join();
  ::close(end);
  std::filesystem::remove(pipe);
}

TEST(Speaker, tells_when_words_begin_to_be_heard_and_when_they_end) {
  Mixer mixer(MixerConfig{}, Audio::on);
  Speaker speaker(SpeakerConfig{}, mixer);
  std::atomic<int> begun{0};
  std::atomic<int> silent{0};
  speaker.start("you have reached the goal", [&] { ++begun; });
  ASSERT_TRUE(wait_for([&] { return begun == 1; }));
  EXPECT_GT(mixer.mixed(), 0);
  speaker.stop([&] { ++silent; });
  ASSERT_TRUE(wait_for([&] { return silent == 1; }));
  speaker.stop([&] { ++silent; });  // nothing is heard that could end
  speaker.start("stop", [&] { ++begun; });
  ASSERT_TRUE(wait_for([&] { return begun == 2; }));
  EXPECT_EQ(silent, 1);
  speaker.stop([&] { ++silent; });
  speaker.start("go on, drive straight", [&] { ++begun; });
  ASSERT_TRUE(wait_for([&] { return begun == 3 && silent == 2; }));
}

TEST(Speaker, begins_a_sentence_while_the_one_that_it_cuts_fades_out) {
  {
    Mixer mixer(MixerConfig{}, Audio::on);
    Speaker speaker(SpeakerConfig{}, mixer);
    for (int i = 0; i < 20; ++i) {
      speaker.stop();
      speaker.start(i % 2 == 0 ? "you have reached the goal" : "drive straight");
      pause(0.3);
    }
    speaker.stop();
    pause(1.0);
  }
  const std::vector<double> all = loudness(heard().left, 22);
  EXPECT_GT(loud_time(), 2.0);
  EXPECT_LT(all.back(), 0.01) << "one of them is still heard";
}

TEST(Speaker, plays_each_sound_of_a_scan_from_its_place_before_its_word) {
  {
    Mixer mixer(MixerConfig{}, Audio::on);
    Speaker speaker(SpeakerConfig{}, mixer);
    const sounds::Play right{sounds::Earcon::beacon, {0.0, -1.0}, 1.0};
    const sounds::Play left{sounds::Earcon::beacon, {0.0, 1.0}, 1.0};
    speaker.start("shelf right, wall left", {}, {right, left});
    ASSERT_TRUE(wait_for([&] { return !speaker.busy(); }));
    EXPECT_EQ(speaker.take_played().size(), 2U);
    EXPECT_TRUE(speaker.take_played().empty());
    pause(0.1);
  }
  const Heard all = heard();
  const std::vector<double> left = loudness(all.left, 441);
  const std::vector<double> right = loudness(all.right, 441);
  // Words are as loud on both sides; what is not is a sound from one side.
  std::string sides;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const char side = left[i] > 0.1 + 3.0 * right[i]   ? 'l'
                      : right[i] > 0.1 + 3.0 * left[i] ? 'r'
                      : left[i] > 0.1                  ? 'w'
                                                       : ' ';
    if (side != ' ' && (sides.empty() || sides.back() != side)) sides += side;
  }
  EXPECT_EQ(sides, "rwlw");
}

TEST(SpeechChannel, stops_one_sentence_for_another_and_speaks_it_to_its_end) {
  Mixer mixer(MixerConfig{}, Audio::off);
  Latencies latencies;
  SpeechChannel channel(SpeakerConfig{}, mixer, latencies);
  channel.obey({false, "turn to 3 o'clock, 8 meters"});
  EXPECT_TRUE(channel.busy());
  channel.obey({true, "controller disconnected"});
  EXPECT_TRUE(channel.busy());
  ASSERT_TRUE(wait_for([&] { return !channel.busy(); }));
  EXPECT_EQ(channel.status().spoken, 1U) << "of the first not all";
}

TEST(SpeechChannel, times_words_answers_and_silence) {
  Mixer mixer(MixerConfig{}, Audio::on);
  Latencies latencies;
  SpeechChannel channel(SpeakerConfig{}, mixer, latencies);
  const auto seen = [&](Chain chain) {
    return wait_for([&] { return latencies.figures(chain).count == 1; });
  };
  channel.obey({false, "turn to 3 o'clock, 8 meters"});
  EXPECT_TRUE(seen(Chain::words));
  channel.obey({true, "goal 8 meters", true}, true);
  EXPECT_TRUE(seen(Chain::silence));
  EXPECT_TRUE(seen(Chain::answer));
  EXPECT_EQ(latencies.figures(Chain::words).count, 1U);
  channel.obey({true, "the letter G tells the goal", true});
  EXPECT_TRUE(wait_for([&] { return latencies.figures(Chain::words).count == 2; }));
  EXPECT_EQ(latencies.figures(Chain::answer).count, 1U) << "no button went down";
}

}  // namespace
}  // namespace navvi_feedback::devices
