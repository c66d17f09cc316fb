#include "devices/speaker.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <navvi_config/reader.hpp>
#include <thread>
#include <vector>

#include "devices/device_error.hpp"
#include "devices/speech_channel.hpp"

namespace navvi_feedback::devices {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

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

void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// Where OpenAL Soft writes what would be heard; set up before its first use in this process.
fs::path recording() {
  static const fs::path folder = [] {
    std::string name = (fs::temp_directory_path() / "navvi_speaker_XXXXXX").string();
    return fs::path(mkdtemp(name.data()));
  }();
  return folder / "heard.wav";
}

void record_what_is_heard() {
  const fs::path config = recording().parent_path() / "alsoft.conf";
  std::ofstream(config)
      << "[general]\ndrivers=wave\nchannels=mono\nsample-type=int16\n[wave]\nfile="
      << recording().string() << "\n";
  setenv("ALSOFT_CONF", config.c_str(), 1);
}

/// The loudness of the recording, window by window, as the largest sample's share of full scale.
/// \param window  samples, at 44.1 kHz
std::vector<double> heard(std::size_t window) {
  std::ifstream file(recording(), std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)),
                                std::istreambuf_iterator<char>());
  constexpr std::size_t kHeader = 68;  // at most; a few samples more or less do not matter
  std::vector<double> loudness;
  for (std::size_t at = kHeader; at + 2 * window <= bytes.size(); at += 2 * window) {
    double peak = 0.0;
    for (std::size_t i = 0; i < window; ++i) {
      const auto low = static_cast<unsigned char>(bytes[at + 2 * i]);
      const auto high = static_cast<signed char>(bytes[at + 2 * i + 1]);
      peak = std::max(peak, std::abs(high * 256 + low) / 32768.0);
    }
    loudness.push_back(peak);
  }
  return loudness;
}

/// s of the recording that are not silent.
double loud_time() {
  double time = 0.0;
  for (const double peak : heard(441)) time += peak > 0.01 ? 0.01 : 0.0;
  return time;
}

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
  EXPECT_THROW(Speaker(config, Audio::off), DeviceError);
}

TEST(Speaker, is_one_at_a_time) {
  const Speaker speaker(SpeakerConfig{}, Audio::off);
  EXPECT_THROW(Speaker(SpeakerConfig{}, Audio::off), DeviceError);
}

TEST(Speaker, keeps_quiet_for_as_long_as_speaking_takes_when_it_has_no_device) {
  Speaker speaker(SpeakerConfig{}, Audio::off);
  EXPECT_EQ(speaker.status().device, Speaker::Status::Device::off);
  const auto start = Clock::now();
  speaker.start("straight ahead, 8 meters");
  EXPECT_TRUE(speaker.busy());
  ASSERT_TRUE(wait_for([&] { return !speaker.busy(); }));
  EXPECT_GT(since(start), 0.5);
  EXPECT_EQ(speaker.status().spoken, 1U);
}

TEST(Speaker, speaks_faster_at_a_higher_rate) {
  std::vector<double> times;
  for (const int rate : {160, 440}) {
    SpeakerConfig config;
    config.rate = rate;
    Speaker speaker(config, Audio::off);
    const auto start = Clock::now();
    speaker.start("straight ahead, 8 meters");
    ASSERT_TRUE(wait_for([&] { return !speaker.busy(); }));
    times.push_back(since(start));
  }
  EXPECT_GT(times[0], 1.4 * times[1]);
}

TEST(Speaker, speaks_another_language_with_its_letters) {
  SpeakerConfig config;
  config.voice = "es";
  Speaker speaker(config, Audio::off);
  speaker.start("estanter\u00eda muy cerca, detr\u00e1s");
  ASSERT_TRUE(wait_for([&] { return !speaker.busy(); }));
  EXPECT_EQ(speaker.status().spoken, 1U);
  EXPECT_EQ(speaker.status().failed, 0U);
}

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
    return fundamental(Voice("en", 80, value).synthesize("ah ah ah", [] { return false; }));
  };
  EXPECT_GT(pitch(80), 1.2 * pitch(20));
}

TEST(Speaker, does_not_speak_what_could_harm_it) {
  Speaker speaker(SpeakerConfig{}, Audio::off);
  std::string hostile;
  for (int i = 0; i < 68; ++i) hostile += "s'";
  for (const std::string& text : {hostile, std::string("<speak>"), std::string(), std::string(" ")})
    speaker.start(text);
  EXPECT_FALSE(speaker.busy());
  EXPECT_EQ(speaker.status().failed, 4U);
}

TEST(Speaker, survives_many_starts_and_stops) {
  Speaker speaker(SpeakerConfig{}, Audio::off);
  for (int i = 0; i < 500; ++i) {
    speaker.start("3 o'clock, 8 meters");
    if (i % 3 == 0) speaker.stop();
    if (i % 50 == 0) pause(0.005);
  }
  speaker.stop();
  EXPECT_FALSE(speaker.busy());
}

TEST(Speaker, is_heard_and_falls_silent_at_once_when_stopped) {
  double whole = 0.0;
  {
    Speaker speaker(SpeakerConfig{}, Audio::on);
    ASSERT_EQ(speaker.status().device, Speaker::Status::Device::open) << speaker.status().detail;
    EXPECT_FALSE(speaker.status().name.empty());
    const auto start = Clock::now();
    speaker.start("You have reached your destination");
    ASSERT_TRUE(wait_for([&] { return !speaker.busy(); }));
    whole = since(start);
    pause(0.2);
  }
  const double loud = loud_time();
  EXPECT_GT(loud, 0.6 * whole);
  const std::vector<double> all = heard(22);
  ASSERT_FALSE(all.empty());
  EXPECT_LT(all.front(), 0.01) << "begins with a click";

  {
    Speaker speaker(SpeakerConfig{}, Audio::on);
    speaker.start("You have reached your destination");
    pause(0.5);
    speaker.stop();
    EXPECT_FALSE(speaker.busy());
    pause(1.0);
  }
  EXPECT_GT(loud_time(), 0.2);
  EXPECT_LT(loud_time(), 0.75) << "went on after stop()";
}

TEST(SpeechChannel, lets_a_safety_cue_be_heard_and_gives_every_cue_its_end) {
  SpeechChannel channel(SpeakerConfig{}, Audio::off);
  std::vector<CueEvent> events;
  const auto start = Clock::now();
  const auto tick = [&](const std::vector<cues::Cue>& cues) {
    for (CueEvent& event : channel.tick(cues, since(start))) events.push_back(std::move(event));
  };
  tick({{"direction", "3 o'clock, 8 meters", Priority::text, 2.0}});
  EXPECT_FALSE(channel.idle());
  tick({{"pad_lost", "controller disconnected", Priority::important, 2.0}});
  ASSERT_TRUE(wait_for([&] {
    tick({});
    return channel.idle();
  }));
  std::vector<CueStage> stages;
  for (const CueEvent& event : events) stages.push_back(event.stage);
  EXPECT_EQ(stages, (std::vector<CueStage>{CueStage::queued, CueStage::started, CueStage::queued,
                                           CueStage::cut, CueStage::started, CueStage::ended}));
  EXPECT_EQ(channel.status().spoken, 1U);
}

}  // namespace
}  // namespace navvi_feedback::devices

int main(int argc, char** argv) {
  navvi_feedback::devices::record_what_is_heard();
  testing::InitGoogleTest(&argc, argv);
  const int result = RUN_ALL_TESTS();
  std::filesystem::remove_all(navvi_feedback::devices::recording().parent_path());
  return result;
}
