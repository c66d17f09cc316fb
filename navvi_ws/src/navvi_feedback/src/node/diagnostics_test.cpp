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
  EXPECT_EQ(state_of(pad_status(pad, "pad", false)), "missing");
  pad.connected = true;
  EXPECT_EQ(state_of(pad_status(pad, "pad", true)), "missing") << "no rumble";
  pad.has_rumble = true;
  EXPECT_EQ(state_of(pad_status(pad, "pad", true)), "works");
  EXPECT_EQ(state_of(pad_status(std::nullopt, "keyboard", true)), "off");
  EXPECT_EQ(state_of(pad_status(std::nullopt, "topic", true)), "works");
  EXPECT_EQ(state_of(pad_status(std::nullopt, "topic", false)), "missing");
}

TEST(Diagnostics, tell_sound_that_is_off_from_sound_that_is_missing) {
  using Device = devices::Mixer::Status::Device;
  devices::Mixer::Status mixer;
  const auto state = [&](Device device) {
    mixer.device = device;
    return state_of(audio_status(mixer));
  };
  EXPECT_EQ(state(Device::open), "works");
  EXPECT_EQ(state(Device::off), "off");
  EXPECT_EQ(state(Device::missing), "missing");
  EXPECT_EQ(state(Device::lost), "missing");
}

}  // namespace
}  // namespace navvi_feedback::node

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
