#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>

#include "guide_fixture.hpp"
#include "temp_folder.hpp"

namespace navvi_feedback::core {
namespace {

const Content kChosen(CueKind::menu_closed, About::goal_chosen);
const Content kClosed(CueKind::menu_closed, About::menu_closed);
constexpr std::size_t kUp = 11, kDown = 12, kLeft = 13, kRight = 14;  // of the pad

/// With a file of places.
class RememberTest : public GuideTest {
 protected:
  void use_file(bool locked = false) {
    config_->places = folder_.write("places.yaml", "- {name: gate, x: 1, y: 2}\n");
    config_->locked = locked;
    restart();
  }
  void restart() {
    kept_ = std::make_unique<Guide>(config_, cues::Phrases(kEnglish));
    stand();
  }
  /// At (3, -1), as far as all is known.
  void stand() {
    input_.robot = navvi_types::Pose2{{3.0, -1.0}, 0.0};
    kept_->take(Guidance{}, time_);
    kept_->take(Odometry{}, time_);
  }
  Beat next() { return beat(*kept_, input_, time_ += 0.02); }
  /// What is told of it.
  std::string remember() {
    place_.reset();
    std::string told;
    for (const drive::Button button :
         {drive::Button::next, drive::Button::previous, drive::Button::choose}) {
      input_.asked = {button};
      const Beat output = next();
      input_.asked.clear();
      if (output.place) place_ = output.place;
      told = output.cues.empty() ? "" : output.cues.at(0).text;
    }
    return told;
  }

  GuideConfig config_;
  navvi_test::TempFolder folder_;
  std::unique_ptr<Guide> kept_;
  std::optional<menu::NamedPlace> place_;
};

TEST_F(RememberTest, saves_the_robots_place_by_name_by_presses_alone) {
  use_file();
  EXPECT_EQ(remember(), "saved as place 1");
  ASSERT_TRUE(place_);
  EXPECT_EQ(place_->name, "place 1");
  EXPECT_EQ(place_->at, Eigen::Vector2d(3.0, -1.0));
  EXPECT_EQ(remember(), "saved as place 2");
}

TEST_F(RememberTest, saves_nothing_without_a_file_or_a_known_place) {
  restart();
  EXPECT_EQ(remember(), "not saved, the session has no file of places");
  EXPECT_FALSE(place_);
  use_file();
  input_.robot.reset();
  EXPECT_EQ(remember(), "not saved, the position is not known");
  stand();
  Guidance lost;
  lost.state = Guidance::State::pose_stale;
  kept_->take(lost, time_);
  EXPECT_EQ(remember(), "not saved, the position is not known");
  EXPECT_FALSE(place_);
  stand();
  for (int i = 0; i < 250; ++i) next();
  EXPECT_EQ(remember(), "not saved, the position is not known") << "the last one is old";
}

TEST_F(RememberTest, saves_what_is_clicked_but_never_in_a_study) {
  use_file();
  kept_->take_place({7.0, 8.0});
  const Beat output = next();
  EXPECT_EQ(output.cues.at(0).text, "saved as place 1");
  EXPECT_EQ(output.place.value().at, Eigen::Vector2d(7.0, 8.0));
  EXPECT_FALSE(next().place);
  use_file(true);
  kept_->take_place({7.0, 8.0});
  EXPECT_FALSE(next().place);
  EXPECT_NE(remember().substr(0, 5), "saved");
  EXPECT_FALSE(place_);
}

class GoalTest : public GuideTest {
 protected:
  GoalTest() {
    Scenario scenario;
    scenario.goal = {1.0, 2.0};
    scenario.places = {{navvi_types::Place::Kind::dock, 1, {3.0, 4.0}}};
    guide_.take(scenario, time_);
    pass(0.1);
  }
  /// The planner's answer to a goal.
  void lead_to(const Eigen::Vector2d& goal, Guidance::State state) {
    Guidance guidance;
    guidance.state = state;
    guidance.refusal = Guidance::Refusal::not_seen;
    guidance.goal = goal;
    guidance.plans = ++plans_;
    guide_.take(guidance, time_);
    guide_.take(Odometry{}, time_);
  }

  std::uint32_t plans_ = 0;
};

TEST_F(GoalTest, is_chosen_by_short_presses_and_the_voice) {
  EXPECT_EQ(press(kDown).cues.at(0).text, "goals");
  EXPECT_EQ(press(kRight).cues.at(0).text, "the goal of the task");
  EXPECT_EQ(press(kDown).cues.at(0).text, "dock 1");
  EXPECT_EQ(press(kRight).goal.value().x(), 3.0);
  EXPECT_FALSE(said(kChosen)) << "the planner has not answered";
  lead_to({3.0, 4.0}, Guidance::State::following);
  EXPECT_EQ(pass(0.02).cues.at(0).text, "you are heading for dock 1");
  guide_.take_goal({9.0, 9.0});
  guide_.take_goal({3.0, 4.0});
  guide_.take_goal({3.0, 4.0});
  press(kDown);
  press(kRight);
  EXPECT_EQ(press(kDown).cues.at(0).text, "the previous goal");
  EXPECT_EQ(press(kRight).goal.value().x(), 9.0);
}

TEST_F(GoalTest, that_the_planner_refuses_was_never_headed_for) {
  const auto choose = [&] {
    for (int press = 0; press < 3; ++press) {
      ask({drive::Button::choose});
      pass(0.1);
    }
  };
  choose();
  lead_to({1.0, 2.0}, Guidance::State::goal_refused);
  pass(0.1);
  EXPECT_TRUE(said({CueKind::goal_refused, About::not_seen}));
  pass(6.0);
  EXPECT_FALSE(said(kChosen));
  EXPECT_FALSE(said(kClosed)) << "the refusal was the answer";
  choose();
  pass(0.2);
  EXPECT_FALSE(said(kChosen)) << "that refusal was of the first time";
  lead_to({1.0, 2.0}, Guidance::State::following);
  pass(0.1);
  EXPECT_TRUE(said(kChosen));
}

TEST_F(GoalTest, that_no_planner_answers_closes_the_menu) {
  ask(std::vector(3, drive::Button::choose));
  pass(6.0);
  EXPECT_FALSE(said(kChosen));
  EXPECT_TRUE(said(kClosed));
}

TEST_F(GuideTest, a_menu_that_nobody_uses_is_closed_after_20_s_and_that_is_said) {
  guide_.offer({{"haptics/strength", "0.7"}});
  pass(0.1);
  ask({drive::Button::next});
  pass(19.5);
  EXPECT_TRUE(said({CueKind::menu, About::menu_settings}));
  EXPECT_FALSE(said(kClosed));
  pass(1.0);
  EXPECT_EQ(count(kClosed), 1);
}

TEST_F(GuideTest, a_setting_is_changed_by_short_presses_and_heard_or_felt_at_once) {
  GuideConfig config;
  guide_.offer({{"haptics/strength", "0.7"}, {"sounds/hit/on", "false"}});
  EXPECT_EQ(press(kDown).cues.at(0).text, "settings");
  EXPECT_EQ(press(kRight).cues.at(0).text, "strength of vibration, 70 percent");
  press(kRight);
  const Beat weaker = press(kDown);
  EXPECT_EQ(weaker.cues.at(0).text, "strength of vibration 60 percent");
  EXPECT_EQ(weaker.change, "haptics/strength:=0.6");
  EXPECT_EQ(weaker.pattern, haptics::Pattern::sample);
  config->haptics.strength = 0.6;
  guide_.use(config);
  EXPECT_NEAR(pass(0.1).rumble.left, 0.6, 1e-9);
  EXPECT_EQ(pass(0.02).change, "") << "once";

  press(kLeft);
  press(kDown);
  press(kRight);
  plays_.clear();
  EXPECT_EQ(press(kUp).change, "sounds/hit/on:=true");
  EXPECT_EQ(played(sounds::Earcon::hit_shelf), 1);
}

TEST_F(GuideTest, the_button_that_is_held_to_drive_is_switched_and_stays_the_same) {
  for (const auto& [enable, on] : std::map<int, std::string>{{-1, "9"}, {9, "9"}, {10, "10"}}) {
    GuideConfig config;
    config->drive.enable = enable;
    Guide guide(config, cues::Phrases(kEnglish));
    guide.offer({{"drive/enable", std::to_string(enable)}});
    std::string change;
    const auto press = [&](drive::Button button) {
      input_.asked = {button};
      change = beat(guide, input_, time_ += 0.02).change;
    };
    for (int i = 0; i < 3; ++i) press(drive::Button::choose);
    press(drive::Button::previous);
    EXPECT_EQ(change, "drive/enable:=" + on);
    press(drive::Button::next);
    EXPECT_EQ(change, "drive/enable:=-1");
    press(drive::Button::previous);
    EXPECT_EQ(change, "drive/enable:=" + on);
  }
}

TEST(Help, tells_the_buttons_as_they_are_assigned) {
  using Texts = std::vector<std::string>;
  const auto told = [](const GuideConfig& config, bool keyboard) {
    Guide guide(config, cues::Phrases(kEnglish));
    Devices input;
    input.hands.live = true;
    input.keyboard = keyboard;
    input.asked = {drive::Button::help};
    Texts texts;
    for (double time = 10.0; time < 12.0; time += 0.02) {
      for (const cues::Cue& cue : beat(guide, input, time).cues)
        if (cue.kind == CueKind::lesson) texts.push_back(cue.text);
      input.asked.clear();
    }
    return texts;
  };
  GuideConfig config;
  EXPECT_EQ(told(config, false),
            (Texts{"the lower button repeats", "the right button tells the goal",
                   "the left button tells what is near", "the top button tells your place",
                   "the right shoulder button tells the next turn", "arrow down opens the menu"}));
  EXPECT_EQ(told(config, true).at(1), "the letter G tells the goal");
  auto& index = config->buttons.index;
  std::swap(index.at(1), index.at(2));  // goal and around
  index.at(4) = -1;                     // turn
  index.at(8) = 7;                      // next
  const Texts moved = told(config, false);
  ASSERT_EQ(moved.size(), 5U);
  EXPECT_EQ(moved[1], "the left button tells the goal");
  EXPECT_EQ(moved[2], "the right button tells what is near");
  EXPECT_EQ(moved[4], "the left stick button opens the menu");
}

TEST_F(GuideTest, help_answers_a_button_by_its_first_sentence_alone) {
  std::vector<bool> answers;
  input_.asked = {drive::Button::help};
  for (int i = 0; i < 100; ++i) {
    const Beat output = beat(guide_, input_, time_ += 0.02);
    if (output.voice.start) answers.push_back(output.answers);
    input_.asked.clear();
  }
  ASSERT_GT(answers.size(), 5U);
  EXPECT_TRUE(answers.front());
  EXPECT_EQ(std::count(answers.begin(), answers.end(), true), 1);
}

TEST_F(GuideTest, help_ends_where_another_button_is_pressed) {
  ask({drive::Button::help});
  ask({drive::Button::around});
  pass(1.0);
  EXPECT_EQ(count(CueKind::lesson), 1);
}

TEST_F(GuideTest, no_way_of_leading_is_offered_with_which_it_would_not_start_anew) {
  using Ways = std::set<std::string>;
  for (const bool haptics : {true, false})
    for (const bool sounds : {true, false}) {
      GuideConfig config;
      config->haptics.enabled = haptics;
      config->sounds.enabled = sounds;
      Guide guide(config, cues::Phrases(kEnglish));
      guide.offer({{"lead", "words"}});
      Ways ways;
      const auto press = [&](drive::Button button) {
        input_.asked = {button};
        const Beat output = beat(guide, input_, time_ += 0.02);
        if (!output.change.empty()) ways.insert(output.change.substr(output.change.find('=') + 1));
      };
      for (int i = 0; i < 3; ++i) press(drive::Button::choose);
      for (int i = 0; i < 5; ++i) press(drive::Button::previous);
      for (int i = 0; i < 5; ++i) press(drive::Button::next);
      EXPECT_EQ(ways.count("flow") + ways.count("hand"), (haptics ? 1U : 0U) + (sounds ? 1U : 0U));
      EXPECT_EQ(ways.count("words") + ways.count("ticks"), 2U);
      for (const std::string& way : ways) {
        config->lead = way;
        EXPECT_NO_THROW(Guide(config, cues::Phrases(kEnglish))) << way;
      }
    }
  input_.asked.clear();
}

TEST_F(GuideTest, no_keys_are_offered_to_lead_by_the_hand_whatever_a_file_holds) {
  input_.keyboard = true;
  for (const char* first : {"words", "hand"}) {
    GuideConfig config;
    config->lead = first;
    Guide guide(config, cues::Phrases(kEnglish));
    guide.offer({{"lead", first}});
    std::vector<std::string> ways;
    const auto press = [&](drive::Button button) {
      input_.asked = {button};
      const std::string change = beat(guide, input_, time_ += 0.02).change;
      if (change.empty()) return;
      ways.push_back(config->lead = change.substr(change.find('=') + 1));
      guide.use(config);
    };
    for (int i = 0; i < 3; ++i) press(drive::Button::choose);
    for (int i = 0; i < 5; ++i) press(drive::Button::next);
    for (int i = 0; i < 5; ++i) press(drive::Button::previous);
    ASSERT_EQ(ways.size(), 10U);
    EXPECT_EQ(std::count(ways.begin(), ways.end(), "hand"), 0) << "after " << first;
    EXPECT_EQ(ways.back(), "flow");
  }
}

}  // namespace
}  // namespace navvi_feedback::core
