#include "cues/leg.hpp"

#include <gtest/gtest.h>

#include "cues/clock_face.hpp"

namespace navvi_feedback::cues {
namespace {

using News = Leg::News;

Guidance way(double x, double distance, double degrees = 0.0) {
  Guidance guidance;
  guidance.state = Guidance::State::following;
  guidance.waypoint = {x, 0.0};
  guidance.waypoint_distance = distance;
  guidance.waypoint_angle = guidance.steer_angle = degrees * kDegree;
  return guidance;
}

/// 8 m before a corner, with a turn to 3 o'clock that was announced, and the direction told.
class LegTest : public testing::Test {
 protected:
  LegTest() {
    leg_.begin(way(10.0, 8.0));
    advance(way(10.0, 8.0));
    leg_.heard(12, 1.0);
    leg_.announced(3, 2.0);
  }
  void advance(const Guidance& guidance) { leg_.advance(guidance, next_, config_); }

  RouteConfig config_;
  std::optional<int> next_ = 3;
  Leg leg_;
};

TEST_F(LegTest, has_news_at_a_corner_that_was_reached_but_not_while_it_moves_a_little) {
  advance(way(10.5, 1.5));
  EXPECT_EQ(leg_.news, News::none);
  advance(way(20.0, 9.0));
  EXPECT_EQ(leg_.news, News::told_corner);
  EXPECT_FALSE(leg_.turn_told) << "it was that of the corner behind";
  leg_.heard(3, 3.0);
  advance(way(20.0, 1.5));
  advance(way(30.0, 9.0));
  EXPECT_EQ(leg_.news, News::corner);
}

TEST_F(LegTest, has_another_route_as_news_only_where_the_hour_changes_and_after_no_corner) {
  advance(way(20.0, 8.0, 10.0));
  EXPECT_EQ(leg_.news, News::none);
  advance(way(0.0, 8.0, 100.0));
  EXPECT_EQ(leg_.news, News::other_route);
  advance(way(0.0, 1.0, 100.0));
  advance(way(10.0, 8.0));
  EXPECT_EQ(leg_.news, News::told_corner) << "the same turn is at the other corner";
  advance(way(0.0, 8.0, 100.0));
  EXPECT_EQ(leg_.news, News::told_corner) << "that is told first";
}

TEST_F(LegTest, takes_a_new_plan_just_before_a_corner_for_another_route) {
  advance(way(10.0, 1.5));
  Guidance other = way(20.0, 8.0, 90.0);
  other.reroutes = 1;
  advance(other);
  EXPECT_EQ(leg_.news, News::other_route);
}

TEST_F(LegTest, knows_that_an_announced_turn_falls_away_until_something_is_heard) {
  next_.reset();
  advance(way(20.0, 18.0));
  EXPECT_TRUE(leg_.fell_away);
  EXPECT_FALSE(leg_.turn_told);
  leg_.heard(12, 3.0);
  EXPECT_FALSE(leg_.fell_away);
}

TEST_F(LegTest, forgets_what_was_not_heard_with_the_route_that_it_told) {
  Guidance other = way(0.0, 8.0, 100.0);
  other.reroutes = 2;
  advance(other);
  EXPECT_TRUE(leg_.routes.news(other));
  leg_.heard(3, 3.0);
  EXPECT_FALSE(leg_.routes.news(other));
  leg_.lost(0.0);
  EXPECT_TRUE(leg_.routes.news(other));
  EXPECT_FALSE(leg_.said.hour);
  EXPECT_FALSE(leg_.turn_told);
}

TEST_F(LegTest, has_a_route_that_was_not_heard_as_news_and_the_hour_stands_where_a_sound_tells_it) {
  for (const bool by_sound : {true, false}) {
    leg_.heard(3, 3.0);
    leg_.route_lost(by_sound);
    EXPECT_EQ(leg_.news, News::other_route);
    EXPECT_EQ(leg_.said.hour.has_value(), by_sound);
  }
}

TEST_F(LegTest, has_no_news_for_a_person_who_stands_and_no_direction_without_a_path) {
  advance(way(0.0, 8.0, 100.0));
  leg_.stand();
  EXPECT_EQ(leg_.news, News::none);
  EXPECT_EQ(leg_.said.hour, 12);
  leg_.pause();
  EXPECT_FALSE(leg_.said.hour);
  EXPECT_FALSE(leg_.ends(way(99.0, 1.0), config_.kSameCorner)) << "nothing was seen before";
}

Observation drives(double linear, double degrees, double offset) {
  Observation now;
  now.guidance.emplace();
  now.guidance->steer_angle = degrees * kDegree;
  now.guidance->path_offset = offset;
  now.measured = Velocity{linear, 0.0};
  return now;
}

TEST(Straying, is_the_wrong_way_only_of_a_robot_that_drives) {
  const StrayConfig config;
  EXPECT_EQ(straying(drives(0.5, -130.0, 0.0), {}, config), CueKind::wrong_way);
  EXPECT_EQ(straying(drives(0.5, 110.0, 0.0), {}, config), std::nullopt);
  EXPECT_EQ(straying(drives(0.05, 130.0, 0.0), {}, config), std::nullopt) << "about to turn";
  EXPECT_EQ(straying(drives(0.5, 130.0, 1.0), {}, config), CueKind::wrong_way) << "more urgent";
}

TEST(Straying, is_off_the_path_until_it_is_clearly_on_it) {
  const StrayConfig config;
  EXPECT_EQ(straying(drives(0.5, 0.0, 0.6), {}, config), std::nullopt);
  EXPECT_EQ(straying(drives(0.5, 0.0, 0.8), {}, config), CueKind::off_path);
  EXPECT_EQ(straying(drives(0.5, 0.0, 0.6), CueKind::off_path, config), CueKind::off_path);
  EXPECT_EQ(straying(drives(0.5, 0.0, 0.3), CueKind::off_path, config), std::nullopt);
}

TEST(Stray, is_due_once_it_has_lasted_and_again_while_it_lasts) {
  const StrayConfig config;
  const Observation off = drives(0.5, 0.0, 1.0);
  Stray stray;
  stray.observe(off, config, 10.0);
  EXPECT_FALSE(stray.due(off, config, 11.4));
  EXPECT_TRUE(stray.due(off, config, 11.6));
  EXPECT_FALSE(stray.due(drives(0.0, 0.0, 1.0), config, 11.6)) << "it stands";
  stray.said = 11.6;
  EXPECT_FALSE(stray.due(off, config, 21.5));
  EXPECT_TRUE(stray.due(off, config, 21.7));
  stray.observe(drives(0.5, 170.0, 1.0), config, 22.0);
  EXPECT_FALSE(stray.due(off, config, 22.1)) << "another way to stray begins anew";
}

}  // namespace

}  // namespace navvi_feedback::cues
