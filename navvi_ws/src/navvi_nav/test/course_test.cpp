#include "navvi_nav/course.hpp"

#include <gtest/gtest.h>

#include "small_world.hpp"

namespace navvi_nav {
namespace {

/// A room of 16 x 10 m; the robot is to go along y = 5 from x = 2 to x = 14.
class CourseTest : public testing::Test {
 protected:
  CourseTest() {
    world_.room(16, 10);
    EXPECT_EQ(mesh_.set_map(world_.voxels()).error, "");
  }

  [[nodiscard]] static Plan plan(PlanStatus status, const Path& path) {
    Plan out;
    out.status = status;
    out.path = path;
    out.shortest = length_of(path);
    return out;
  }
  [[nodiscard]] Scene scene() const {
    return {time_, robot_, 0.7, mesh_.shared_floor().get(), things_, obstacles_};
  }
  void take(const Plan& plan, Reason reason) { course_.take(plan, reason, scene(), policy_); }
  /// Something 0.8 m long that stands at (x, 5) and faces the robot.
  void put_before(double x) {
    things_ = {{{7, {x, 5}, 0.5, {}}, M_PI, 0.8, 0.6}};
    obstacles_ = {things_[0].cylinder};
  }
  bool goes_on(double seconds) {
    time_ += seconds;
    const bool arrived = course_.arrives(scene());
    course_.watch(scene(), policy_);
    return arrived;
  }
  [[nodiscard]] Status status() const {
    Status out;
    course_.tell_unrest(out, time_);
    course_.tell(out, scene(), policy_);
    return out;
  }

  SmallWorld world_;
  NavMesh mesh_{NavMeshConfig{}};
  Course course_{CourseConfig{}};
  ReplanPolicy policy_{ReplanPolicyConfig{}};
  std::vector<MovingThing> things_;
  std::vector<Cylinder> obstacles_;
  Pose robot_{{2, 5}, 0.0};
  double time_ = 100.0;
  const Path straight_{{2, 5}, {14, 5}};
  const Path round_{{2, 5}, {2, 1}, {14, 1}, {14, 5}};
};

TEST_F(CourseTest, stays_with_a_path_that_serves_and_leaves_it_for_one_that_is_much_shorter) {
  take(plan(PlanStatus::found, round_), Reason::new_goal);
  take(plan(PlanStatus::found, {{2, 5}, {2, 1.5}, {14, 1.5}, {14, 5}}), Reason::period);
  EXPECT_EQ(course_.guidance().path(), round_);
  EXPECT_EQ(status().reroutes, 0U);
  take(plan(PlanStatus::found, straight_), Reason::period);
  EXPECT_EQ(course_.guidance().path(), straight_);
  EXPECT_EQ(status().reroutes, 1U);
  EXPECT_EQ(status().reroute_reason, Reason::period);
  EXPECT_GT(status().churn, 5.0);
}

TEST_F(CourseTest, leaves_a_path_that_serves_for_a_new_goal_or_from_far_off_it) {
  take(plan(PlanStatus::found, straight_), Reason::new_goal);
  const Path other{{2, 5}, {13, 4}};
  take(plan(PlanStatus::found, other), Reason::new_goal);
  EXPECT_EQ(course_.guidance().path(), other);
  robot_.position = {4, 7};
  const Path back{{4, 7}, {13, 4}};
  take(plan(PlanStatus::found, back), Reason::period);
  EXPECT_EQ(course_.guidance().path(), back);
}

TEST_F(CourseTest, tells_what_closes_the_only_way_once_it_is_near) {
  put_before(8.0);
  take(plan(PlanStatus::closed, straight_), Reason::new_goal);
  goes_on(0.1);
  EXPECT_TRUE(course_.closed());
  EXPECT_EQ(status().state, State::following);
  robot_.position = {5.5, 5};
  goes_on(0.1);
  ASSERT_EQ(status().state, State::blocked);
  EXPECT_EQ(status().blocked->by, 7U);
  EXPECT_TRUE(course_.ground_to_leave(things_).empty());
}

TEST_F(CourseTest, goes_aside_for_what_it_faces_waits_there_and_arrives_nowhere) {
  put_before(4.0);
  take(plan(PlanStatus::closed, straight_), Reason::new_goal);
  goes_on(0.1);
  goes_on(10.0);
  ASSERT_FALSE(course_.ground_to_leave(things_).empty());
  take(plan(PlanStatus::retreat, {{2, 5}, {2, 7}}), Reason::period);
  EXPECT_EQ(status().state, State::make_room);
  EXPECT_EQ(status().blocked->by, 7U);
  EXPECT_FALSE(status().heading.waypoint_is_goal);
  robot_.position = {2, 5.75};
  EXPECT_FALSE(goes_on(1.0));
  EXPECT_EQ(status().state, State::make_room);
  robot_.position = {2, 6.9};
  EXPECT_FALSE(goes_on(3.0));
  EXPECT_EQ(status().state, State::blocked);
  EXPECT_FALSE(status().heading.waypoint_is_goal);
  EXPECT_EQ(status().reroutes, 0U);
  EXPECT_TRUE(course_.closed());
  things_.clear();
  obstacles_.clear();
  take(plan(PlanStatus::found, {{2, 6.9}, {14, 5}}), Reason::period);
  goes_on(0.1);
  EXPECT_EQ(status().state, State::following);
  robot_.position = {13.5, 5};
  EXPECT_TRUE(goes_on(15.0));
}

TEST_F(CourseTest, is_aside_only_where_it_leaves_the_ground_free) {
  put_before(4.0);
  take(plan(PlanStatus::closed, straight_), Reason::new_goal);
  goes_on(0.1);
  goes_on(10.0);
  ASSERT_FALSE(course_.ground_to_leave(things_).empty());
  take(plan(PlanStatus::retreat, {{2, 5}, {2, 6.0}}), Reason::period);
  robot_.position = {2, 5.7};  // the thing needs 0.5 m to the side, the robot 0.35 m
  goes_on(1.0);
  EXPECT_EQ(status().state, State::make_room);
  robot_.position = {2, 5.9};
  goes_on(1.0);
  EXPECT_EQ(status().state, State::blocked);
}

TEST_F(CourseTest, leaves_the_place_aside_where_something_runs_into_it) {
  put_before(4.0);
  take(plan(PlanStatus::closed, straight_), Reason::new_goal);
  goes_on(0.1);
  goes_on(10.0);
  ASSERT_FALSE(course_.ground_to_leave(things_).empty());
  take(plan(PlanStatus::retreat, {{2, 5}, {2, 7}}), Reason::period);
  robot_.position = {2, 6.9};
  goes_on(1.0);
  take(plan(PlanStatus::closed, {{2, 6.9}, {14, 6.9}}), Reason::period);
  ReplanInput input;
  input.time = time_;
  input.has_goal = true;
  input.robot = robot_;
  input.remaining = course_.guidance().remaining(robot_.position);
  for (const double speed : {0.0, 1.0}) {
    input.obstacles = {{9, {2, 2.5}, 0.3, {0, speed}}};
    static_cast<void>(policy_.update(input));
    goes_on(0.1);
    EXPECT_EQ(status().state, speed > 0.0 ? State::following : State::blocked) << speed;
  }
}

TEST_F(CourseTest, follows_nothing_after_it_was_dropped) {
  take(plan(PlanStatus::found, straight_), Reason::new_goal);
  course_.drop();
  EXPECT_FALSE(course_.following());
  robot_.position = {14, 5};
  EXPECT_FALSE(goes_on(1.0));
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
