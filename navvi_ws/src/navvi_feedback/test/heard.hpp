#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "temp_folder.hpp"

// For tests: what OpenAL Soft would have sent to the loudspeakers, from its own wave writer.

namespace navvi_feedback::devices {

/// Samples a second of a recording.
constexpr double kHeardRate = 44100.0;

/// Both ears, each sample as its share of full scale.
struct Heard {
  std::vector<double> left;
  std::vector<double> right;
};

/// Waits for `seconds` of real time: a device cannot be hurried.
inline void pause(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// A folder of this process, for the recording; set up before the first use of OpenAL Soft.
inline const navvi_test::TempFolder& recording_folder() {
  static const navvi_test::TempFolder folder;
  return folder;
}

/// Has OpenAL Soft write what it plays into a file, in a program whose tests listen.
class Recording : public testing::Environment {
 public:
  void SetUp() override {
    const std::string config = recording_folder().write(
        "alsoft.conf",
        "[general]\ndrivers=wave\nchannels=stereo\nsample-type=int16\nfrequency=44100\n[wave]\n"
        "file=" + (recording_folder() / "heard.wav").string() + "\n");
    setenv("ALSOFT_CONF", config.c_str(), 1);
  }
};
inline testing::Environment* const recording =
    testing::AddGlobalTestEnvironment(new Recording);  // gtest deletes it

/// What was recorded since the device was opened last.
inline Heard heard() {
  const std::string bytes = recording_folder().text("heard.wav");
  constexpr std::size_t kHeader = 68;  // at most; a few samples more or less do not matter
  Heard result;
  const auto sample = [&](std::size_t at) {
    const auto low = static_cast<unsigned char>(bytes[at]);
    return (static_cast<signed char>(bytes[at + 1]) * 256 + low) / 32768.0;
  };
  for (std::size_t at = kHeader; at + 4 <= bytes.size(); at += 4) {
    result.left.push_back(sample(at));
    result.right.push_back(sample(at + 2));
  }
  return result;
}

/// The loudness, window by window, as the largest sample's share of full scale.
inline std::vector<double> loudness(const std::vector<double>& ear, std::size_t window) {
  std::vector<double> peaks;
  for (std::size_t at = 0; at + window <= ear.size(); at += window) {
    double peak = 0.0;
    for (std::size_t i = 0; i < window; ++i) peak = std::max(peak, std::abs(ear[at + i]));
    peaks.push_back(peak);
  }
  return peaks;
}

/// How much of `frequency` (Hz) is in it: the amplitude of that sine over the samples that are not
/// silent (Goertzel).
inline double tone_in(const std::vector<double>& ear, double frequency) {
  const auto loud = [](double sample) { return std::abs(sample) > 1e-3; };
  const auto first = std::find_if(ear.begin(), ear.end(), loud);
  const auto last = std::find_if(ear.rbegin(), std::make_reverse_iterator(first), loud).base();
  const double step = 2.0 * std::acos(-1.0) * frequency / kHeardRate;
  double in_phase = 0.0;
  double across = 0.0;
  for (auto sample = first; sample < last; ++sample) {
    const double angle = step * static_cast<double>(sample - first);
    in_phase += *sample * std::cos(angle);
    across += *sample * std::sin(angle);
  }
  return last > first ? 2.0 * std::hypot(in_phase, across) / static_cast<double>(last - first)
                      : 0.0;
}

/// The voices' processes.
inline std::vector<pid_t> voices() {
  std::vector<pid_t> found;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream children(thread.path() / "children");
    for (pid_t id = 0; children >> id;) found.push_back(id);
  }
  return found;
}

}  // namespace navvi_feedback::devices
