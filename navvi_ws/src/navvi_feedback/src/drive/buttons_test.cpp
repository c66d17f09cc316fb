#include "navvi_feedback/drive/buttons.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

namespace navvi_feedback::drive {
namespace {

InputState down(std::size_t button) {
  InputState input;
  input.live = true;
  input.buttons.resize(button + 1);
  input.buttons[button] = true;
  return input;
}

TEST(Buttons, act_once_however_long_they_are_held) {
  Buttons buttons{ButtonsConfig{}};
  EXPECT_TRUE(buttons.update({}).empty());
  EXPECT_EQ(buttons.update(down(6)), std::vector{Button::start});
  EXPECT_TRUE(buttons.update(down(6)).empty());
  EXPECT_EQ(buttons.update(down(1)), std::vector{Button::goal});
  EXPECT_TRUE(buttons.update({}).empty());
  EXPECT_EQ(buttons.update(down(6)), std::vector{Button::start});
}

TEST(Buttons, of_the_arrow_pad_may_come_as_axes) {
  Buttons buttons{ButtonsConfig{}};
  const auto pressed = [&](double left, double up) {
    InputState input;
    input.axes = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, left, up};
    (void)buttons.update({});
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
  EXPECT_EQ(buttons.update(down(1)), std::vector{Button::start});
  EXPECT_TRUE(buttons.update(down(6)).empty());
  EXPECT_THROW(navvi_config::read(config, YAML::Load("{start: 256}"), "test"),
               navvi_config::ConfigError);
}

}  // namespace
}  // namespace navvi_feedback::drive
