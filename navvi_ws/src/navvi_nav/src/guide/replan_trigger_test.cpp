#include "guide/replan_trigger.hpp"

#include <gtest/gtest.h>

#include "guide/path_keeper.hpp"

namespace navvi_nav::guide {
namespace {

/// A robot that drives well along a straight path, with nothing near.
ReplanInput driving(double time) {
  ReplanInput input;
  input.time = time;
  input.speed = 0.8;
  input.remaining = {{0, 0}, {5, 0}, {5, 8}};
  return input;
}

Cylinder obstacle(std::uint32_t id, Point center) { return {id, center, 0.3, {}}; }

/// The trigger, and beside it what fills in its input.
class Deciders {
 public:
  explicit Deciders(const ReplanTriggerConfig& config) : trigger_(config) {}
  std::optional<Guidance::Replan> update(ReplanInput input) {
    input.conflict = forecast_.forecast(input.remaining, input.obstacles, 0.7);
    input.kept = keeper_.update(input.time, input.conflict);
    input.evades = keeper_.evades(input.conflict);
    input.worthwhile = keeper_.worthwhile(length_of(input.remaining));
    return trigger_.update(input);
  }

 private:
  ReplanTrigger trigger_;
  PathKeeper keeper_{PathKeeperConfig{}};
  ConflictForecast forecast_{ConflictForecastConfig{}};
};

class Trigger : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(trigger_.update(driving(0.0)), Guidance::Replan::new_goal); }
  static ReplanTriggerConfig always() {
    ReplanTriggerConfig config;
    config.only_if_it_matters = false;
    return config;
  }
  Deciders trigger_{always()};
};

TEST_F(Trigger, plans_every_period_and_not_before) {
  EXPECT_FALSE(trigger_.update(driving(1.9)));
  EXPECT_EQ(trigger_.update(driving(2.0)), Guidance::Replan::period);
  EXPECT_FALSE(trigger_.update(driving(3.9)));
  EXPECT_EQ(trigger_.update(driving(4.0)), Guidance::Replan::period);
}

TEST_F(Trigger, plans_at_once_for_a_new_goal_or_map) {
  ReplanInput input = driving(0.05);
  input.new_goal = true;
  EXPECT_EQ(trigger_.update(input), Guidance::Replan::new_goal);
  input = driving(0.1);
  input.map_changed = true;
  EXPECT_EQ(trigger_.update(input), Guidance::Replan::map_changed);
}

TEST_F(Trigger, plans_when_a_hole_cuts_the_path) {
  ReplanInput input = driving(0.6);
  input.obstacles = {obstacle(1, {3.5, 0.5})};
  EXPECT_EQ(trigger_.update(input), Guidance::Replan::path_carved);
  input.time = 0.7;  // not again within min_interval
  EXPECT_FALSE(trigger_.update(input));
}

TEST_F(Trigger, plans_when_the_next_waypoint_is_blocked) {
  ReplanInput input = driving(0.6);
  input.obstacles = {obstacle(1, {5.2, -0.2})};
  EXPECT_EQ(trigger_.update(input), Guidance::Replan::waypoint_blocked);
}

TEST_F(Trigger, plans_once_for_each_obstacle_that_comes_near) {
  ReplanInput input = driving(0.6);
  input.obstacles = {obstacle(1, {-1, 2})};
  EXPECT_EQ(trigger_.update(input), Guidance::Replan::obstacle_near);
  input.time = 1.2;
  EXPECT_FALSE(trigger_.update(input));
  input.time = 1.8;
  input.obstacles.push_back(obstacle(2, {-2, -1}));
  EXPECT_EQ(trigger_.update(input), Guidance::Replan::obstacle_near);
}

TEST_F(Trigger, remembers_an_obstacle_that_came_near_just_after_a_plan) {
  ReplanInput input = driving(0.1);
  input.obstacles = {obstacle(1, {-1, 2})};
  EXPECT_FALSE(trigger_.update(input));
  input.time = 0.6;
  EXPECT_EQ(trigger_.update(input), Guidance::Replan::obstacle_near);
}

TEST(ReplanTrigger, plans_when_the_robot_is_too_slow_for_too_long) {
  ReplanTriggerConfig config;
  config.only_if_it_matters = false;
  config.period = 3.0;
  Deciders trigger(config);
  ReplanInput input = driving(0.0);
  ASSERT_EQ(trigger.update(input), Guidance::Replan::new_goal);
  input.speed = 0.05;
  for (const double time : {0.5, 1.0, 1.5}) {
    input.time = time;
    EXPECT_FALSE(trigger.update(input)) << time;
  }
  input.time = 1.6;
  EXPECT_EQ(trigger.update(input), Guidance::Replan::too_slow);
  for (const double time : {2.0, 3.0, 4.0}) {  // never faster than tau
    input.time = time;
    EXPECT_FALSE(trigger.update(input)) << time;
  }
  input.time = 4.7;
  EXPECT_EQ(trigger.update(input), Guidance::Replan::too_slow);
}

TEST(ReplanTrigger, searches_again_from_beside_the_path) {
  Deciders trigger{ReplanTriggerConfig{}};
  ReplanInput input = driving(0.0);
  ASSERT_EQ(trigger.update(input), Guidance::Replan::new_goal);
  input.time = 10.0;
  EXPECT_FALSE(trigger.update(input));
  input.path_offset = 0.8;
  EXPECT_EQ(trigger.update(input), Guidance::Replan::period);
}

/// True if the trigger wants another search on the way from (0, 0) to (10, 0).
bool searches_again(const std::vector<Cylinder>& before, const std::vector<Cylinder>& now,
                    double worthwhile = 12.0) {
  ReplanTrigger trigger{ReplanTriggerConfig{}};
  ReplanInput input = driving(0.0);
  input.remaining = {{0, 0}, {10, 0}};
  input.worthwhile = worthwhile;
  input.obstacles = before;
  EXPECT_EQ(trigger.update(input), Guidance::Replan::new_goal);
  input.time = 10.0;
  input.obstacles = now;
  return trigger.update(input).has_value();
}

TEST(ReplanTrigger, searches_through_places_within_the_ellipse_that_were_left) {
  const Cylinder hole{1, {5, 2}, 0.5, {}};
  EXPECT_FALSE(searches_again({}, {}));
  EXPECT_FALSE(searches_again({hole}, {hole}));
  EXPECT_TRUE(searches_again({hole}, {}));
  EXPECT_FALSE(searches_again({hole}, {}, 9.9));  // nothing is shorter than straight on
  Cylinder moved = hole;
  moved.center.y += 0.05;
  EXPECT_FALSE(searches_again({hole}, {moved}));
  moved.center.y += 0.2;
  EXPECT_TRUE(searches_again({hole}, {moved}));
  moved = hole;
  moved.radius = 0.3;
  EXPECT_TRUE(searches_again({hole}, {moved}));
  EXPECT_FALSE(searches_again({{1, {5, 7}, 0.5, {}}}, {}));
}

TEST(ReplanTrigger, does_not_search_for_what_comes_near_beside_the_path) {
  Deciders trigger{ReplanTriggerConfig{}};
  ASSERT_EQ(trigger.update(driving(0.0)), Guidance::Replan::new_goal);
  ReplanInput input = driving(0.6);
  input.obstacles = {obstacle(1, {-1, 2})};
  EXPECT_FALSE(trigger.update(input));
  input.speed = 0.0;
  for (double time = 1.0; time < 10.0; time += 0.5) {
    input.time = time;
    EXPECT_FALSE(trigger.update(input));
  }
}

TEST(ReplanTrigger, takes_the_word_of_others_on_what_cuts_the_path) {
  ReplanTrigger trigger{ReplanTriggerConfig{}};
  ASSERT_EQ(trigger.update(driving(0.0)), Guidance::Replan::new_goal);
  ReplanInput input = driving(0.6);
  input.conflict.cut = Conflict::Cut{1, 4.0};
  input.kept = true;
  EXPECT_FALSE(trigger.update(input));
  input.kept = false;
  input.closed = true;
  EXPECT_FALSE(trigger.update(input));
  input.closed = false;
  EXPECT_EQ(trigger.update(input), Guidance::Replan::path_carved);
  input.conflict = {};
  input.evades = true;
  input.time = 2.5;  // not before a period is over
  EXPECT_FALSE(trigger.update(input));
  input.time = 2.6;
  EXPECT_EQ(trigger.update(input), Guidance::Replan::path_carved);
}

using Refusal = Guidance::Refusal;

const Point kThere{20.0, 3.0};

/// After a goal there that was stamped 10 s was refused at 11 s.
SecondAsk refused(Refusal why = Refusal::not_seen) {
  SecondAsk ask;
  EXPECT_FALSE(ask.agrees(kThere, 10.0));
  ask.refused(kThere, why, 11.0);
  return ask;
}

TEST(SecondAsk, is_a_goal_at_the_refused_place_with_a_newer_stamp) {
  for (const Refusal why : {Refusal::not_seen, Refusal::off_the_map})
    EXPECT_TRUE(refused(why).agrees({20.3, 3.3}, 12.0));
  EXPECT_FALSE(refused().agrees({20.5, 3.5}, 12.0)) << "another place";
}

TEST(SecondAsk, is_no_goal_that_a_program_sends_again) {
  SecondAsk ask = refused();
  for (const double stamp : {10.0, 0.0, 11.0}) EXPECT_FALSE(ask.agrees(kThere, stamp)) << stamp;
  EXPECT_TRUE(ask.agrees(kThere, 12.0));
}

TEST(SecondAsk, holds_for_the_same_message_sent_again_until_that_is_refused_too) {
  SecondAsk ask = refused();
  ASSERT_TRUE(ask.agrees(kThere, 12.0));
  EXPECT_TRUE(ask.agrees(kThere, 12.0));
  EXPECT_FALSE(ask.agrees(kThere, 13.0)) << "nothing was refused since";
  ask.refused(kThere, Refusal::not_seen, 14.0);
  EXPECT_FALSE(ask.agrees(kThere, 12.0));
  EXPECT_TRUE(ask.agrees(kThere, 15.0));
}

TEST(SecondAsk, is_forgotten_for_another_goal_of_the_person_and_not_for_one_that_is_restored) {
  SecondAsk restored = refused();
  EXPECT_FALSE(restored.agrees({5.0, 5.0}, 9.0));
  EXPECT_TRUE(restored.agrees(kThere, 13.0));
  SecondAsk other = refused();
  EXPECT_FALSE(other.agrees({5.0, 5.0}, 12.0));
  EXPECT_FALSE(other.agrees(kThere, 13.0));
}

TEST(SecondAsk, leaves_what_was_agreed_to_while_another_goal_is_refused) {
  SecondAsk ask = refused();
  ASSERT_TRUE(ask.agrees(kThere, 12.0));
  ASSERT_FALSE(ask.agrees({40.0, 3.0}, 20.0));
  ask.refused({40.0, 3.0}, Refusal::off_the_map, 20.5);
  EXPECT_TRUE(ask.agrees(kThere, 12.0)) << "restored";
  EXPECT_TRUE(ask.agrees({40.0, 3.0}, 25.0));
}

TEST(SecondAsk, is_of_no_use_where_something_stands) {
  for (const Refusal why : {Refusal::inside_obstacle, Refusal::unreachable, Refusal::unknown_frame})
    EXPECT_FALSE(refused(why).agrees(kThere, 12.0));
}

}  // namespace

}  // namespace navvi_nav::guide
