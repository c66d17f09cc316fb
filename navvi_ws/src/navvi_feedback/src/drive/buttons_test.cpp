#include "drive/buttons.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

#include "drive/press_counter.hpp"

namespace navvi_feedback::drive {
namespace {

InputState released() {
  InputState input;
  input.live = true;
  return input;
}

InputState down(std::size_t button) {
  InputState input = released();
  input.buttons.resize(button + 1);
  input.buttons[button] = true;
  return input;
}

TEST(Buttons, act_once_however_long_they_are_held) {
  Buttons buttons{ButtonsConfig{}};
  EXPECT_TRUE(buttons.update(released()).empty());
  EXPECT_EQ(buttons.update(down(6)), std::vector{Button::start});
  EXPECT_TRUE(buttons.update(down(6)).empty());
  EXPECT_EQ(buttons.update(down(1)), std::vector{Button::goal});
  EXPECT_TRUE(buttons.update(released()).empty());
  EXPECT_EQ(buttons.update(down(6)), std::vector{Button::start});
}

TEST(Buttons, that_are_down_when_the_device_comes_or_comes_back_were_not_pressed) {
  Buttons buttons{ButtonsConfig{}};
  EXPECT_TRUE(buttons.update(down(6)).empty());
  (void)buttons.update(released());
  EXPECT_EQ(buttons.update(down(6)), std::vector{Button::start});
  EXPECT_TRUE(buttons.update({}).empty());
  EXPECT_TRUE(buttons.update(down(6)).empty());
  InputState other = down(1);
  ++other.session;
  EXPECT_TRUE(buttons.update(other).empty()) << "opened anew between two ticks";
}

TEST(Buttons, count_presses_that_begin_and_end_between_two_reads) {
  Buttons buttons{ButtonsConfig{}};
  PressCounter counter;
  (void)buttons.update(counter.count(released()));
  InputState read;
  for (int i = 0; i < 2; ++i) {
    (void)counter.count(down(6));
    read = counter.count(released());
  }
  EXPECT_EQ(buttons.update(read), (std::vector{Button::start, Button::start}));
  EXPECT_TRUE(buttons.update(read).empty());
  EXPECT_EQ(buttons.update(counter.count(down(6))), std::vector{Button::start});
  EXPECT_TRUE(buttons.update(counter.count(down(6))).empty());
}

TEST(PressCounter, does_not_count_what_is_down_when_the_device_comes_back) {
  PressCounter counter;
  EXPECT_EQ(counter.count(down(2)).presses, (std::vector<unsigned>{0, 0, 0}));
  (void)counter.count(released());
  EXPECT_EQ(counter.count(down(2)).presses[2], 1u);
  (void)counter.count({});
  EXPECT_EQ(counter.count(down(2)).presses[2], 1u);
}

TEST(Buttons, of_the_arrow_pad_may_come_as_axes) {
  Buttons buttons{ButtonsConfig{}};
  const auto pressed = [&](double left, double up) {
    InputState input = released();
    input.axes = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, left, up};
    (void)buttons.update(released());
    return buttons.update(input);
  };
  EXPECT_EQ(pressed(0.0, 1.0), std::vector{Button::previous});
  EXPECT_EQ(pressed(0.0, -1.0), std::vector{Button::next});
  EXPECT_EQ(pressed(1.0, 0.0), std::vector{Button::back});
  EXPECT_EQ(pressed(-1.0, 0.0), std::vector{Button::choose});
  EXPECT_TRUE(pressed(0.0, 0.0).empty());
}

TEST(Buttons, are_those_that_the_person_wants) {
  ButtonsConfig config;
  navvi_config::read(config, YAML::Load("{start: 1, goal: -1}"), "test");
  Buttons buttons(config);
  (void)buttons.update(released());
  EXPECT_EQ(buttons.update(down(1)), std::vector{Button::start});
  EXPECT_TRUE(buttons.update(down(6)).empty());
  EXPECT_THROW(navvi_config::read(config, YAML::Load("{start: 256}"), "test"),
               navvi_config::ConfigError);
}

}  // namespace
}  // namespace navvi_feedback::drive
