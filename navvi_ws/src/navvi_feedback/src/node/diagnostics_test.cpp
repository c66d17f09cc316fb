#include "node/diagnostics.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::node {
namespace {

std::string state_of(const diagnostic_msgs::DiagnosticStatus& status) {
  for (const auto& pair : status.values)
    if (pair.key == "state") return pair.value;
  return "";
}

TEST(Diagnostics, tell_a_pad_that_can_be_felt_from_one_that_cannot) {
  devices::Gamepad::Status pad;
  EXPECT_EQ(state_of(pad_status(pad, "pad", false, true)), "missing");
  pad.connected = true;
  EXPECT_EQ(state_of(pad_status(pad, "pad", true, true)), "missing") << "no rumble";
  pad.has_rumble = true;
  EXPECT_EQ(state_of(pad_status(pad, "pad", true, true)), "works");
  EXPECT_EQ(state_of(pad_status(pad, "pad", true, false)), "off") << "by intent";
  pad.silent = true;
  EXPECT_EQ(state_of(pad_status(pad, "pad", false, true)), "missing") << "its link is frozen";
  EXPECT_EQ(state_of(pad_status(std::nullopt, "keyboard", true, true)), "off");
  EXPECT_EQ(state_of(pad_status(std::nullopt, "topic", true, true)), "works");
  EXPECT_EQ(state_of(pad_status(std::nullopt, "topic", false, true)), "missing");
}

TEST(Diagnostics, tell_the_person_of_a_pad_that_jolts_cannot_rumble_or_is_ignored) {
  devices::Gamepad::Status pad;
  EXPECT_TRUE(notices_of(pad).empty());
  pad.connected = pad.has_rumble = pad.jolting_firmware = true;
  EXPECT_EQ(notices_of(pad), (std::vector<Content>{{CueKind::notice, About::pad_firmware}}));
  pad.has_rumble = false;
  pad.others = 1;
  EXPECT_EQ(notices_of(pad), (std::vector<Content>{{CueKind::notice, About::no_rumble},
                                                   {CueKind::notice, About::second_pad}}));
}

TEST(Diagnostics, tell_how_long_the_person_waited_for_what_was_seen) {
  devices::Latencies latencies;
  EXPECT_TRUE(latency_status(latencies, std::nullopt).values.empty());
  latencies.add(devices::Chain::motors,
                devices::Latencies::Clock::now() - std::chrono::milliseconds(20));
  const diagnostic_msgs::DiagnosticStatus status =
      latency_status(latencies, sounds::Learnt{0.4375, 0.5, 0.25, true});
  ASSERT_EQ(status.values.size(), 8U);
  EXPECT_EQ(status.values[0].key, "motors_p50_ms");
  EXPECT_GE(std::stod(status.values[0].value), 20.0);
  EXPECT_EQ(status.values[3].value, "1");
  EXPECT_EQ(status.values[4].key, "stopping_delay_s");
  EXPECT_EQ(status.values[4].value.rfind("0.43", 0), 0U);
  EXPECT_EQ(status.values[5].key, "stopping_spread_s");
  EXPECT_EQ(status.values[5].value, "0.500");
  EXPECT_EQ(status.values[6].key, "turn_error_rad");
  EXPECT_EQ(status.values[6].value, "0.250");
  EXPECT_EQ(status.values[7].key, "words_lead");
  EXPECT_EQ(status.values[7].value, "yes");
}

TEST(Diagnostics, tell_sound_that_is_off_from_sound_that_is_missing) {
  using Device = devices::Mixer::Status::Device;
  devices::Mixer::Status mixer;
  for (const auto& [device, state] :
       {std::pair(Device::open, "works"), std::pair(Device::off, "off"),
        std::pair(Device::missing, "missing"), std::pair(Device::lost, "missing")}) {
    mixer.device = device;
    EXPECT_EQ(state_of(audio_status(mixer)), state);
  }
}

TEST(Diagnostics, a_beat_that_is_late_is_a_warning) {
  Beat beat(0.1);
  EXPECT_EQ(beat_status(beat).level, diagnostic_msgs::DiagnosticStatus::OK);
  for (double time = 0.0; time < 2.0; time += 0.2) (void)beat.becomes_late(time);
  EXPECT_EQ(beat_status(beat).level, diagnostic_msgs::DiagnosticStatus::WARN);
}

}  // namespace
}  // namespace navvi_feedback::node
