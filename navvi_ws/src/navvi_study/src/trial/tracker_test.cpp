#include "trial/tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_study::trial {
namespace {

constexpr std::int64_t kMs = 1'000'000;

navvi_types::Odometry at(std::int64_t ms, double x, double yaw = 0.0) {
  navvi_types::Odometry place;
  place.stamp = ms * kMs;
  place.pose = {{x, 0.0}, yaw};
  return place;
}

navvi_types::Guidance steer(std::int64_t ms, double angle) {
  navvi_types::Guidance guidance;
  guidance.stamp = ms * kMs;
  guidance.state = navvi_types::Guidance::State::following;
  guidance.steer_angle = angle;
  return guidance;
}

navvi_types::CueEvent cue(std::int64_t ms, decltype(navvi_types::CueEvent::what) what,
                          double left = 0.0) {
  navvi_types::CueEvent event;
  event.stage = navvi_types::CueStage::started;
  event.what = what;
  event.left = left;
  event.stamp = ms * kMs;
  return event;
}

TEST(Tracker, has_a_row_each_20_ms_from_the_start_on) {
  Tracker tracker;
  for (std::int64_t ms = 0; ms <= 200; ms += 10) tracker.observe(at(ms, 0.01 * double(ms)));
  tracker.start(100 * kMs);
  EXPECT_TRUE(tracker.rows_until(90 * kMs).empty());
  const record::Track first = tracker.rows_until(140 * kMs);
  ASSERT_EQ(first.size(), 3u);
  EXPECT_DOUBLE_EQ(first[0].time, 0.1);
  EXPECT_FLOAT_EQ(first[2].x, 1.4F);
  EXPECT_EQ(tracker.rows_until(200 * kMs).size(), 3u) << "and none twice";
}

TEST(Tracker, holds_what_was_reported_last_in_whatever_order_it_came) {
  const auto told = [](Tracker& tracker, bool late) {
    const auto places = [&] {
      for (std::int64_t ms = 0; ms <= 60; ms += 10) tracker.observe(at(ms, 0.0, 0.01 * double(ms)));
    };
    if (!late) places();
    tracker.start(0);
    tracker.observe(steer(10, 1.0));
    tracker.observe(Hands{20 * kMs, 0.5, -0.25, true});
    tracker.observe(cue(15, navvi_types::Felt{}, 0.75));
    tracker.observe(cue(30, navvi_types::CueKind::turn_now));
    tracker.observe(cue(30, navvi_types::Earcon::turn));
    tracker.observe(cue(40, navvi_types::Earcon::arrived));
    navvi_types::Proximity near{35 * kMs};
    near.things.push_back({navvi_types::ThingClass::worker, 3, 0.5});
    tracker.observe(near);
    if (late) places();
    return tracker.rows_until(60 * kMs);
  };
  Tracker one, other;
  const record::Track rows = told(one, false);
  EXPECT_EQ(record::track_npy(rows), record::track_npy(told(other, true)));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_TRUE(std::isnan(rows[0].steer) && std::isnan(rows[0].gap));
  EXPECT_FLOAT_EQ(rows[1].steer, 1.1F) << "it has turned by 0.1 rad since then";
  EXPECT_FLOAT_EQ(rows[1].stick_forward, 0.5F);
  EXPECT_EQ(rows[1].asks, 1u);
  EXPECT_FLOAT_EQ(rows[1].motor_left, 0.75F);
  EXPECT_EQ(rows[2].cue.text(), "turn_now");
  EXPECT_EQ(rows[2].sounds.text(), "turn arrived");
  EXPECT_EQ(rows[2].nearest.text(), "worker");
  EXPECT_TRUE(rows[3].cue.empty() && rows[3].sounds.empty());
  EXPECT_EQ(rows[3].state.text(), "following");
}

TEST(Tracker, begins_anew_where_the_time_goes_back) {
  Tracker tracker;
  tracker.start(0);
  tracker.observe(at(60'000, 1.0));
  EXPECT_EQ(tracker.rows_until(60'000 * kMs).size(), 1u);
  tracker.observe(at(20, 2.0));
  const record::Track rows = tracker.rows_until(40 * kMs);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_FLOAT_EQ(rows[0].x, 2.0F);
}

}  // namespace
}  // namespace navvi_study::trial
