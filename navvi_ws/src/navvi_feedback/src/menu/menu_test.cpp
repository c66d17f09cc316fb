#include "menu/menu.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::menu {
namespace {

using drive::Button;
using navvi_types::TrialRequest;
using State = navvi_types::TrialState::State;

class MenuTest : public testing::Test {
 protected:
  MenuTest() {
    choices_.destinations = {{cues::PlaceName::task, 0, {1.0, 2.0}},
                             {cues::PlaceName::dock, 1, {3.0, 4.0}},
                             {cues::PlaceName::dock, 2, {5.0, 6.0}}};
  }

  /// The last step.
  Menu::Step press(std::initializer_list<Button> buttons) {
    Menu::Step step;
    for (const Button button : buttons) step = menu_.press(button, choices_);
    return step;
  }
  std::string heard(std::initializer_list<Button> buttons) {
    const Menu::Step step = press(buttons);
    if (!step.told) return "";
    const int number = step.told->fillings.number;
    return step.told->kind + (number > 0 ? " " + std::to_string(number) : "");
  }

  Menu menu_;
  Choices choices_;
};

TEST_F(MenuTest, leads_to_a_goal_by_short_presses_of_one_hand) {
  EXPECT_EQ(heard({Button::next}), "menu_goals");
  EXPECT_EQ(heard({Button::choose}), "menu_place");
  EXPECT_EQ(heard({Button::next}), "menu_place 1");
  EXPECT_EQ(heard({Button::next}), "menu_place 2");
  EXPECT_EQ(heard({Button::next}), "menu_place") << "round";
  EXPECT_EQ(heard({Button::previous}), "menu_place 2");
  const Menu::Step chosen = press({Button::choose});
  ASSERT_TRUE(chosen.goal);
  EXPECT_EQ(chosen.goal->x(), 5.0);
  EXPECT_EQ(chosen.told->kind, "goal_chosen");
  EXPECT_FALSE(menu_.open());
}

TEST_F(MenuTest, goes_back_level_by_level_and_says_that_it_is_closed) {
  press({Button::choose, Button::choose});
  EXPECT_EQ(heard({Button::back}), "menu_goals");
  EXPECT_EQ(heard({Button::back}), "menu_closed");
  EXPECT_EQ(heard({Button::back}), "menu_closed");
  EXPECT_EQ(heard({Button::repeat}), "");
}

TEST_F(MenuTest, begins_a_trial_and_ends_it_only_when_asked_twice) {
  choices_.trial = State::ready;
  EXPECT_EQ(heard({Button::next}), "menu_begin");
  EXPECT_EQ(press({Button::choose}).request, TrialRequest::Kind::begin);
  choices_.trial = State::running;
  EXPECT_EQ(heard({Button::end}), "menu_end_sure");
  EXPECT_EQ(heard({Button::back}), "menu_goals");
  press({Button::back});
  EXPECT_EQ(press({Button::end, Button::end}).request, TrialRequest::Kind::end);
  EXPECT_EQ(heard({Button::next, Button::next}), "menu_end");
  const Menu::Step asked = press({Button::choose});
  EXPECT_FALSE(asked.request);
  EXPECT_EQ(asked.told->kind, "menu_end_sure");
  EXPECT_EQ(press({Button::choose}).request, TrialRequest::Kind::end);
}

TEST_F(MenuTest, survives_that_what_can_be_chosen_goes_away) {
  press({Button::next, Button::choose, Button::next, Button::next});
  choices_.destinations.resize(1);
  EXPECT_EQ(heard({Button::choose}), "menu_place") << "said before it is chosen";
  choices_.destinations.clear();
  EXPECT_EQ(heard({Button::choose}), "menu_empty");
  EXPECT_EQ(heard({Button::choose}), "menu_empty");
  EXPECT_EQ(heard({Button::back}), "menu_closed");
}

}  // namespace
}  // namespace navvi_feedback::menu

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
