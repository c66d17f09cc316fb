#include "navvi_sim/setup/course.hpp"

#include <gtest/gtest.h>

#include "temp_folder.hpp"

namespace navvi_sim::setup {
namespace {

void expect_same(const Course& a, const Course& b) {
  EXPECT_EQ(a.ends.start.position, b.ends.start.position);
  EXPECT_EQ(a.ends.start.yaw, b.ends.start.yaw);
  EXPECT_EQ(a.ends.goal, b.ends.goal);
  EXPECT_EQ(a.ends.route_length, b.ends.route_length);
  EXPECT_EQ(a.ends.note, b.ends.note);
}

class CourseOf : public testing::Test {
 protected:
  CourseOf() {
    config_.world = "easy";
  }

  [[nodiscard]] Course course(const navvi_files::Cache* cache) const {
    return course_of(config_, load_world(config_).world, cache);
  }
  [[nodiscard]] std::size_t kept() const { return folder_.files().size(); }

  navvi_test::TempFolder folder_;
  SimNodeConfig config_;
};

TEST_F(CourseOf, a_world_is_the_same_fresh_and_kept) {
  const navvi_files::Cache cache({folder_, 16, "build"});
  const Course fresh = course(nullptr);
  expect_same(course(&cache), fresh);
  EXPECT_EQ(kept(), 1u);
  expect_same(course(&cache), fresh);
  EXPECT_EQ(kept(), 1u);
}

TEST_F(CourseOf, another_seed_goal_or_map_is_another_one) {
  const navvi_files::Cache cache({folder_, 16, "build"});
  const Course first = course(&cache);
  config_.seed = 2;
  const Course other_seed = course(&cache);
  EXPECT_NE(other_seed.ends.goal, first.ends.goal);
  config_.seed = 1;
  config_.goal = "1,1";
  EXPECT_EQ(course(&cache).ends.goal, Eigen::Vector2d(1.0, 1.0));
  config_.goal.clear();
  config_.octomap.resolution = 0.1;
  EXPECT_EQ(course(&cache).voxels.resolution, 0.1);
  EXPECT_EQ(kept(), 4u);
}

}  // namespace
}  // namespace navvi_sim::setup
