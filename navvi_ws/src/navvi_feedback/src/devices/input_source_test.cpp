#include "devices/input_source.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::devices {
namespace {

drive::InputState pushed(std::vector<bool> buttons = {}) {
  drive::InputState input;
  input.live = true;
  input.axes = {0.0, 1.0};
  input.buttons = std::move(buttons);
  return input;
}

TEST(InputSource, silent_for_250_ms_drives_nothing_and_is_lost_after_a_second) {
  InputSource source("topic");
  EXPECT_FALSE(source.read(10.0).live || source.read(10.0).late) << "nothing came yet";
  source.receive(pushed(), 10.0);
  EXPECT_TRUE(source.read(10.25).live);
  EXPECT_EQ(source.read(10.1).stick().y, 1.0);
  const drive::InputState silent = source.read(10.26);
  EXPECT_FALSE(silent.live);
  EXPECT_EQ(silent.stick().y, 0.0);
  EXPECT_TRUE(silent.late);
  EXPECT_FALSE(source.read(11.2).late);
  source.receive({}, 11.3);
  EXPECT_FALSE(source.read(11.4).late) << "the window says that it has lost the keys";
}

TEST(InputSource, counts_presses_between_two_reads_but_no_key_that_is_down_as_the_keys_come_back) {
  InputSource source("topic");
  for (const bool down : {false, true, false, true, false, true})
    source.receive(pushed({down}), 10.0);
  EXPECT_EQ(source.read(10.0).presses.at(0), 3U);
  const unsigned session = source.read(10.0).session;
  source.receive(pushed({true}), 11.0);
  EXPECT_EQ(source.read(11.0).presses.at(0), 3U);
  EXPECT_NE(source.read(11.0).session, session) << "and the stick has to be neutral";
}

}  // namespace
}  // namespace navvi_feedback::devices
