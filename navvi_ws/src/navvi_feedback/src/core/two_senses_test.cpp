#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "beat.hpp"

namespace navvi_feedback::core {
namespace {

const std::string kEnglish = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml";

/// What a person has of a situation, by the names of the record.
struct Signals {
  std::set<std::string> said;
  std::set<std::string> played;
  std::set<std::string> felt;
  double left = 0.0;  ///< the most that a motor did
  double right = 0.0;
};

using Happens = std::function<void(Guide&, Devices&, double)>;

/// A family of cues: what happens, and its signal for each sense. An empty name: none is wanted.
struct Family {
  const char* name;
  Happens happens;  ///< called at 50 Hz
  const char* word;
  const char* earcon;
  const char* pattern;
  const char* deaf_pattern;
};

/// The robot follows a path, and the stick is pushed.
Guidance following(double steer) {
  Guidance guidance;
  guidance.state = Guidance::State::following;
  guidance.goal = {20.0, 5.0};
  guidance.steer_angle = guidance.waypoint_angle = steer;
  guidance.waypoint_distance = 8.0;
  guidance.goal_distance = 25.0;
  return guidance;
}

void drive(Guide& guide, double time, double steer = 0.0, double speed = 0.5) {
  guide.take(following(steer), time);
  guide.take(Odometry{0, {}, {speed, 0.0}}, time);
  guide.take(Proximity{}, time);
}

/// s, of what happens; the loss of a sense was told before.
constexpr double kThen = 13.0;

bool once(double time) { return time > kThen + 0.005 && time < kThen + 0.025; }

const std::vector<Family> kFamilies = {
    {"a shelf is hit on the left",
     [](Guide& guide, Devices&, double time) {
       drive(guide, time);
       if (once(time)) guide.take(Contact{ThingClass::shelf, {0.0, 0.4}, 7}, time);
     },
     "collision_shelf", "hit_shelf", "hit_shelf", "hit_shelf"},
    {"a worker is hit on the left",
     [](Guide& guide, Devices&, double time) {
       drive(guide, time);
       if (once(time)) guide.take(Contact{ThingClass::worker, {0.0, 0.4}, 7}, time);
     },
     "collision_obstacle", "hit_obstacle", "hit_obstacle", "hit_obstacle"},
    {"the robot is stopped",
     [](Guide& guide, Devices&, double time) {
       drive(guide, time);
       DriveState state;
       state.state = time < kThen ? DriveState::State::running : DriveState::State::stopped;
       guide.take(state, time);
     },
     "robot_stopped", "", "stopped", "stopped"},
    {"the robot is stuck",
     [](Guide& guide, Devices&, double time) { drive(guide, time, 0.0, 0.0); },
     "stuck_unknown", "", "stuck", "stuck"},
    {"the goal is reached",
     [](Guide& guide, Devices&, double time) {
       drive(guide, time);
       Guidance guidance = following(0.0);
       if (time > kThen) guidance.state = Guidance::State::arrived;
       guide.take(guidance, time);
     },
     "arrived", "arrived", "arrived", "arrived"},
    {"a mover is about to be hit",
     [](Guide& guide, Devices&, double time) {
       drive(guide, time);
       const double gap = std::max(0.3, 5.0 - 0.9 * (time - 10.0));
       guide.take(Proximity{0, {{ThingClass::forklift, 1, gap, {gap + 0.35, 0.0}, true}}}, time);
     },
     "obstacle_stop", "", "halt", "halt"},
    {"something stands in the way for a while",
     [](Guide& guide, Devices&, double time) {
       drive(guide, time);
       Guidance guidance = following(0.0);
       if (time > kThen) guidance.state = Guidance::State::blocked;
       guidance.blocked_by = ThingClass::forklift;
       guidance.blocked_distance = 1.0;
       guide.take(guidance, time);
     },
     "blocked", "", "halt", "halt"},
    {"the guidance is lost",
     [](Guide& guide, Devices&, double time) {
       guide.take(Odometry{0, {}, {0.5, 0.0}}, time);
       guide.take(Proximity{}, time);
       if (time < kThen) guide.take(following(0.0), time);
     },
     "guidance_lost", "", "", "stopped"},
    {"the way leads to the right",
     [](Guide& guide, Devices&, double time) { drive(guide, time, 1.5); }, "", "turn", "",
     ""},
};

enum class Lost { nothing, sound, motors };

Signals signals(const Family& family, Lost lost) {
  Guide guide(GuideConfig{}, kEnglish);
  Devices input;
  input.hands.live = true;
  input.hands.buttons = {false, false};
  input.motors = lost != Lost::motors;
  if (lost == Lost::sound) {
    input.audio = Link::lost;
    input.sounds = false;
  }
  Signals result;
  for (double time = 10.0; time < 18.0; time += 0.02) {
    input.hands.axes = {0.0, time < 10.5 ? 0.0 : 1.0};
    family.happens(guide, input, time);
    const Beat out = beat(guide, input, time);
    if (lost != Lost::sound) {
      for (const cues::Cue& cue : out.cues) result.said.insert(cue.word());
      for (const sounds::Play& play : out.plays)
        result.played.insert(navvi_types::to_string(play.earcon));
    }
    if (lost == Lost::motors) continue;
    if (out.pattern) result.felt.insert(navvi_types::to_string(*out.pattern));
    if (out.pattern) continue;
    result.left = std::max(result.left, out.rumble.left);
    result.right = std::max(result.right, out.rumble.right);
  }
  return result;
}

/// \return whether `name` is there, or none is wanted
bool has(const std::set<std::string>& names, const std::string& name) {
  return name.empty() || names.count(name) > 0;
}

TEST(TwoSenses, every_family_is_heard_and_felt_and_by_the_other_sense_alone_where_one_is_lost) {
  for (const Family& family : kFamilies) {
    SCOPED_TRACE(family.name);
    const Signals all = signals(family, Lost::nothing);
    const Signals deaf = signals(family, Lost::sound);
    const Signals numb = signals(family, Lost::motors);
    for (const Signals* heard : {&all, &numb}) {
      EXPECT_TRUE(has(heard->said, family.word));
      EXPECT_TRUE(has(heard->played, family.earcon));
    }
    EXPECT_TRUE(has(all.felt, family.pattern));
    EXPECT_TRUE(has(deaf.felt, family.deaf_pattern));
    EXPECT_TRUE(has(deaf.felt, "no_sound")) << "the loss is told";
    EXPECT_FALSE(has(all.felt, "no_sound"));
  }
}

TEST(TwoSenses, the_motors_lead_the_way_where_no_word_can) {
  const Family& right = kFamilies.back();
  EXPECT_EQ(signals(right, Lost::nothing).right, 0.0) << "there is nothing near";
  const Signals deaf = signals(right, Lost::sound);
  EXPECT_GT(deaf.right, 0.5);
  EXPECT_EQ(deaf.left, 0.0);
}

TEST(TwoSenses, motors_that_cannot_be_felt_are_told) {
  Guide guide(GuideConfig{}, kEnglish);
  Devices input;
  input.hands.live = true;
  input.hands.axes = {0.0, 0.0};
  input.states = {{CueKind::notice, About::no_rumble}};
  const std::vector<cues::Cue> cues = beat(guide, input, 10.0).cues;
  ASSERT_FALSE(cues.empty());
  EXPECT_EQ(cues[0].about, About::no_rumble);
}

}  // namespace
}  // namespace navvi_feedback::core
