#include <gtest/gtest.h>

#include "lockstep.hpp"

namespace navvi_nav::guide {
namespace {

/// A hall of which only the floor about the robot is seen at first: x from 0 to 8 m, y to 6 m.
class Toward : public Lockstep {
 protected:
  Toward() {
    hall_.floor(0, 0, 8, 6);
    robot_.position = {2, 3};
    show();
  }
  /// A map comes.
  void show() {
    navigator_.set_map(message_of(hall_));
    tick();
  }
  /// A person sets it now.
  void choose(const Point& goal) {
    navigator_.set_goal({goal.x, goal.y}, time_);
    tick(2);
  }
  void choose_twice(const Point& goal) {
    choose(goal);
    ASSERT_EQ(status().state, Guidance::State::goal_refused);
    choose(goal);
    ASSERT_EQ(status().state, Guidance::State::following) << status().detail;
    ASSERT_TRUE(status().ends_short);
  }
  void see(double x0, double y0, double x1, double y1) {
    hall_.floor(x0, y0, x1, y1);
    show();
    tick(2);
  }
  /// Drives on, at most so many m, and counts how often the path changes.
  void follow(double metres) {
    for (double left = metres; left > 0.0 && status().state == Guidance::State::following;
         left -= 0.05) {
      const Path before = navigator_.path();
      drive(0.05);
      if (navigator_.path() != before) ++changes_;
      ASSERT_FALSE(status().ends_short && status().waypoint_is_goal);
    }
  }
  SmallWorld hall_;  ///< as it is seen
  int changes_ = 0;
};

TEST_F(Toward, N12_a_goal_beyond_the_map_is_refused_until_a_person_asks_again) {
  choose({20, 3});
  EXPECT_EQ(status().state, Guidance::State::goal_refused);
  EXPECT_EQ(status().refusal, Guidance::Refusal::off_the_map);
  for (const double stamp : {time_ - 0.1, 0.0}) {  // as trial_node does
    navigator_.set_goal({20, 3}, stamp);
    tick(60);
    EXPECT_EQ(status().state, Guidance::State::goal_refused) << stamp;
    EXPECT_TRUE(navigator_.path().empty());
  }
  choose({20.2, 3.1});
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_TRUE(status().ends_short);
  EXPECT_FALSE(status().waypoint_is_goal);
  EXPECT_NEAR(navigator_.path().back().x, 7.6, 0.1);
  EXPECT_EQ(status().goal, Eigen::Vector2d(20.2, 3.1)) << "it is not moved";
  EXPECT_NEAR(status().goal_distance, 5.6, 0.1);
}

TEST_F(Toward, follows_the_map_as_it_grows_and_arrives_at_the_goal_itself) {
  const Point goal{20, 3};
  choose_twice(goal);
  follow(4.0);
  see(8, 0, 14, 6);
  EXPECT_TRUE(status().ends_short);
  EXPECT_NEAR(navigator_.path().back().x, 13.6, 0.1);
  follow(6.0);
  see(14, 0, 22, 6);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_FALSE(status().ends_short);
  EXPECT_EQ(navigator_.path().back(), goal);
  EXPECT_NEAR(status().goal_distance, distance(robot_.position, goal), 0.1);
  follow(20.0);
  EXPECT_EQ(status().state, Guidance::State::arrived);
  EXPECT_LT(distance(robot_.position, goal), 1.0);
  EXPECT_LE(changes_, 1) << "besides those by a map";
}

TEST_F(Toward, N12_never_arrives_where_the_map_ends_and_refuses_the_goal_there) {
  choose_twice({20, 3});
  follow(20.0);
  EXPECT_EQ(status().state, Guidance::State::goal_refused);
  EXPECT_EQ(status().refusal, Guidance::Refusal::not_seen);
  EXPECT_NEAR(robot_.position.x, 7.6, 1.0);
  choose({20, 3});
  EXPECT_EQ(status().state, Guidance::State::goal_refused) << "no way leads nearer";
  see(8, 0, 14, 6);
  EXPECT_EQ(status().state, Guidance::State::goal_refused) << "nobody asked";
  choose({20, 3});
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_TRUE(status().ends_short);
}

TEST_F(Toward, waits_at_the_end_for_a_map_that_shows_more) {
  choose_twice({20, 3});
  robot_.position = {7.3, 3};
  tick(60);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_TRUE(status().ends_short);
  see(8, 0, 14, 6);
  tick(100);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_NEAR(navigator_.path().back().x, 13.6, 0.1);
  robot_.position = {13.3, 3};
  tick(90);
  EXPECT_EQ(status().state, Guidance::State::goal_refused);
}

TEST_F(Toward, refuses_a_goal_that_turns_out_to_be_in_a_wall_or_cut_off) {
  choose_twice({12, 3});
  hall_.floor(8, 0, 14, 6).box(11.5, 2.5, 0, 12.5, 3.5, 1.0);
  show();
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::goal_refused);
  EXPECT_EQ(status().refusal, Guidance::Refusal::inside_obstacle);
  choose_twice({20, 3});
  hall_.floor(14, 0, 24, 6).box(15, 0, 0, 15.1, 6, 1.0);
  show();
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::goal_refused);
  EXPECT_EQ(status().refusal, Guidance::Refusal::unreachable);
}

TEST_F(Toward, stays_with_an_end_while_no_other_is_nearer_to_the_goal_by_half_a_metre) {
  choose_twice({20, 3});
  const Path first = navigator_.path();
  for (const double x : {8.1, 8.2, 8.3, 8.4}) {
    see(8, 1, x, 5);
    tick(50);
    EXPECT_EQ(navigator_.path().back(), first.back()) << x;
  }
  see(8, 1, 8.6, 5);
  tick(2);
  EXPECT_NEAR(navigator_.path().back().x, 8.2, 0.1);
  EXPECT_EQ(status().reroutes, 0U);
}

TEST_F(Toward, leaves_an_end_that_a_map_takes_away) {
  choose_twice({20, 3});
  hall_.box(5, 2, 0, 8, 4, 1.0);
  show();
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_TRUE(status().ends_short);
  const Point end = navigator_.path().back();
  EXPECT_GT(end.x, 7.0);
  EXPECT_GE(std::abs(end.y - 3.0), 1.35 - 1e-6) << "clear of the box";
}

TEST_F(Toward, a_way_that_something_closes_is_not_the_end_of_the_map) {
  hall_.box(5, 0, 0, 5.1, 2.2, 1.0).box(5, 3.8, 0, 5.1, 6, 1.0);
  show();
  choose_twice({20, 3});
  obstacles_ = {{1, {5, 3}, 0.8, {}}};
  tick(50);
  EXPECT_TRUE(status().state == Guidance::State::following ||
              status().state == Guidance::State::blocked);
  EXPECT_NEAR(navigator_.path().back().x, 7.6, 0.1);
  for (int i = 0; i < 200 && status().state == Guidance::State::following; ++i) drive(0.035);
  ASSERT_EQ(status().state, Guidance::State::blocked);
  EXPECT_TRUE(status().ends_short);
  obstacles_.clear();
  tick(20);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_NEAR(navigator_.path().back().x, 7.6, 0.1);
}

}  // namespace
}  // namespace navvi_nav::guide
