#include "node/sensor_queue.hpp"

#include <gtest/gtest.h>

namespace navvi_perception::node {
namespace {

/// A lidar fixed to a robot whose odometry comes as a test tells.
class SensorQueueTest : public testing::Test {
 protected:
  SensorQueueTest() { transform("base_link", "laser", 10.0, true); }

  void transform(const char* parent, const char* child, double stamp, bool fixed = false) {
    geometry_msgs::TransformStamped one;
    one.header.frame_id = parent;
    one.header.stamp = ros::Time(stamp);
    one.child_frame_id = child;
    one.transform.rotation.w = 1.0;
    transforms_.setTransform(one, "test", fixed);
  }
  void odometry(double stamp) { transform("map", "base_link", stamp); }
  [[nodiscard]] std::string push(double stamp, double came, double sweep = 0.0) {
    Waiting one;
    one.header.stamp = ros::Time(stamp);
    one.header.frame_id = "/laser";
    one.sweep = sweep;
    one.came = ros::Time(came);
    return queue_.push(one);
  }
  [[nodiscard]] auto next(double now) { return queue_.next(ros::Time(now)); }

  tf2::BufferCore transforms_;
  SensorQueue queue_{transforms_, "map", "base_link"};
};

TEST_F(SensorQueueTest, is_empty_at_first) { EXPECT_FALSE(next(10.0)); }

TEST_F(SensorQueueTest, waits_for_the_place_of_the_stamp) {
  odometry(10.0);
  ASSERT_EQ(push(10.05, 10.06), "");
  EXPECT_FALSE(next(10.06));
  odometry(10.1);
  const auto found = next(10.11);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->why, "");
  EXPECT_TRUE(found->whole);
  EXPECT_EQ(found->one.header.frame_id, "laser");
  EXPECT_FALSE(next(10.11));
}

TEST_F(SensorQueueTest, H1_waits_for_the_last_ray_for_a_fifth_of_a_second_and_loses_no_scan) {
  odometry(10.0);
  odometry(10.1);
  ASSERT_EQ(push(10.05, 10.1, 0.2), "");
  EXPECT_FALSE(next(10.25));
  const auto rigid = next(10.31);
  ASSERT_TRUE(rigid);
  EXPECT_EQ(rigid->why, "");
  EXPECT_FALSE(rigid->whole);
  ASSERT_EQ(push(10.06, 10.31, 0.2), "");
  odometry(10.4);
  ASSERT_TRUE(next(10.32));
}

TEST_F(SensorQueueTest, drops_what_has_no_place_for_a_second_and_says_why) {
  odometry(10.0);
  ASSERT_EQ(push(10.5, 10.5), "");
  EXPECT_FALSE(next(11.4));
  const auto late = next(11.6);
  ASSERT_TRUE(late);
  EXPECT_NE(late->why.find("no transform leads from frame 'laser' and from 'base_link' to 'map'"),
            std::string::npos)
      << late->why;
}

TEST_F(SensorQueueTest, drops_the_first_of_too_many) {
  for (std::size_t i = 0; i < SensorQueue::kMost; ++i) ASSERT_EQ(push(10.0, 10.0), "");
  EXPECT_NE(push(10.0, 10.0), "");
}

TEST_F(SensorQueueTest, rejects_stamps_ahead_and_old) {
  EXPECT_NE(push(10.3, 10.0).find("ahead of this clock"), std::string::npos);
  EXPECT_NE(push(8.9, 10.0).find("s old"), std::string::npos);
  EXPECT_EQ(push(10.1, 10.0), "");
}

}  // namespace
}  // namespace navvi_perception::node
