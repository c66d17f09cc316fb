#include "guide/active_path.hpp"

#include <gtest/gtest.h>

#include "small_world.hpp"

namespace navvi_nav::guide {
namespace {

plan::Plan plan(plan::PlanStatus status, const Path& path) {
  plan::Plan out;
  out.status = status;
  out.path = path;
  out.shortest = length_of(path);
  return out;
}

/// A robot that is to go along y = 5 from x = 2 to x = 14.
class Following : public testing::Test {
 protected:
  double follow(plan::PlanStatus status, const Path& path,
                Guidance::Replan reason = Guidance::Replan::period) {
    return path_.follow(plan(status, path), reason, robot_);
  }
  [[nodiscard]] Guidance status() const {
    Guidance out;
    path_.report_changes(out);
    path_.report(out, {{robot_.x, robot_.y}, 0.0}, {}, 0.7);
    return out;
  }
  ActivePath path_{ActivePathConfig{}};
  Point robot_{2, 5};
  const Path straight_{{2, 5}, {14, 5}};
  const Path round_{{2, 5}, {2, 1}, {14, 1}, {14, 5}};
};

TEST_F(Following, counts_as_a_reroute_what_leads_elsewhere) {
  EXPECT_EQ(follow(plan::PlanStatus::found, round_, Guidance::Replan::new_goal), 0.0);
  EXPECT_EQ(status().reroutes, 0U);
  EXPECT_GT(follow(plan::PlanStatus::found, straight_), 5.0);
  EXPECT_EQ(path_.follower().path(), straight_);
  EXPECT_EQ(status().reroutes, 1U);
  EXPECT_EQ(status().reroute_reason, Guidance::Replan::period);
  EXPECT_EQ(follow(plan::PlanStatus::found, {{2, 5}, {13, 5}, {14, 5.3}}), 0.0);
  EXPECT_EQ(status().reroutes, 1U);
  path_.reset();
  EXPECT_FALSE(path_.following());
  follow(plan::PlanStatus::found, round_, Guidance::Replan::new_goal);
  EXPECT_EQ(status().reroutes, 0U);
}

TEST_F(Following, counts_no_reroute_on_a_retreat_or_back_from_one) {
  follow(plan::PlanStatus::closed, straight_, Guidance::Replan::new_goal);
  EXPECT_EQ(path_.mode(), PathMode::closed);
  EXPECT_TRUE(status().waypoint_is_goal);
  EXPECT_GT(follow(plan::PlanStatus::retreat, {{2, 5}, {2, 9}}), 2.0);
  EXPECT_EQ(path_.mode(), PathMode::retreat);
  EXPECT_FALSE(path_.closed());
  EXPECT_FALSE(status().waypoint_is_goal);
  EXPECT_GT(follow(plan::PlanStatus::found, straight_), 2.0);
  EXPECT_EQ(path_.mode(), PathMode::to_goal);
  EXPECT_EQ(status().reroutes, 0U);
}

TEST_F(Following, waits_on_while_the_path_from_the_retreat_is_closed) {
  follow(plan::PlanStatus::retreat, {{2, 5}, {2, 9}});
  path_.set_mode(PathMode::waiting);
  follow(plan::PlanStatus::closed, straight_);
  EXPECT_EQ(path_.mode(), PathMode::waiting);
  EXPECT_TRUE(path_.closed());
  follow(plan::PlanStatus::found, straight_);
  EXPECT_EQ(path_.mode(), PathMode::to_goal);
}

TEST_F(Following, arrives_at_the_goal_and_not_at_the_end_of_a_retreat) {
  plan::NavMesh mesh = mesh_of(SmallWorld().room(16, 10));
  robot_ = {13.5, 5};
  for (const plan::PlanStatus status :
       {plan::PlanStatus::found, plan::PlanStatus::closed, plan::PlanStatus::retreat}) {
    follow(status, straight_);
    EXPECT_EQ(path_.arrived(robot_, mesh.space()), status != plan::PlanStatus::retreat);
  }
  for (const PathMode mode : {PathMode::waiting, PathMode::closed}) {
    path_.set_mode(mode);
    EXPECT_FALSE(path_.arrived(robot_, mesh.space()));
  }
  follow(plan::PlanStatus::found, straight_);
  path_.drop();
  EXPECT_FALSE(path_.following());
  EXPECT_FALSE(path_.arrived(robot_, mesh.space()));
}

TEST_F(Following, tells_a_robot_that_strayed) {
  EXPECT_EQ(path_.offset(robot_), 0.0);
  follow(plan::PlanStatus::found, straight_);
  robot_ = {4, 5.9};
  EXPECT_FALSE(path_.strayed(robot_));
  EXPECT_NEAR(path_.offset(robot_), 0.9, 1e-9);
  robot_ = {4, 7};
  EXPECT_TRUE(path_.strayed(robot_));
}

TEST(MovedPath, counts_what_moved_aside_of_the_next_twenty_metres) {
  const Path path{{0, 0}, {10, 0}, {10, 5}};
  EXPECT_DOUBLE_EQ(moved_length(path, path), 0.0);
  EXPECT_DOUBLE_EQ(moved_length(path, {{0, 0}, {10, 0.4}, {10, 5}}), 0.0);
  EXPECT_NEAR(moved_length(path, {{0, 0}, {10, 0}, {15, 0}}), 4.5, 0.3);
  EXPECT_NEAR(moved_length(path, {}), 15.0, 1e-9);
  EXPECT_NEAR(moved_length({{0, 0}, {90, 0}}, {{0, 3}, {90, 3}}), 20.0, 1e-9);
  EXPECT_DOUBLE_EQ(moved_length({}, path), 0.0);
  EXPECT_DOUBLE_EQ(moved_length({{1, 1}, {1, 1}}, path), 0.0);
}

}  // namespace

}  // namespace navvi_nav::guide
