#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/feedback.hpp"
#include "devices/gamepad.hpp"
#include "navvi_feedback/node/msg_conversion.hpp"
#include "virtual_pad.hpp"

namespace navvi_feedback::node {
namespace {

const std::string kEnglish = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml";

TEST(OthersRumble, is_felt_on_our_own_pad_until_it_is_stale_and_below_a_pattern) {
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  ASSERT_EQ(SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER), 0) << SDL_GetError();
  {
    devices::Gamepad gamepad;
    devices::VirtualPad pad;
    core::Feedback feedback(core::FeedbackConfig{}, kEnglish);
    double time = 0.0;
    // A deadline for the pad's thread; the decisions have a clock of their own.
    const auto becomes = [&](const std::function<bool()>& felt) {
      for (int tick = 0; tick < 2000; ++tick, time += 0.02) {
        gamepad.rumble(feedback.update({}, false, time).rumble);
        if (felt()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
      return false;
    };
    ASSERT_TRUE(becomes([&] { return gamepad.status().connected && time > 4.0; }));
    ASSERT_TRUE(becomes([&] { return pad.left() == 0 && pad.right() == 0; }));

    const sensor_msgs::JoyFeedbackArray wish = feedback_msg({0.25, 0.5});
    const auto wished = [&] {
      return std::abs(pad.left() - 16384) < 300 && std::abs(pad.right() - 32768) < 300;
    };
    EXPECT_TRUE(becomes([&] {
      feedback.take(*from_msg(wish, "joy_node"), time);
      return wished();
    })) << pad.left()
        << " " << pad.right();

    // A shelf that is hit on the left is one long pulse there.
    feedback.take(Contact{ThingClass::shelf, {0.0, 0.4}, 7});
    EXPECT_TRUE(becomes([&] { return pad.left() > 50000 && pad.right() == 0; }));
    feedback.take(*from_msg(wish, "joy_node"), time);
    EXPECT_TRUE(becomes(wished)) << "the pattern is over";
    EXPECT_TRUE(becomes([&] { return pad.left() == 0 && pad.right() == 0; })) << "nobody asks";
  }
  SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER);
}

TEST(OthersRumble, is_dropped_whole_if_a_force_is_out_of_range) {
  sensor_msgs::JoyFeedbackArray wish = feedback_msg({0.25, 0.5}, "ds4_driver");
  ASSERT_TRUE(from_msg(wish, "ds4_driver"));
  EXPECT_FLOAT_EQ(static_cast<float>(from_msg(wish, "ds4_driver")->left), 0.25F);
  for (const float bad : {-0.1F, 1.1F, std::nanf("")}) {
    wish.array[1].intensity = bad;
    EXPECT_FALSE(from_msg(wish, "ds4_driver")) << bad;
  }
}

}  // namespace
}  // namespace navvi_feedback::node
