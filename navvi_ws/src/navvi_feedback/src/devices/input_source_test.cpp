#include "devices/input_source.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::devices {
namespace {

TEST(InputSource, silent_for_a_moment_drives_nothing_and_is_lost_after_a_second) {
  InputSource source("topic");
  EXPECT_FALSE(source.read(10.0).late) << "nothing came yet";
  drive::InputState pushed;
  pushed.live = true;
  pushed.axes = {0.0, 1.0};
  source.receive(pushed, 10.0);
  EXPECT_TRUE(source.read(10.2).live);
  const drive::InputState silent = source.read(10.4);
  EXPECT_FALSE(silent.live);
  EXPECT_EQ(silent.stick().y, 0.0);
  EXPECT_TRUE(silent.late);
  EXPECT_FALSE(source.read(11.2).late);
  source.receive({}, 11.3);
  EXPECT_FALSE(source.read(11.4).late) << "the window says that it has lost the keys";
}

}  // namespace
}  // namespace navvi_feedback::devices
