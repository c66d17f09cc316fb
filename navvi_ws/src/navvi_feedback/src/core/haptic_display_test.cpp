#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>
#include <utility>

#include "guide_fixture.hpp"

namespace navvi_feedback::core {
namespace {

class AlarmTest : public GuideTest {
 protected:
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

  int alarms_ = 0;
};

TEST_F(AlarmTest, F1_the_motors_report_a_missing_audio_device_once_there_are_some) {
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
  input_.audio = Link::never;
  EXPECT_GT(strongest(0.3), 0.0);
  input_.audio = Link::alive;
  EXPECT_EQ(strongest(0.02), 0.0) << "it ends at once when the device is there";
  input_.audio = Link::lost;
  EXPECT_GT(strongest(5.0), 0.1);
  EXPECT_EQ(alarms_, 2);
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

TEST(HapticDisplay, gives_the_answer_of_a_lesson_on_its_side_and_with_three_taps) {
  HapticDisplay display({});
  lessons::Taught taught;
  taught.pattern = haptics::Pattern::answer;
  taught.side = haptics::Zone::left;
  display.begin({}, {}, taught);
  int left = 0, right = 0;
  haptics::Rumble last;
  for (int i = 0; i < 150; ++i) {
    const haptics::Rumble now = display.update({}, std::nullopt, {}, false, 0.02);
    left += now.left > 0.0 && last.left == 0.0 ? 1 : 0;
    right += now.right > 0.0 && last.right == 0.0 ? 1 : 0;
    last = now;
  }
  EXPECT_EQ(left, 4);
  EXPECT_EQ(right, 3);
}

TEST_F(GuideTest, patterns_are_left_out_where_touch_is_not_wanted) {
  for (const char* text : {"haptics: {enabled: false}", "haptics: {patterns: false}"}) {
    GuideConfig config;
    navvi_config::read(config, YAML::Load(text), "test");
    Guide guide(config, cues::Phrases(kEnglish));
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

TEST_F(GuideTest, what_is_near_is_felt_while_it_is_fresh) {
  guide_.take(Odometry{}, time_);
  guide_.take(Proximity{0, {{ThingClass::worker, 1, 0.5, {0.9, 0.0}, true}}}, time_);
  EXPECT_GT(pass(0.7).rumble.left, 0.5);
  const haptics::Rumble stale = pass(0.3).rumble;
  EXPECT_EQ(stale.left + stale.right, 0.0);
}

TEST(Pad, is_felt_as_its_person_has_calibrated_it_and_another_as_configured) {
  GuideConfig config;
  config->haptics.pads = {"abc 0.05 0.05 0.5"};
  Guide guide(config, cues::Phrases(kEnglish));
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

}  // namespace
}  // namespace navvi_feedback::core
