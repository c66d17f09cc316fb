#include "beat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <navvi_config/reader.hpp>
#include <set>
#include <utility>

#include "lessons/tutorial.hpp"

namespace navvi_feedback::core {
namespace {

const std::string kEnglish = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml";
const Content kChosen(CueKind::menu_closed, About::goal_chosen);
const Content kClosed(CueKind::menu_closed, About::menu_closed);

class GuideTest : public testing::Test {
 protected:
  GuideTest() {
    input_.hands.live = true;
    hold(0.0, 0.0);
  }

  void hold(double left, double forward) {
    input_.hands.axes = {left, forward};
    input_.hands.buttons = {false, false};
  }

  /// \return the last output
  Beat pass(double seconds) {
    Beat output;
    for (const double end = time_ + seconds; time_ < end - 1e-9; time_ += 0.02) {
      output = beat(guide_, input_, time_);
      for (const cues::Cue& cue : output.cues) told_.emplace_back(cue);
      plays_.insert(plays_.end(), output.plays.begin(), output.plays.end());
    }
    return output;
  }

  /// The most that both motors did together within `seconds`.
  double strongest(double seconds) {
    double most = 0.0;
    for (const double end = time_ + seconds; time_ < end - 1e-9;) {
      const Beat output = pass(0.02);
      most = std::max(most, std::min(output.rumble.left, output.rumble.right));
      alarms_ += output.alarm_begins ? 1 : 0;
    }
    return most;
  }

  [[nodiscard]] auto played(sounds::Earcon earcon) const {
    return std::count_if(plays_.begin(), plays_.end(),
                         [&](const sounds::Play& play) { return play.earcon == earcon; });
  }

  /// A path that leads to the right; a shelf that is near. \param y  m, to its left
  void lead(double y) {
    Guidance guidance;
    guidance.state = Guidance::State::following;
    guidance.goal = {20.0, 5.0};
    guidance.steer_angle = guidance.waypoint_angle = 1.5;
    guidance.waypoint_distance = 8.0;
    guidance.goal_distance = 25.0;
    guide_.take(guidance, time_);
    guide_.take(Odometry{}, time_);
    guide_.take(Proximity{0, {{ThingClass::shelf, 1, 0.5, {0.0, y}}}}, time_);
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

  [[nodiscard]] bool said(const Content& content) const {
    return std::find(told_.begin(), told_.end(), content) != told_.end();
  }

  std::uint32_t plans_ = 0;
  Guide guide_{GuideConfig{}, kEnglish};
  Devices input_;
  double time_ = 10.0;
  std::vector<Content> told_;
  std::vector<sounds::Play> plays_;
  int alarms_ = 0;
};

TEST_F(GuideTest, says_once_that_another_node_wants_to_drive) {
  pass(1.0);
  DriveState drive;
  drive.state = DriveState::State::running;
  drive.intruder = "/teleop";
  guide_.take(drive, time_);
  pass(5.0);
  EXPECT_EQ(std::count(told_.begin(), told_.end(), Content(CueKind::notice, About::intruder)), 1);
}

TEST_F(GuideTest, J1_a_stick_drives_once_it_was_neutral_and_its_loss_is_one_last_zero) {
  pass(0.5);
  hold(0.0, 1.0);
  EXPECT_GT(pass(1.0).command.value().linear, 0.5);
  input_.hands = {};
  const Beat lost = pass(0.02);
  ASSERT_TRUE(lost.command);
  EXPECT_EQ(lost.command->linear, 0.0);
  EXPECT_FALSE(pass(0.02).command);
  EXPECT_TRUE(said({CueKind::stick_lost, About::pad}));
}

TEST_F(GuideTest, a_stick_that_was_opened_anew_must_be_neutral_again) {
  pass(0.5);
  hold(0.0, 1.0);
  pass(1.0);
  ++input_.hands.session;
  EXPECT_EQ(pass(1.0).command.value().linear, 0.0);
}

TEST_F(GuideTest, S7_a_pause_of_ten_minutes_ends_without_a_burst_of_speech) {
  const auto live = [&](double seconds) {
    for (const double end = time_ + seconds; time_ < end - 1e-9; pass(0.06)) lead(0.5);
  };
  live(10.0);
  const std::size_t at_first = told_.size();
  told_.clear();
  pass(600.0);
  EXPECT_TRUE(said({CueKind::robot_lost, About::odometry}));
  EXPECT_LE(told_.size(), 4U) << "each loss is said once";
  told_.clear();
  live(10.0);
  EXPECT_TRUE(said(CueKind::direction));
  EXPECT_LE(told_.size(), at_first + 1) << "as at the begin";
}

class Driven : public GuideTest {
 protected:
  /// m/s, with the stick `axes` and the buttons held for 2 s after it was neutral.
  double speed(const std::string& parameters, const std::vector<double>& axes,
               const std::vector<bool>& buttons = {}) {
    GuideConfig config;
    navvi_config::read(config, YAML::Load(parameters), "test");
    Guide guide(config, kEnglish);
    Beat output;
    for (int tick = 0; tick < 125; ++tick, time_ += 0.02) {
      input_.hands.axes = tick < 25 ? std::vector<double>(axes.size()) : axes;
      input_.hands.buttons = buttons;
      output = beat(guide, input_, time_);
    }
    return output.command.value().linear;
  }
};

TEST_F(Driven, by_the_hand_that_is_wanted) {
  EXPECT_GT(speed("{drive: {stick: right}}", {0.0, 0.0, 0.0, 1.0}), 0.5);
  EXPECT_EQ(speed("{drive: {stick: right}}", {0.0, 1.0, 0.0, 0.0}), 0.0);
  EXPECT_GT(speed("{drive: {stick: right}}", {0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0}), 0.5);
  EXPECT_EQ(speed("{drive: {stick: right}}", {0.0, 1.0}), 0.0) << "there is no right one";
}

TEST_F(Driven, only_while_the_button_for_it_is_held) {
  EXPECT_EQ(speed("{drive: {enable: 1}}", {0.0, 1.0}), 0.0);
  EXPECT_GT(speed("{drive: {enable: 1}}", {0.0, 1.0}, {false, true}), 0.5);
}

TEST_F(Driven, without_that_button_by_keys) {
  input_.keyboard = true;
  EXPECT_GT(speed("{drive: {enable: 9}}", {0.0, 1.0}), 0.5);
}

TEST_F(GuideTest, nothing_moves_before_the_person_has_begun_the_trial) {
  const auto hold_start = [&](bool down) { input_.hands.buttons = std::vector<bool>(7, down); };
  guide_.take(Odometry{}, time_);
  guide_.take(TrialState{TrialState::State::ready}, time_);
  pass(0.6);
  EXPECT_TRUE(said({CueKind::press, About::start}));
  told_.clear();
  hold(0.0, 1.0);
  bool felt = false;
  for (int tick = 0; tick < 200; ++tick) {
    guide_.take(Odometry{}, time_);
    const Beat out = pass(0.02);
    EXPECT_EQ(out.command.value().linear, 0.0);
    felt = felt || out.pattern == haptics::Pattern::ready;
  }
  EXPECT_TRUE(felt) << "the reason, to a stick that is pushed; its words were said just now";
  EXPECT_FALSE(said(CueKind::release_stick));

  hold(0.0, 0.0);
  hold_start(true);
  EXPECT_EQ(pass(0.02).request, TrialRequest::Kind::begin);
  EXPECT_FALSE(pass(0.02).request) << "held";
  hold_start(false);
  guide_.take(TrialState{TrialState::State::running}, time_);
  EXPECT_EQ(pass(0.02).pattern, haptics::Pattern::begun);
  EXPECT_TRUE(said(CueKind::trial_begins));
  pass(0.5);
  hold_start(true);
  EXPECT_FALSE(pass(0.02).request) << "it has begun";
  hold(0.0, 1.0);
  EXPECT_GT(pass(1.0).command.value().linear, 0.5);
}

TEST_F(GuideTest, L5_a_trial_node_that_is_halted_is_told_while_its_trial_runs) {
  const TrialState running{TrialState::State::running};
  const auto beat = [&](double seconds) {
    for (const double end = time_ + seconds; time_ < end;) {
      guide_.take(running, time_);
      pass(0.25);
    }
  };
  guide_.take(running, time_);
  pass(5.0);
  EXPECT_FALSE(said(CueKind::record_lost)) << "one that tells its state once is not missed";
  beat(5.0);
  EXPECT_FALSE(said(CueKind::record_lost));
  pass(2.2);
  EXPECT_TRUE(said(CueKind::record_lost));
  told_.clear();
  beat(6.0);
  EXPECT_FALSE(said(CueKind::record_lost));
  guide_.take(TrialState{TrialState::State::preparing}, time_);
  guide_.take(TrialState{TrialState::State::preparing}, time_);
  pass(5.0);
  EXPECT_FALSE(said(CueKind::record_lost)) << "nothing is recorded between trials";
}

TEST_F(GuideTest, the_smallest_place_that_one_is_in_is_told_within_one_tick) {
  using navvi_types::Place;
  Scenario scenario;
  scenario.places = {
      {Place::Kind::room, 1, {}, {Eigen::Vector2d(-9.0, -9.0), Eigen::Vector2d(9.0, 9.0)}},
      {Place::Kind::aisle, 2, {}, {Eigen::Vector2d(-1.0, -9.0), Eigen::Vector2d(1.0, 9.0)}}};
  guide_.take(scenario, time_);
  const auto ask = [&] {
    input_.hands.buttons.assign(15, false);
    pass(0.6);
    input_.hands.buttons[3] = true;
    return pass(0.02).cues.at(0).text;
  };
  input_.robot = navvi_types::Pose2{{0.5, 3.0}, 0.0};
  EXPECT_EQ(ask(), "aisle 2");
  input_.robot = navvi_types::Pose2{{5.0, 3.0}, 0.0};
  EXPECT_EQ(ask(), "room 1");
}

/// With a file of places.
class RememberTest : public GuideTest {
 protected:
  void use_file(bool locked = false) {
    std::string name = testing::TempDir() + "/places_XXXXXX";
    folder_ = ::mkdtemp(name.data());
    std::ofstream(folder_ + "/places.yaml") << "- {name: gate, x: 1, y: 2}\n";
    config_->places = folder_ + "/places.yaml";
    config_->locked = locked;
    restart();
  }
  void restart() {
    kept_ = std::make_unique<Guide>(config_, kEnglish);
    stand();
  }
  ~RememberTest() override { std::filesystem::remove_all(folder_); }
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
  std::string folder_;
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

TEST_F(GuideTest, a_goal_is_chosen_by_short_presses_and_the_voice) {
  Scenario scenario;
  scenario.goal = {1.0, 2.0};
  scenario.places = {{navvi_types::Place::Kind::dock, 1, {3.0, 4.0}}};
  guide_.take(scenario, time_);
  const auto press = [&](std::size_t button) {
    input_.hands.buttons.assign(15, false);
    input_.hands.buttons[button] = true;
    const Beat output = pass(0.02);
    input_.hands.buttons.assign(15, false);
    pass(0.1);
    return output;
  };
  constexpr std::size_t kDown = 12, kRight = 14;
  pass(0.1);
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

TEST_F(GuideTest, a_goal_that_the_planner_refuses_was_never_headed_for) {
  Scenario scenario;
  scenario.goal = {1.0, 2.0};
  guide_.take(scenario, time_);
  const auto choose = [&] {
    for (int press = 0; press < 3; ++press) {
      input_.asked = {drive::Button::choose};
      pass(0.02);
      input_.asked.clear();
      pass(0.1);
    }
  };
  pass(0.1);
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

/// A session with headphones, before a trial.
class SidesTest : public GuideTest {
 protected:
  SidesTest() {
    input_.ears = "usb_headphones";
    input_.person = "ada";
    state_.state = TrialState::State::ready;
  }
  /// Hears what is said to its end, and sounds. \return the last change of a setting
  std::string wait(double seconds) {
    std::string change;
    for (const double end = time_ + seconds; time_ < end - 1e-9;) {
      guide_.take(state_, time_);
      guide_.take(Odometry{}, time_);
      const Beat output = pass(0.02);
      if (!output.change.empty()) change = output.change;
      for (const sounds::Play& play : output.plays) side_ = play.from.y();
    }
    return change;
  }

  TrialState state_;
  double side_ = 0.0;
};

TEST_F(SidesTest, F7_are_asked_for_first_and_kept_with_the_sound_device) {
  EXPECT_EQ(wait(2.0), "");
  EXPECT_TRUE(said(CueKind::which_side));
  EXPECT_EQ(guide_.order().value().kind(), CueKind::which_side);
  ASSERT_NE(side_, 0.0);
  EXPECT_FALSE(said({CueKind::press, About::start}));
  hold(side_, 0.0);
  EXPECT_EQ(wait(1.0), "sounds/sides:=usb_headphones");
  EXPECT_TRUE(said({CueKind::press, About::start}));
  EXPECT_FALSE(said(CueKind::sides_wrong));
  EXPECT_FALSE(guide_.learnt().value().words_lead);
}

TEST_F(SidesTest, F7_that_are_wrong_are_told_and_words_lead) {
  wait(2.0);
  hold(-side_, 0.0);
  EXPECT_EQ(wait(1.0), "");
  EXPECT_TRUE(said(CueKind::sides_wrong));
  EXPECT_TRUE(said({CueKind::press, About::start}));
  EXPECT_TRUE(guide_.learnt().value().words_lead);
}

TEST_F(SidesTest, that_are_wrong_are_led_by_no_sound_that_lasts_either) {
  GuideConfig config;
  navvi_config::read(config, YAML::Load("{lead: flow}"), "test");
  for (const bool right : {true, false}) {
    Guide guide(config, kEnglish);
    double side = 0.0, flow = 0.0;
    for (int i = 0; i < 500; ++i) {
      const double time = 10.0 + 0.02 * i;
      state_.state = i < 250 ? TrialState::State::ready : TrialState::State::running;
      input_.hands.axes = {i > 150 && i < 200 ? (right ? side : -side) : 0.0, 0.0};
      Guidance guidance;
      guidance.state = Guidance::State::following;
      guidance.goal = {20.0, 0.0};
      guidance.waypoint_distance = guidance.goal_distance = 20.0;
      guide.take(state_, time);
      guide.take(Odometry{}, time);
      guide.take(Proximity{}, time);
      guide.take(guidance, time);
      const auto output = guide.update(input_, time);
      for (const sounds::Play& play : output->plays)
        if (i <= 150) side = play.from.y();
      input_.speaking = false;
      flow = output->flow.left + output->flow.right;
    }
    EXPECT_EQ(flow > 0.0, right);
  }
}

TEST_F(SidesTest, are_not_asked_for_where_they_are_known_or_nothing_sounds) {
  GuideConfig known;
  known->sounds.sides = "usb_headphones";
  guide_.use(known);
  wait(3.0);
  EXPECT_FALSE(said(CueKind::which_side));
  guide_.use({});
  input_.sounds = false;
  wait(3.0);
  EXPECT_FALSE(said(CueKind::which_side));
  input_.sounds = true;
  input_.ears.clear();
  wait(3.0);
  EXPECT_FALSE(said(CueKind::which_side)) << "a simulated person";
}

TEST_F(GuideTest, a_goal_that_no_planner_answers_closes_the_menu) {
  Scenario scenario;
  guide_.take(scenario, time_);
  input_.asked.assign(3, drive::Button::choose);
  pass(0.02);
  input_.asked.clear();
  pass(6.0);
  EXPECT_FALSE(said(kChosen));
  EXPECT_TRUE(said(kClosed));
}

TEST_F(GuideTest, a_menu_that_nobody_uses_is_closed_after_20_s_and_that_is_said) {
  guide_.offer({{"haptics/strength", "0.7"}});
  pass(0.1);
  input_.asked = {drive::Button::next};
  pass(0.02);
  input_.asked.clear();
  pass(19.5);
  EXPECT_TRUE(said({CueKind::menu, About::menu_settings}));
  EXPECT_FALSE(said(kClosed));
  pass(1.0);
  EXPECT_EQ(std::count(told_.begin(), told_.end(), kClosed), 1);
}

TEST_F(GuideTest, a_setting_is_changed_by_short_presses_and_heard_or_felt_at_once) {
  GuideConfig config;
  guide_.offer({{"haptics/strength", "0.7"}, {"sounds/hit/on", "false"}});
  const auto press = [&](std::size_t button) {
    input_.hands.buttons.assign(15, false);
    input_.hands.buttons[button] = true;
    const Beat output = pass(0.02);
    input_.hands.buttons.assign(15, false);
    return output;
  };
  constexpr std::size_t kUp = 11, kDown = 12, kLeft = 13, kRight = 14;
  pass(0.1);
  EXPECT_EQ(press(kDown).cues.at(0).text, "settings");
  pass(0.1);
  EXPECT_EQ(press(kRight).cues.at(0).text, "strength of vibration, 70 percent");
  pass(0.1);
  press(kRight);
  pass(0.1);
  const Beat weaker = press(kDown);
  EXPECT_EQ(weaker.cues.at(0).text, "strength of vibration 60 percent");
  EXPECT_EQ(weaker.change, "haptics/strength:=0.6");
  EXPECT_EQ(weaker.pattern, haptics::Pattern::sample);
  config->haptics.strength = 0.6;
  guide_.use(config);
  EXPECT_NEAR(pass(0.1).rumble.left, 0.6, 1e-9);
  EXPECT_EQ(pass(0.02).change, "") << "once";

  press(kLeft);
  pass(0.1);
  press(kDown);
  pass(0.1);
  press(kRight);
  plays_.clear();
  pass(0.1);
  EXPECT_EQ(press(kUp).change, "sounds/hit/on:=true");
  EXPECT_EQ(played(sounds::Earcon::hit_shelf), 1);
}

TEST_F(GuideTest, what_is_near_is_felt_while_it_is_fresh) {
  guide_.take(Odometry{}, time_);
  guide_.take(Proximity{0, {{ThingClass::worker, 1, 0.5, {0.9, 0.0}, true}}}, time_);
  EXPECT_GT(pass(0.7).rumble.left, 0.5);
  const haptics::Rumble stale = pass(0.3).rumble;
  EXPECT_EQ(stale.left, 0.0);
  EXPECT_EQ(stale.right, 0.0);
}

TEST_F(GuideTest, F1_the_motors_report_a_missing_audio_device_once_there_are_some) {
  for (const Link missing : {Link::never, Link::lost}) {
    input_.audio = missing;
    input_.motors = false;
    EXPECT_EQ(strongest(1.0), 0.0) << "no pad yet";
    input_.motors = true;
    EXPECT_EQ(alarms_, 0);
    EXPECT_GT(strongest(2.0), 0.1);
    EXPECT_EQ(alarms_, 1);
    EXPECT_EQ(strongest(1.0), 0.0) << "told once";
    input_.audio = Link::alive;
    EXPECT_EQ(strongest(0.5), 0.0);
    EXPECT_EQ(std::exchange(alarms_, 0), 1);
  }
}

TEST_F(GuideTest,
       an_alarm_ends_at_once_when_the_device_is_there_and_comes_again_when_it_is_lost) {
  input_.audio = Link::never;
  EXPECT_GT(strongest(0.3), 0.0);
  input_.audio = Link::alive;
  EXPECT_EQ(strongest(0.02), 0.0);
  input_.audio = Link::lost;
  EXPECT_GT(strongest(5.0), 0.1);
  EXPECT_EQ(alarms_, 2);
}

TEST_F(GuideTest, a_contact_is_said_once) {
  guide_.take(Odometry{}, time_);
  guide_.take(Contact{ThingClass::shelf, {0.3, 0.2}, 7}, time_);
  pass(3.0);
  EXPECT_EQ(std::count(told_.begin(), told_.end(), CueKind::collision), 1);
}

TEST_F(GuideTest, a_hit_is_felt_at_once_on_its_side_whatever_else_is_felt) {
  guide_.take(Odometry{}, time_);
  guide_.take(Proximity{0, {{ThingClass::worker, 1, 0.1, {0.5, 0.0}, true}}}, time_);
  pass(0.5);
  guide_.take(Contact{ThingClass::shelf, {0.0, 0.4}, 7}, time_);
  const Beat output = pass(0.02);
  EXPECT_EQ(output.pattern, haptics::Pattern::hit_shelf);
  EXPECT_EQ(output.rumble.left, 1.0);
  EXPECT_EQ(output.rumble.right, 0.0);
}

TEST_F(GuideTest, a_hit_sounds_once_from_its_side) {
  guide_.take(Odometry{}, time_);
  guide_.take(Contact{ThingClass::shelf, {0.0, 0.4}, 7}, time_);
  pass(1.0);
  ASSERT_EQ(plays_.size(), 1U);
  EXPECT_EQ(plays_[0].earcon, sounds::Earcon::hit_shelf);
  EXPECT_GT(plays_[0].from.y(), 0.0);
  EXPECT_TRUE(said({CueKind::collision, About::shelf}));
}

TEST_F(GuideTest, sounds_do_the_work_of_words_while_they_are_heard) {
  using sounds::Earcon;
  for (int i = 0; i < 10; ++i) {
    lead(0.9);
    pass(0.5);
  }
  EXPECT_GT(played(Earcon::turn), 5);
  EXPECT_EQ(played(Earcon::shelf_near), 1);
  EXPECT_FALSE(said({CueKind::near, About::shelf}));
  input_.sounds = false;
  plays_.clear();
  for (int i = 0; i < 10; ++i) {
    lead(-0.9);
    pass(0.5);
  }
  EXPECT_TRUE(plays_.empty());
  EXPECT_TRUE(said({CueKind::near, About::shelf}));
}

TEST_F(GuideTest, words_win_over_sounds_but_not_over_a_hit_and_a_turn_is_still_counted) {
  input_.speaking = true;
  input_.asked = {drive::Button::repeat};
  pass(0.02);
  input_.asked.clear();
  guide_.take(Contact{ThingClass::shelf, {0.0, 0.4}, 7}, time_);
  for (int i = 0; i < 4; ++i) {
    lead(0.9);
    pass(0.5);
  }
  EXPECT_EQ(played(sounds::Earcon::turn), 0);
  ASSERT_GT(played(sounds::Earcon::turn_click), 1);
  const sounds::SoundsConfig config;
  for (const sounds::Play& play : plays_) {
    const bool hit = play.earcon == sounds::Earcon::hit_shelf;
    const double full = config.family_of(play.earcon).volume;
    EXPECT_NEAR(play.volume, hit ? full : config.kUnderWords * full, 1e-9);
  }
}

TEST_F(GuideTest, no_turn_is_counted_down_to_who_must_stop_or_does_not_drive) {
  for (int i = 0; i < 20; ++i) {
    lead(0.9);
    pass(0.5);
  }
  EXPECT_GT(std::exchange(plays_, {}).size(), 5U);
  pass(0.5);
  EXPECT_TRUE(plays_.empty()) << "has not moved the stick for long";
}

TEST_F(GuideTest, patterns_are_left_out_where_touch_is_not_wanted) {
  for (const char* text : {"haptics: {enabled: false}", "haptics: {patterns: false}"}) {
    GuideConfig config;
    navvi_config::read(config, YAML::Load(text), "test");
    Guide guide(config, kEnglish);
    guide.take(Contact{ThingClass::shelf, {0.0, 0.4}, 7}, time_);
    EXPECT_FALSE(beat(guide, input_, time_).pattern) << text;
  }
}

TEST_F(GuideTest, what_is_near_is_felt_less_under_a_safety_phrase_and_not_after_the_arrival) {
  const auto felt = [&] {
    guide_.take(Odometry{}, time_);
    guide_.take(Proximity{0, {{ThingClass::worker, 1, 0.5, {0.9, 0.0}, true}}}, time_);
    return pass(0.7).rumble.left;
  };
  const double full = felt();
  EXPECT_GT(full, 0.5);
  guide_.take(Contact{ThingClass::shelf, {0.0, 0.4}, 7}, time_);
  input_.speaking = true;
  EXPECT_NEAR(felt(), 0.3 * full, 1e-9);
  input_.speaking = false;
  EXPECT_NEAR(felt(), full, 1e-9);
  Guidance guidance;
  guidance.state = Guidance::State::arrived;
  guide_.take(guidance, time_);
  EXPECT_EQ(pass(0.02).pattern, haptics::Pattern::arrived);
  pass(1.5);
  EXPECT_EQ(felt(), 0.0);
}

TEST_F(GuideTest, a_stick_that_a_busy_computer_delays_is_to_be_released_and_not_lost) {
  pass(0.5);
  hold(0.0, 1.0);
  EXPECT_GT(pass(1.0).command->linear, 0.5);
  input_.hands.live = false;
  input_.hands.late = true;
  pass(0.02);
  EXPECT_FALSE(pass(0.5).command) << "after one last zero";
  input_.hands.live = true;
  input_.hands.late = false;
  EXPECT_EQ(pass(0.6).command->linear, 0.0);
  EXPECT_FALSE(said({CueKind::stick_lost, About::pad}) || said(CueKind::pad_back));
  input_.hands.live = false;
  pass(0.02);
  EXPECT_TRUE(said({CueKind::stick_lost, About::pad}));
}

TEST_F(GuideTest, says_each_time_to_who_has_no_motors_what_others_feel) {
  input_.keyboard = true;
  input_.felt = false;
  hold(0.0, 1.0);
  int words = 0;
  for (int i = 0; i < 300; ++i) {
    lead(5.0);
    for (const cues::Cue& cue : pass(0.02).cues)
      if (cue.kind == CueKind::release_stick && !cue.felt) ++words;
  }
  EXPECT_EQ(words, 3);
}

TEST_F(GuideTest, a_button_that_is_held_asks_once) {
  pass(6.0);
  told_.clear();
  input_.hands.buttons = {true, false};
  pass(2.0);
  EXPECT_EQ(std::count(told_.begin(), told_.end(), CueKind::answer), 1);
}

TEST_F(GuideTest, what_is_asked_elsewhere_is_answered_like_a_button) {
  pass(6.0);
  told_.clear();
  input_.asked = {drive::Button::repeat};
  pass(0.02);
  input_.asked.clear();
  pass(2.0);
  EXPECT_EQ(std::count(told_.begin(), told_.end(), CueKind::answer), 1);
}

TEST_F(GuideTest, guidance_is_kept_but_not_fresh_for_ever) {
  EXPECT_FALSE(guide_.guidance());
  Guidance guidance;
  guidance.seq = 5;
  guide_.take(guidance, time_);
  EXPECT_TRUE(guide_.guidance_fresh(time_ + 0.7));
  EXPECT_FALSE(guide_.guidance_fresh(time_ + 0.9));
  EXPECT_EQ(guide_.guidance().value().seq, 5U);
}

TEST(Pad, is_felt_as_its_person_has_calibrated_it_and_another_as_configured) {
  GuideConfig config;
  config->haptics.pads = {"abc 0.05 0.05 0.5"};
  Guide guide(config, kEnglish);
  Devices input;
  input.hands.live = true;
  double time = 10.0;
  for (const auto& [pad, most] : {std::pair("abc", 0.5), std::pair("other", 1.0)}) {
    input.pad = pad;
    Beat output;
    for (int i = 0; i < 100; ++i, time += 0.02) {
      guide.take(Odometry{}, time);
      guide.take(Proximity{0, {{ThingClass::box, 1, 0.0, {0.4, 0.0}}}}, time);
      output = beat(guide, input, time);
    }
    EXPECT_NEAR(output.rumble.left, most, 1e-6) << pad;
  }
}

/// Hears each text for half a second, and presses the arrow down when it is silent.
class Learner {
 public:
  explicit Learner(const std::string& lesson) : guide_(config(lesson), kEnglish) {
    input_.hands.live = true;
    input_.hands.axes = {0.0, 0.0};
    input_.hands.buttons.resize(15);
    input_.pad = "pad";
  }
  static GuideConfig config(const std::string& lesson) {
    GuideConfig config;
    config->lesson = lesson;
    return config;
  }
  void learn(double seconds, const std::function<void(const Beat&)>& note) {
    for (const double end = time_ + seconds; time_ < end; time_ += 0.02) {
      input_.speaking = time_ < speaks_until_;
      const double silent = time_ - speaks_until_;
      input_.hands.buttons[12] = silent > 4.0 && silent < 4.1;
      const Beat output = beat(guide_, input_, time_);
      if (output.voice.start) speaks_until_ = time_ + 0.5;
      note(output);
    }
  }

  Guide guide_;
  Devices input_;
  double time_ = 10.0;
  double speaks_until_ = 0.0;
};

TEST(Lesson, is_given_by_the_motors_and_sounds_of_a_session_and_drives_no_robot) {
  Learner learner("glossary");
  std::set<std::string> said;
  std::set<sounds::Earcon> heard;
  std::set<haptics::Pattern> felt;
  double left_alone = 0.0;
  learner.input_.hands.axes = {0.0, 1.0};
  learner.learn(400.0, [&](const Beat& output) {
    EXPECT_FALSE(output.command);
    for (const cues::Cue& cue : output.cues) said.insert(cue.word());
    for (const sounds::Play& play : output.plays) heard.insert(play.earcon);
    if (output.pattern) felt.insert(*output.pattern);
    if (output.rumble.right == 0.0) left_alone = std::max(left_alone, output.rumble.left);
  });
  EXPECT_EQ(felt.size(), names(haptics::Pattern{}).size());
  EXPECT_EQ(heard.size(), names(sounds::Earcon{}).size() - 2) << "all but what is off";
  EXPECT_GT(left_alone, 0.5);
  EXPECT_EQ(said.count("glossary_said_go_on") + said.count("go_on"), 2U);
  for (const char* kind : {"simulator_lost", "guidance_lost", "proximity_lost", "release_stick"})
    EXPECT_EQ(said.count(kind), 0U) << kind;
}

TEST(Lesson, lets_a_newcomer_drive_before_the_trial_and_the_guide_says_what_is_urgent_only) {
  Learner learner("tutorial");
  TrialState waits;
  waits.state = TrialState::State::ready;
  learner.guide_.take(waits, learner.time_);
  std::set<std::string> said;
  double fastest = 0.0;
  learner.learn(30.0, [&](const Beat& output) {
    learner.guide_.take(Odometry{}, learner.time_);
    learner.guide_.take(Proximity{}, learner.time_);
    learner.input_.hands.axes = {0.0, learner.time_ > 15.0 ? 1.0 : 0.0};
    if (output.command) fastest = std::max(fastest, output.command->linear);
    for (const cues::Cue& cue : output.cues) said.insert(cue.word());
  });
  EXPECT_GT(fastest, 0.8);
  EXPECT_EQ(said.count("press_start"), 0U);
  EXPECT_EQ(said.count("tutorial_let_go"), 1U);
  EXPECT_EQ(said.count("stuck_unknown"), 1U);
}

TEST(Lesson, shows_the_sentence_that_it_says_in_each_of_its_steps) {
  for (const char* lesson : {"tutorial", "glossary", "calibrate"}) {
    Learner learner(lesson);
    TrialState waits;
    waits.state = TrialState::State::ready;
    learner.guide_.take(waits, learner.time_);
    std::set<std::string> keys, wrong;
    std::string said;
    learner.learn(400.0, [&](const Beat& output) {
      learner.guide_.take(Odometry{}, learner.time_);
      learner.guide_.take(Proximity{}, learner.time_);
      learner.guide_.take(Guidance{}, learner.time_);
      for (const CueEvent& event : output.events) {
        const navvi_types::Spoken* const spoken = event.spoken();
        if (event.stage != CueStage::started || !spoken || spoken->lesson.empty()) continue;
        keys.insert(spoken->lesson);
        said = event.text;
      }
      if (!learner.guide_.parts().teacher.speaks() || said.empty()) return;
      const auto order = learner.guide_.order();
      if (!order || order->text != said || order->kind() != CueKind::lesson)
        wrong.insert(said + " | " + (order ? order->text : "nothing"));
    });
    EXPECT_EQ(wrong, std::set<std::string>{}) << lesson;
    EXPECT_GT(keys.size(), 4U) << lesson;
    if (lesson != std::string("tutorial")) continue;
    for (const auto& step : lessons::Tutorial::steps())
      EXPECT_EQ(keys.count("tutorial_" + std::string(step.name)), 1U) << step.name;
  }
}

}  // namespace
}  // namespace navvi_feedback::core
