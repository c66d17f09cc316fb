#include "menu/menu.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::menu {
namespace {

using drive::Button;
using State = navvi_types::TrialState::State;

class MenuTest : public testing::Test {
 protected:
  MenuTest() {
    scenario_.goal = {1.0, 2.0};
    scenario_.places = {{navvi_types::Place::Kind::dock, 1, {3.0, 4.0}},
                        {navvi_types::Place::Kind::dock, 2, {5.0, 6.0}}};
    menu_.take(scenario_);
  }

  /// The last step.
  Menu::Step press(std::initializer_list<Button> buttons) {
    Menu::Step step;
    for (const Button button : buttons) step = menu_.press(button);
    return step;
  }
  std::string heard(std::initializer_list<Button> buttons) {
    const Menu::Step step = press(buttons);
    if (!step.told) return "";
    const int number = step.told->fillings.number;
    return to_string(Content(*step.told)) + (number > 0 ? " " + std::to_string(number) : "");
  }

  void trial(State state) { menu_.take(TrialState{state}); }

  Scenario scenario_;
  Menu menu_;
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
  EXPECT_EQ(chosen.told->about, About::goal_chosen);
  EXPECT_FALSE(menu_.open());
}

TEST_F(MenuTest, takes_a_second_press_of_start_for_the_first) {
  trial(State::ready);
  EXPECT_TRUE(press({Button::start}).request);
  trial(State::running);
  EXPECT_FALSE(menu_.pass(0.4));
  EXPECT_EQ(heard({Button::start}), "");
  EXPECT_FALSE(menu_.open());
  EXPECT_FALSE(menu_.pass(2.0));
  EXPECT_NE(heard({Button::start}), "") << "later, the menu";
  EXPECT_TRUE(menu_.open());
}

TEST_F(MenuTest, offers_neither_goals_nor_settings_where_a_study_has_set_them) {
  menu_.lock(true);
  menu_.take_goal({3.0, 4.0});
  menu_.take(std::vector<NamedPlace>{{"gate", {-3.0, 4.0}}});
  menu_.take_settings({{"haptics/strength", "0.7"}});
  trial(State::ready);
  EXPECT_EQ(heard({Button::choose}), "menu_begin");
  EXPECT_EQ(heard({Button::next}), "menu_glossary");
  EXPECT_EQ(heard({Button::next}), "menu_begin") << "round";
  press({Button::back});
  trial(State::running);
  EXPECT_EQ(heard({Button::choose}), "menu_end");
  EXPECT_EQ(heard({Button::next}), "menu_end") << "round";
  EXPECT_EQ(heard({Button::settings}), "menu_empty");
  EXPECT_EQ(heard({Button::choose}), "menu_end") << "back at the top";
}

TEST_F(MenuTest, goes_back_level_by_level_and_says_that_it_is_closed) {
  press({Button::choose, Button::choose});
  EXPECT_EQ(heard({Button::back}), "menu_goals");
  EXPECT_EQ(heard({Button::back}), "menu_closed");
  EXPECT_FALSE(press({Button::back}).told) << "it is closed already";
  EXPECT_EQ(heard({Button::repeat}), "");
}

TEST_F(MenuTest, changes_the_goal_of_a_running_trial_only_when_asked_twice) {
  trial(State::running);
  press({Button::next, Button::choose, Button::next});
  Menu::Step step = press({Button::choose});
  EXPECT_FALSE(step.goal);
  EXPECT_EQ(step.told.value().about, About::goal_sure);
  EXPECT_EQ(step.told.value().fillings.number, 1);
  EXPECT_EQ(heard({Button::back}), "menu_place 1") << "not this one";
  EXPECT_EQ(heard({Button::choose, Button::next}), "goal_sure 1");
  step = press({Button::choose});
  ASSERT_TRUE(step.goal);
  EXPECT_EQ(step.goal->x(), 3.0);
  EXPECT_EQ(step.told.value().about, About::goal_chosen);
}

TEST_F(MenuTest, asks_for_no_goal_twice_once_the_trial_is_over) {
  trial(State::running);
  press({Button::next, Button::choose, Button::choose});
  trial(State::choose_goal);
  EXPECT_TRUE(press({Button::choose}).goal);
  EXPECT_TRUE(press({Button::next, Button::choose, Button::choose}).goal);
}

TEST_F(MenuTest, closes_20_s_after_the_last_press) {
  EXPECT_FALSE(menu_.pass(100.0)) << "it is closed";
  press({Button::next});
  EXPECT_FALSE(menu_.pass(19.0));
  press({Button::choose});
  EXPECT_FALSE(menu_.pass(19.0));
  EXPECT_TRUE(menu_.pass(2.0));
  EXPECT_FALSE(menu_.open());
  EXPECT_FALSE(menu_.pass(30.0)) << "once";
}

TEST_F(MenuTest, is_left_at_once_from_wherever_it_is_and_nothing_else_is) {
  trial(State::running);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(heard({Button::leave}), "");
  EXPECT_FALSE(press({Button::leave, Button::leave}).request);
  EXPECT_EQ(heard({Button::next, Button::choose, Button::leave}), "menu_closed");
  EXPECT_FALSE(menu_.open());
  EXPECT_EQ(heard({Button::end}), "menu_end_sure");
  EXPECT_EQ(heard({Button::leave}), "menu_closed");
  EXPECT_FALSE(press({Button::leave}).request);
}

TEST_F(MenuTest, begins_a_trial_and_ends_it_only_when_asked_twice) {
  trial(State::ready);
  EXPECT_EQ(press({Button::start}).request, TrialRequest::Kind::begin) << "at once";
  EXPECT_EQ(heard({Button::next}), "menu_begin");
  EXPECT_EQ(press({Button::choose}).request, TrialRequest::Kind::begin);
  trial(State::running);
  EXPECT_EQ(heard({Button::end}), "menu_end_sure");
  EXPECT_EQ(heard({Button::back}), "menu_goals");
  press({Button::back});
  EXPECT_EQ(press({Button::end, Button::end}).request, TrialRequest::Kind::end);
  EXPECT_EQ(heard({Button::next, Button::next}), "menu_end");
  const Menu::Step asked = press({Button::choose});
  EXPECT_FALSE(asked.request);
  EXPECT_EQ(asked.told->about, About::menu_end_sure);
  EXPECT_EQ(press({Button::choose}).request, TrialRequest::Kind::end);
}

TEST_F(MenuTest, survives_that_what_can_be_chosen_goes_away) {
  press({Button::next, Button::choose, Button::next, Button::next});
  scenario_.places.clear();
  menu_.take(scenario_);
  EXPECT_EQ(heard({Button::choose}), "menu_place") << "said before it is chosen";
}

TEST_F(MenuTest, goes_back_to_a_list_that_has_become_shorter) {
  menu_.take_settings({{"speaker/rate", "220"}});
  menu_.lock(true);
  trial(State::ready);
  EXPECT_EQ(heard({Button::next, Button::next}), "menu_settings");
  press({Button::choose});
  trial(State::preparing);
  EXPECT_EQ(heard({Button::back}), "menu_settings");
}

TEST_F(MenuTest, chooses_what_was_told_where_the_list_has_grown_since) {
  menu_.take_goal({3.0, 4.0});
  EXPECT_EQ(heard({Button::choose, Button::choose, Button::next, Button::next}), "menu_place 2");
  menu_.take_goal({9.0, 9.0});  // another program's: "the last goal" comes before the docks
  const Menu::Step chosen = press({Button::choose});
  ASSERT_TRUE(chosen.goal);
  EXPECT_EQ(*chosen.goal, Eigen::Vector2d(5.0, 6.0));
}

TEST_F(MenuTest, goes_on_from_what_was_told_and_chooses_nothing_where_that_is_gone) {
  trial(State::ready);
  EXPECT_EQ(heard({Button::choose}), "menu_begin");
  EXPECT_EQ(heard({Button::next}), "menu_goals");
  trial(State::running);
  EXPECT_EQ(heard({Button::next}), "menu_end") << "the list has changed since";
  press({Button::back});
  trial(State::ready);
  EXPECT_EQ(heard({Button::choose}), "menu_begin");
  trial(State::running);
  const Menu::Step step = press({Button::choose});
  EXPECT_FALSE(step.goal || step.request);
  EXPECT_EQ(step.told->about, About::menu_goals) << "the first that there is now";
  EXPECT_EQ(heard({Button::choose}), "menu_place");
}

TEST_F(MenuTest, offers_the_places_of_a_file_by_their_names) {
  Menu menu;  // as on a robot, of which no scenario is known
  menu.take(std::vector<NamedPlace>{{"packing table", {1.5, -2.0}}, {"gate 4", {-3.0, 4.0}}});
  menu.take(TrialState{State::running});
  EXPECT_EQ(menu.press(Button::next).told.value().about, About::menu_goals);
  Menu::Step step = menu.press(Button::choose);
  EXPECT_EQ(step.told.value().about, About::menu_place);
  EXPECT_EQ(step.told.value().fillings.place_name, "packing table");
  EXPECT_EQ(menu.press(Button::next).told.value().fillings.place_name, "gate 4");
  step = menu.press(Button::choose);
  EXPECT_EQ(step.told.value().about, About::goal_sure);
  EXPECT_EQ(step.told.value().fillings.place_name, "gate 4");
  step = menu.press(Button::choose);
  EXPECT_EQ(step.goal.value(), Eigen::Vector2d(-3.0, 4.0));
  EXPECT_EQ(step.told.value().about, About::goal_chosen);
  EXPECT_EQ(step.told.value().fillings.place_name, "gate 4");
}

TEST_F(MenuTest, offers_the_places_of_a_file_before_those_of_the_world) {
  menu_.take(std::vector<NamedPlace>{{"gate", {-3.0, 4.0}}});
  EXPECT_EQ(heard({Button::next, Button::choose}), "menu_place") << "the goal of the task";
  EXPECT_EQ(press({Button::next}).told.value().fillings.place_name, "gate");
  EXPECT_EQ(heard({Button::next}), "menu_place 1");
}

TEST_F(MenuTest, remembers_places_by_the_first_free_name_and_offers_them) {
  const cues::Phrases en(std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml");
  const cues::Phrases es(std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/es.yaml");
  menu_.take(std::vector<NamedPlace>{{"Place 1", {-3.0, 4.0}}, {"gate", {1.0, 1.0}}});
  EXPECT_EQ(heard({Button::previous, Button::previous}), "menu_remember");
  const Menu::Step step = press({Button::choose});
  EXPECT_TRUE(step.remember);
  EXPECT_FALSE(menu_.open());
  EXPECT_EQ(menu_.remember({2.0, 3.0}, en).value().name, "place 2");
  EXPECT_EQ(menu_.remember({2.0, 3.0}, en).value().name, "place 3");
  EXPECT_EQ(menu_.remember({4.0, 5.0}, es).value().name, "lugar 1");
  press({Button::next, Button::choose, Button::next, Button::next, Button::next});
  EXPECT_EQ(press({Button::choose}).goal.value(), Eigen::Vector2d(2.0, 3.0));
  menu_.take(std::vector<NamedPlace>(kMostPlaces));
  EXPECT_FALSE(menu_.remember({2.0, 3.0}, en));
}

TEST_F(MenuTest, has_nothing_to_choose_where_nothing_is_known) {
  Menu menu;
  menu.lock(true);
  menu.take(TrialState{State::preparing});
  EXPECT_EQ(menu.press(Button::next).told.value().about, About::menu_empty);
  EXPECT_EQ(menu.press(Button::choose).told.value().about, About::menu_empty);
  EXPECT_EQ(menu.press(Button::back).told.value().about, About::menu_closed);
}

TEST_F(MenuTest, opens_at_the_settings_from_wherever_it_is) {
  EXPECT_EQ(heard({Button::settings}), "menu_empty");
  menu_.take_settings({{"speaker/rate", "220"}});
  EXPECT_EQ(heard({Button::settings}), "setting 220");
  EXPECT_EQ(heard({Button::choose, Button::settings}), "setting 220");
  EXPECT_EQ(heard({Button::choose}), "setting_open 220");
  press({Button::back, Button::back});
  EXPECT_EQ(heard({Button::back}), "menu_closed");
}

TEST_F(MenuTest, has_the_glossary_while_no_trial_runs) {
  EXPECT_EQ(heard({Button::next, Button::next}), "menu_glossary");
  EXPECT_TRUE(press({Button::choose}).glossary);
  trial(State::running);
  EXPECT_EQ(heard({Button::next, Button::previous, Button::previous}), "menu_end");
  EXPECT_EQ(heard({Button::previous}), "menu_goals");
}

TEST_F(MenuTest, changes_a_setting_step_by_step) {
  menu_.take_settings({{"speaker/rate", "230"}, {"lead", "ticks"}});
  EXPECT_EQ(heard({Button::next, Button::next}), "menu_settings");
  EXPECT_EQ(heard({Button::choose}), "setting 230");
  EXPECT_EQ(heard({Button::choose}), "setting_open 230");
  Menu::Step step = press({Button::previous});
  EXPECT_EQ(step.change, "speaker/rate:=240");
  EXPECT_EQ(step.told.value().about, About::setting_changed);
  EXPECT_EQ(step.told.value().fillings.number, 240);
  EXPECT_EQ(press({Button::next, Button::next}).change, "speaker/rate:=200");
  EXPECT_EQ(heard({Button::back}), "setting 200");
  press({Button::next, Button::choose});
  step = press({Button::next});
  EXPECT_EQ(step.change, "lead:=words");
  EXPECT_EQ(step.told.value().fillings.value, cues::SettingValue::words);
  EXPECT_EQ(press({Button::next}).change, "lead:=words") << "the last of its values";
  EXPECT_EQ(press({Button::choose}).told.value().about, About::setting) << "done";
}

}  // namespace
}  // namespace navvi_feedback::menu
