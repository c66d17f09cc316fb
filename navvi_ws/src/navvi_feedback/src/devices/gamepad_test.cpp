#include "devices/gamepad.hpp"

#include <SDL.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <thread>

#include "devices/input_source.hpp"
#include "drive/drive.hpp"
#include "measured.hpp"
#include "virtual_pad.hpp"

// A device is its own clock: these tests wait, each for an event with a deadline.

// SDL's virtual pads have no sensors. Here some do.
std::atomic<bool> g_sensors{false};
extern "C" SDL_bool SDL_GameControllerHasSensor(SDL_GameController*, SDL_SensorType sensor) {
  return g_sensors && sensor == SDL_SENSOR_GYRO ? SDL_TRUE : SDL_FALSE;
}
extern "C" int SDL_GameControllerSetSensorEnabled(SDL_GameController*, SDL_SensorType, SDL_bool) {
  return 0;
}

namespace navvi_feedback::devices {
namespace {

using navvi_test::Clock;
using namespace std::chrono_literals;

constexpr auto kPriming = 450ms;  // the first, soft pulse

bool eventually(const std::function<bool()>& condition,
                std::chrono::milliseconds deadline = 3000ms) {
  const auto end = Clock::now() + deadline;
  while (Clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return condition();
}

class GamepadWith : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    ASSERT_EQ(SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER), 0) << SDL_GetError();
  }
  static void TearDownTestSuite() { SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER); }

  static bool connects(const Gamepad& gamepad) {
    return eventually([&] { return gamepad.status().connected && gamepad.input().live; });
  }
  /// Keeps asking for `rumble`, as the node does.
  static bool reaches(Gamepad& gamepad, const haptics::Rumble& rumble,
                      const std::function<bool()>& condition) {
    return eventually([&] {
      gamepad.rumble(rumble);
      return condition();
    });
  }
};

class ConnectedPad : public GamepadWith {
 protected:
  void SetUp() override { ASSERT_TRUE(connects(gamepad)); }

  Gamepad gamepad;
  VirtualPad pad;
};

TEST_F(GamepadWith, no_pad_is_not_live) {
  Gamepad gamepad;
  EXPECT_FALSE(gamepad.status().connected);
  EXPECT_FALSE(gamepad.input().live);
  gamepad.rumble({1.0, 1.0});
}

TEST_F(ConnectedPad, a_pad_gives_its_axes_left_and_forward_positive) {
  EXPECT_TRUE(gamepad.status().has_rumble);
  EXPECT_FALSE(gamepad.status().name.empty());
  pad.stick(-1.0, -0.5);  // SDL: left and up
  EXPECT_TRUE(eventually([&] {
    const drive::Stick stick = gamepad.input().stick();
    return std::abs(stick.x - 1.0) < 1e-3 && std::abs(stick.y - 0.5) < 1e-3;
  }));
  for (const double axis : gamepad.input().axes) {
    EXPECT_GE(axis, -1.0);
    EXPECT_LE(axis, 1.0);
  }
}

TEST_F(ConnectedPad, the_first_two_buttons_ask_for_the_direction_and_the_goal) {
  pad.press(SDL_CONTROLLER_BUTTON_A, true);
  EXPECT_TRUE(eventually([&] { return gamepad.input().button(0) && !gamepad.input().button(1); }));
  pad.press(SDL_CONTROLLER_BUTTON_A, false);
  pad.press(SDL_CONTROLLER_BUTTON_B, true);
  EXPECT_TRUE(eventually([&] { return !gamepad.input().button(0) && gamepad.input().button(1); }));
}

TEST_F(ConnectedPad, rumble_reaches_the_right_motors_and_expires_without_a_new_wish) {
  std::this_thread::sleep_for(kPriming);
  ASSERT_TRUE(reaches(gamepad, {0.75, 0.25}, [&] {
    return std::abs(pad.left() / 65535.0 - 0.75) < 0.01 &&
           std::abs(pad.right() / 65535.0 - 0.25) < 0.01;
  }));
  EXPECT_TRUE(eventually([&] { return pad.left() == 0 && pad.right() == 0; }, 600ms));
}

TEST_F(ConnectedPad, sides_that_matter_are_felt_at_the_triggers_too) {
  std::this_thread::sleep_for(kPriming);
  EXPECT_EQ(pad.right_trigger(), -1);
  ASSERT_TRUE(reaches(gamepad, {0.0, 0.7, true}, [&] {
    return std::abs(pad.right_trigger() / 65535.0 - 0.7) < 0.01 && pad.left_trigger() == 0;
  }));
  ASSERT_TRUE(reaches(gamepad, {0.0, 0.7}, [&] { return pad.right_trigger() == 0; }));
}

TEST_F(ConnectedPad, who_wishes_is_told_when_the_driver_was_if_that_is_another_command) {
  std::this_thread::sleep_for(kPriming);
  std::atomic<int> left{-1};
  gamepad.rumble({0.5, 0.0}, [&] { left = pad.left(); });
  ASSERT_TRUE(eventually([&] { return left >= 0; }));
  EXPECT_NEAR(left / 65535.0, 0.5, 0.01);
  std::atomic<int> again{0};
  gamepad.rumble({0.5, 0.0}, [&] { ++again; });
  gamepad.rumble({0.5, 0.0});
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(again, 0);
}

TEST_F(GamepadWith, a_wish_while_there_is_no_pad_is_not_told_to_be_felt_once_there_is_one) {
  Gamepad gamepad;
  std::atomic<int> told{0};
  gamepad.rumble({0.5, 0.0}, [&] { ++told; });
  VirtualPad pad;
  ASSERT_TRUE(connects(gamepad));
  ASSERT_TRUE(eventually([&] {
    gamepad.rumble({0.5, 0.0});
    return pad.left() / 65535.0 > 0.49;
  }));
  EXPECT_EQ(told, 0);
}

TEST_F(ConnectedPad, a_steady_wish_keeps_the_motors_turning_beyond_the_expiry) {
  ASSERT_TRUE(reaches(gamepad, {0.5, 0.5}, [&] { return pad.left() > 32000; }));
  const auto end = Clock::now() + 900ms;
  while (Clock::now() < end) {
    gamepad.rumble({0.5, 0.5});
    EXPECT_GT(pad.left(), 32000);
    std::this_thread::sleep_for(10ms);
  }
}

TEST_F(ConnectedPad, the_first_touch_of_the_motors_is_soft) {
  int strongest = 0;
  EXPECT_FALSE(eventually(
      [&] {
        strongest = std::max(strongest, pad.left());
        return strongest > 6600;  // a tenth
      },
      500ms));
  EXPECT_GT(strongest, 0);
  EXPECT_EQ(pad.left(), 0);
}

TEST_F(ConnectedPad, a_wish_that_is_not_finite_is_silence) {
  ASSERT_TRUE(reaches(gamepad, {1.0, 1.0}, [&] { return pad.left() == 65535; }));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(reaches(gamepad, {nan, nan}, [&] { return pad.left() == 0 && pad.right() == 0; }));
}

TEST_F(GamepadWith, leaving_stops_the_motors) {
  VirtualPad pad;
  {
    Gamepad gamepad;
    ASSERT_TRUE(connects(gamepad));
    ASSERT_TRUE(reaches(gamepad, {1.0, 1.0}, [&] { return pad.left() == 65535; }));
  }
  EXPECT_EQ(pad.left(), 0);
  EXPECT_EQ(pad.right(), 0);
}

TEST_F(ConnectedPad, J1_a_detached_pad_is_gone_within_100_ms) {
  pad.stick(0.0, -1.0);
  ASSERT_TRUE(eventually([&] { return gamepad.input().stick().y > 0.9; }));
  pad.detach();
  const auto detached = Clock::now();
  EXPECT_TRUE(eventually([&] { return !gamepad.input().live; }));
  navvi_test::expect_within(100, detached, "gone");
  EXPECT_FALSE(gamepad.status().connected);
}

TEST_F(GamepadWith, J3_a_pad_that_comes_back_held_forward_does_not_arm) {
  Gamepad gamepad;
  drive::Drive drive{drive::DriveConfig{}};
  const auto tick = [&] {
    const drive::InputState input = gamepad.input();
    const auto velocity =
        drive.update(input.live ? std::optional<drive::Stick>(input.stick()) : std::nullopt, 0.02);
    std::this_thread::sleep_for(5ms);
    return velocity;
  };
  auto pad = std::make_unique<VirtualPad>();
  ASSERT_TRUE(connects(gamepad));
  const unsigned session = gamepad.input().session;
  ASSERT_TRUE(eventually([&] {
    tick();
    return drive.armed();
  }));
  pad->detach();
  ASSERT_TRUE(eventually([&] { return !tick().has_value(); }));
  pad = std::make_unique<VirtualPad>();
  pad->stick(0.0, -1.0);
  ASSERT_TRUE(eventually([&] { return gamepad.input().stick().y > 0.9; }));
  EXPECT_NE(gamepad.input().session, session);
  for (int i = 0; i < 100; ++i) {
    const auto velocity = tick();
    ASSERT_TRUE(velocity.has_value());
    EXPECT_EQ(velocity->linear, 0.0);
  }
  EXPECT_FALSE(drive.armed());
}

TEST_F(GamepadWith, J4_a_second_pad_is_ignored_until_the_first_is_gone) {
  Gamepad gamepad;
  const auto reads = [&](double x) {
    return eventually([&] { return std::abs(gamepad.input().stick().x - x) < 1e-3; });
  };
  VirtualPad first;
  ASSERT_TRUE(connects(gamepad));
  {
    VirtualPad second;
    ASSERT_TRUE(eventually([&] { return gamepad.status().others == 1; }));
    second.stick(0.0, -1.0);
    first.stick(-0.5, 0.0);
    EXPECT_TRUE(reads(0.5));
    EXPECT_EQ(gamepad.input().stick().y, 0.0);
  }
  EXPECT_TRUE(eventually([&] { return gamepad.status().others == 0; }));
  first.stick(0.5, 0.0);
  EXPECT_TRUE(reads(-0.5));

  VirtualPad third;
  third.stick(-1.0, 0.0);
  first.detach();
  EXPECT_TRUE(reads(1.0));
}

TEST_F(GamepadWith, J5_rumble_during_and_after_a_detach_is_harmless) {
  Gamepad gamepad;
  std::atomic<bool> quit{false};
  std::thread shaker([&] {
    double force = 0.0;
    while (!quit) {
      gamepad.rumble({force, 1.0 - force});
      force = std::fmod(force + 0.013, 1.0);
      std::this_thread::sleep_for(200us);
    }
  });
  for (int i = 0; i < 10; ++i) {
    VirtualPad pad;
    EXPECT_TRUE(connects(gamepad));
    pad.detach();
    EXPECT_TRUE(eventually([&] { return !gamepad.input().live; }));
  }
  quit = true;
  shaker.join();
  EXPECT_GE(gamepad.status().connections, 10u);
}

TEST_F(GamepadWith, J6_a_pad_without_rumble_says_so) {
  Gamepad gamepad;
  VirtualPad pad(false);
  ASSERT_TRUE(connects(gamepad));
  EXPECT_FALSE(gamepad.status().has_rumble);
  gamepad.rumble({1.0, 1.0});
  std::this_thread::sleep_for(50ms);
  EXPECT_TRUE(gamepad.input().live);
  EXPECT_EQ(gamepad.status().rumble_errors, 0u);
}

TEST_F(ConnectedPad, J6_a_pad_that_refuses_its_rumble_has_none_until_it_obeys_again) {
  std::this_thread::sleep_for(kPriming);
  const auto has_rumble = [&] { return gamepad.status().has_rumble; };
  for (const haptics::Rumble& last : {haptics::Rumble{0.5, 0.5}, haptics::Rumble{0.7, 0.0}}) {
    ASSERT_TRUE(reaches(gamepad, last, [&] { return pad.left() > 32000 && has_rumble(); }));
    pad.refuse(true);
    EXPECT_TRUE(reaches(gamepad, {0.0, 0.6}, [&] { return !has_rumble(); }));
    EXPECT_GT(gamepad.status().rumble_errors, 0U);
    for (const haptics::Rumble& wish : {haptics::Rumble{}, last, haptics::Rumble{0.06, 0.06}}) {
      gamepad.rumble(wish);
      EXPECT_FALSE(eventually(has_rumble, 250ms)) << wish.left;
    }
    EXPECT_TRUE(gamepad.input().live);
    pad.refuse(false);
    EXPECT_TRUE(eventually(has_rumble)) << "though nothing is to be felt";
    EXPECT_TRUE(eventually([&] { return pad.left() == 0 && pad.right() == 0; }));
  }
}

TEST_F(GamepadWith, J2_a_frozen_link_with_the_stick_held_is_lost_within_500_ms) {
  StreamingPad streaming;
  Gamepad gamepad;
  ASSERT_TRUE(connects(gamepad));
  streaming.pad.stick(0.0, -1.0);
  ASSERT_TRUE(eventually([&] { return gamepad.input().stick().y > 0.9; }));
  ASSERT_TRUE(eventually([&] { return gamepad.status().heartbeat; }));
  // A held stick says nothing itself.
  EXPECT_FALSE(eventually([&] { return !gamepad.input().live; }, 1500ms));
  streaming.frozen = true;
  const auto frozen = Clock::now();
  EXPECT_TRUE(eventually([&] { return !gamepad.input().live; }));
  navvi_test::expect_within(500, frozen, "lost");
  EXPECT_EQ(gamepad.input().stick().y, 0.0);
  EXPECT_TRUE(gamepad.status().connected);
  EXPECT_TRUE(gamepad.status().silent);
  EXPECT_FALSE(gamepad.status().felt());

  const unsigned session = gamepad.input().session;
  streaming.frozen = false;
  EXPECT_TRUE(eventually([&] { return gamepad.input().live; }));
  EXPECT_NE(gamepad.input().session, session) << "the stick has to be neutral once more";
  EXPECT_FALSE(gamepad.status().silent);
}

TEST_F(GamepadWith, J2_a_pad_whose_sensor_never_streams_is_live_while_it_is_attached) {
  for (const bool sensors : {false, true}) {
    g_sensors = sensors;
    Gamepad gamepad;
    VirtualPad pad;
    ASSERT_TRUE(connects(gamepad));
    pad.stick(0.0, -1.0);
    ASSERT_TRUE(eventually([&] { return gamepad.input().stick().y > 0.9; }));
    EXPECT_FALSE(eventually([&] { return !gamepad.input().live; }, 1000ms));
    EXPECT_FALSE(gamepad.status().heartbeat) << "nothing guards it, and that is said";
    EXPECT_EQ(gamepad.input().stick().y, 1.0);
  }
  g_sensors = false;
}

/// What this process holds.
struct Held {
  std::size_t descriptors = 0, threads = 0;
  double memory = 0.0;  ///< MB
  double cpu = 0.0;     ///< s
};

Held held() {
  const auto entries = [](const char* folder) {
    const std::filesystem::directory_iterator first(folder);
    return static_cast<std::size_t>(std::distance(begin(first), end(first)));
  };
  std::ifstream file("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  file >> size >> resident;
  return {entries("/proc/self/fd"), entries("/proc/self/task"),
          resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6,
          static_cast<double>(std::clock()) / CLOCKS_PER_SEC};
}

TEST_F(GamepadWith, J8_three_hundred_attachments_and_detachments_leave_nothing_behind) {
  Gamepad gamepad;
  const auto churn = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      VirtualPad pad;
      pad.stick(0.0, -1.0);
      gamepad.rumble({0.5, 0.5});
      std::this_thread::sleep_for(5ms);
      pad.detach();
      std::this_thread::sleep_for(5ms);
    }
  };
  churn(50);  // what SDL keeps for good
  const Held before = held();
  const Clock::time_point begun = Clock::now();
  churn(300);
  const double wall = std::chrono::duration<double>(Clock::now() - begun).count();
  const Held after = held();
  EXPECT_EQ(after.descriptors, before.descriptors);
  EXPECT_EQ(after.threads, before.threads);
#ifndef __SANITIZE_ADDRESS__  // which keeps what was freed for a while
  EXPECT_LT(after.memory - before.memory, 2.0);
#endif
  EXPECT_LT((after.cpu - before.cpu) / wall, 0.5) << "of a core";
  EXPECT_FALSE(gamepad.input().live);
  VirtualPad pad;
  EXPECT_TRUE(connects(gamepad));
}

TEST_F(GamepadWith, auto_takes_the_pad_that_is_there) {
  VirtualPad pad;
  EXPECT_EQ(InputSource("auto").kind(), InputSource::Kind::pad);
}

}  // namespace
}  // namespace navvi_feedback::devices
