#include <gtest/gtest.h>

#include <algorithm>
#include <navvi_config/reader.hpp>
#include <set>

#include "beat.hpp"

namespace navvi_feedback::core {
namespace {

/// A person who is led to a place 20 m ahead, a bend to the right at first.
class Leading : public testing::Test {
 protected:
  void begin(const std::string& lead, const std::string& verbosity = "normal") {
    GuideConfig config;
    navvi_config::read(config, YAML::Load("{lead: " + lead + "}"), "test");
    config->cues.wording.verbosity = verbosity;
    guide_ = std::make_unique<Guide>(config, cues::Phrases(kEnglish));
    devices_.hands.live = true;
    devices_.hands.axes = {0.0, 0.0};
    devices_.hands.buttons = {false, false};
    devices_.robot = navvi_types::Pose2{};
    pass(1.0);
  }
  /// What comes in a session at 50 Hz.
  Beat pass(double seconds) {
    Beat output;
    for (const double end = time_ + seconds; time_ < end - 1e-9; time_ += 0.02) {
      Guidance guidance;
      guidance.state = state_;
      guidance.goal = {20.0, 0.0};
      guidance.steer_angle = guidance.waypoint_angle = steer_;
      guidance.waypoint_distance = guidance.goal_distance = 20.0;
      guide_->take(guidance, time_);
      guide_->take(Odometry{0, {}, motion_}, time_);
      guide_->take(Proximity{0, nearby_}, time_);
      output = beat(*guide_, devices_, time_);
      flow_.push_back(output.flow);
      rumble_.push_back(output.rumble);
      for (const cues::Cue& cue : output.cues) {
        said_.insert(cue.goes_on ? CueKind::go_on : cue.kind);
        texts_.insert(cue.text);
      }
      for (const sounds::Play& play : output.plays) played_.insert(play.earcon);
      if (output.pattern) patterns_.insert(*output.pattern);
    }
    return output;
  }
  /// m/s, by a stick that was released and pushed again.
  double drive_anew() {
    devices_.hands.axes = {0.0, 0.0};
    pass(0.5);
    devices_.hands.axes = {0.0, 1.0};
    return pass(1.0).command.value().linear;
  }
  /// Pulses within so many seconds. \param side  0 left, 1 right
  int pulses(double seconds, int side) {
    rumble_.clear();
    pass(seconds);
    int count = 0;
    bool on = false;
    for (const haptics::Rumble& rumble : rumble_) {
      const bool is = (side == 0 ? rumble.left : rumble.right) > 0.0;
      count += is && !on ? 1 : 0;
      on = is;
    }
    return count;
  }

  std::unique_ptr<Guide> guide_;
  Devices devices_;
  Guidance::State state_ = Guidance::State::following;
  double steer_ = 0.3;
  Velocity motion_{0.6, 0.0};
  std::vector<NearThing> nearby_;
  double time_ = 10.0;
  std::vector<haptics::Rumble> flow_, rumble_;
  std::set<CueKind> said_;
  std::set<std::string> texts_;
  std::set<sounds::Earcon> played_;
  std::set<haptics::Pattern> patterns_;
};

TEST_F(Leading, by_a_sound_that_lasts_comes_from_the_side_to_steer_to_and_needs_no_orders) {
  begin("flow");
  EXPECT_GT(pass(3.0).flow.right, pass(0.1).flow.left);
  steer_ = 0.0;
  const haptics::Rumble ahead = pass(3.0).flow;
  EXPECT_NEAR(ahead.left, ahead.right, 1e-3);
  EXPECT_GT(ahead.left + ahead.right, 0.9) << "at full speed";
  EXPECT_EQ(said_.count(CueKind::direction) + said_.count(CueKind::turn_now), 0U);
  EXPECT_EQ(said_.count(CueKind::start), 1U) << "the goal";
  EXPECT_EQ(played_.count(sounds::Earcon::turn_stop), 0U);
}

TEST_F(Leading, falls_silent_where_the_robot_is_to_stand_and_says_why) {
  begin("flow", "full");
  pass(2.0);
  state_ = Guidance::State::blocked;
  const haptics::Rumble none = pass(0.04).flow;
  EXPECT_EQ(none.left + none.right, 0.0);
  pass(3.0);
  EXPECT_EQ(said_.count(CueKind::blocked), 1U);
  EXPECT_EQ(texts_.count("wait, something in the way"), 1U) << "and promises no go on";
  state_ = Guidance::State::following;
  EXPECT_GT(pass(0.5).flow.left, 0.0) << "it is go on itself";
  EXPECT_EQ(said_.count(CueKind::go_on), 0U);
  nearby_ = {{ThingClass::forklift, 1, 0.4, {0.8, 0.0}, true}};
  steer_ = 0.0;
  EXPECT_EQ(pass(0.1).flow.left, 0.0) << "before a thing that moves";
}

TEST_F(Leading, by_a_sound_leads_in_the_next_trial_after_one_that_ended_before_the_goal) {
  begin("flow");
  const auto run = [&](TrialState::State state) { guide_->take(TrialState{state}, time_); };
  for (const double between : {11.0, 1.0}) {
    run(TrialState::State::running);
    EXPECT_GT(pass(2.0).flow.right, 0.0);
    guide_->end_trial(Content{CueKind::trial_ends, About::over});
    EXPECT_EQ(pass(0.5).flow.right, 0.0);
    run(TrialState::State::preparing);
    EXPECT_EQ(pass(between).flow.right, 0.0);
  }
  run(TrialState::State::running);
  EXPECT_GT(pass(2.0).flow.right, 0.0) << "also soon after it";
}

TEST_F(Leading, by_a_sound_that_nobody_follows_gives_way_to_ticks) {
  begin("flow");
  steer_ = 0.6;
  motion_ = {0.0, 0.5};  // to the left
  devices_.hands.axes = {1.0, 0.0};
  pass(20.0);
  EXPECT_EQ(flow_.back().right, 0.0);
  EXPECT_EQ(played_.count(sounds::Earcon::turn), 1U);
}

TEST_F(Leading, by_a_sound_that_gives_way_says_go_on_to_a_person_who_still_waits) {
  begin("flow");
  pass(2.0);
  state_ = Guidance::State::blocked;
  motion_ = {};
  pass(3.0);
  state_ = Guidance::State::following;
  steer_ = 0.6;
  pass(12.0);
  EXPECT_EQ(said_.count(CueKind::go_on), 0U) << "the sound leads again";
  pass(12.0);
  EXPECT_EQ(said_.count(CueKind::go_on), 1U);
}

TEST_F(Leading, by_the_hand_pulses_on_the_side_to_steer_to_and_sounds_nothing_of_the_way) {
  begin("hand");
  EXPECT_GT(pulses(4.0, 1), 5);
  EXPECT_EQ(pulses(1.0, 0), 0);
  steer_ = 0.0;
  pulses(1.0, 0);
  EXPECT_GT(pulses(4.0, 0), 8) << "straight on, and fast";
  nearby_ = {{ThingClass::shelf, 1, 0.5, {0.0, 0.9}}};
  const int before = pulses(4.0, 1);
  EXPECT_GT(before, 8) << "what is near beside the way is not felt";
  state_ = Guidance::State::blocked;
  pulses(0.1, 0);
  EXPECT_EQ(pulses(0.8, 0), 0);
  pass(2.0);
  EXPECT_EQ(patterns_.count(haptics::Pattern::halt), 1U);
  EXPECT_TRUE(std::all_of(flow_.begin(), flow_.end(), [](const auto& flow) {
    return flow.left + flow.right == 0.0;
  }));
}

TEST_F(Leading, by_the_hand_answers_where_the_goal_is_by_its_side_and_a_tap_for_5_m) {
  steer_ = 0.0;
  motion_ = {};
  nearby_ = {{ThingClass::worker, 1, 0.5, {0.9, 0.0}, true}};  // no pulses meanwhile
  begin("hand");
  devices_.robot = navvi_types::Pose2{{8.0, 0.0}, 1.5707963};  // 12 m to the right
  pass(1.5);
  devices_.asked = {drive::Button::goal};
  pass(0.02);
  devices_.asked.clear();
  EXPECT_EQ(pulses(3.0, 1), 4) << "one, and three taps";
  EXPECT_EQ(patterns_.count(haptics::Pattern::answer), 1U);
}

TEST_F(Leading, by_the_hand_stops_the_wheels_when_the_motors_are_lost) {
  begin("hand");
  devices_.hands.axes = {0.0, 1.0};
  EXPECT_GT(pass(1.0).command.value().linear, 0.5);
  devices_.felt = false;
  EXPECT_EQ(pass(0.02).command.value().linear, 0.0);
  EXPECT_EQ(pass(1.0).command.value().linear, 0.0) << "until the stick was neutral";
  steer_ = 1.2;
  EXPECT_GT(drive_anew(), 0.5) << "by what is heard instead";
  EXPECT_EQ(played_.count(sounds::Earcon::turn), 1U);
  devices_.sounds = false;
  EXPECT_EQ(pass(0.02).command.value().linear, 0.0);
  EXPECT_EQ(drive_anew(), 0.0) << "by nothing";
  devices_.felt = true;
  EXPECT_EQ(pass(1.0).command.value().linear, 0.0) << "until the stick was neutral";
  EXPECT_GT(drive_anew(), 0.5);
}

TEST_F(Leading, by_the_hand_that_is_lost_goes_on_by_words_but_not_by_a_device_without_any) {
  using Has = std::pair<bool, bool>;
  for (const auto& [words, voice] : {Has(true, true), Has(false, true), Has(true, false)}) {
    devices_.felt = true;
    begin("hand, sounds: {enabled: false}");
    EXPECT_GT(drive_anew(), 0.5);
    devices_.words = words;
    devices_.voice = voice;
    devices_.felt = false;
    pass(0.02);
    EXPECT_EQ(drive_anew() > 0.5, words && voice);
  }
}

TEST_F(Leading, takes_to_the_hand_only_where_no_sound_reaches_anybody) {
  devices_.audio = Link::never;
  begin("ticks");
  steer_ = 1.2;
  devices_.hands.axes = {0.5, 0.5};
  pass(3.0);
  EXPECT_EQ(played_.count(sounds::Earcon::turn), 1U) << "who listens by a topic hears them";
  devices_.sounds = false;
  pass(3.0);
  EXPECT_GT(pulses(2.0, 1), 0);
  EXPECT_EQ(pulses(2.0, 0), 0);
  EXPECT_GT(drive_anew(), 0.5);
  devices_.felt = false;
  EXPECT_EQ(pass(0.02).command.value().linear, 0.0);
  EXPECT_EQ(drive_anew(), 0.0) << "by nothing";
  devices_.sounds = true;
  EXPECT_GT(drive_anew(), 0.5) << "by what is heard instead";
}

TEST_F(Leading, that_never_was_by_the_hand_stops_no_wheels_where_there_is_no_sound_either) {
  for (const bool felt : {false, true}) {
    devices_ = {};
    devices_.audio = Link::never;
    devices_.sounds = false;
    devices_.felt = felt;
    begin(felt ? "ticks, haptics: {enabled: false}" : "ticks");
    EXPECT_GT(drive_anew(), 0.5);
    devices_.felt = false;
    pass(0.02);
    EXPECT_GT(drive_anew(), 0.5);
  }
}

TEST_F(Leading, by_words_goes_on_between_the_sentences_of_help) {
  begin("words");
  steer_ = 0.0;
  pass(3.0);
  devices_.asked = {drive::Button::help};
  std::vector<CueKind> told;
  for (double until = 0.0; time_ < 30.0;) {
    devices_.speaking = time_ < until;
    const Beat output = pass(0.02);
    if (output.voice.start) until = time_ + 1.5;
    for (const cues::Cue& cue : output.cues) told.push_back(cue.kind);
    devices_.asked.clear();
    steer_ = 1.2;
  }
  EXPECT_EQ(std::count(told.begin(), told.end(), CueKind::lesson), 6);
  const auto way = std::find(told.begin(), told.end(), CueKind::direction);
  EXPECT_GT(std::count(way, told.end(), CueKind::lesson), 3) << "after the new direction";
}

TEST(LeadingConfig, by_the_hand_is_refused_without_motors) {
  GuideConfig config;
  navvi_config::read(config, YAML::Load("{lead: hand, haptics: {enabled: false}}"), "test");
  EXPECT_THROW(Guide(config, cues::Phrases(kEnglish)), navvi_config::ConfigError);
  config->lead = "flow";
  EXPECT_NO_THROW(Guide(config, cues::Phrases(kEnglish)));
  config->sounds.enabled = false;
  EXPECT_THROW(Guide(config, cues::Phrases(kEnglish)), navvi_config::ConfigError);
}

}  // namespace
}  // namespace navvi_feedback::core
