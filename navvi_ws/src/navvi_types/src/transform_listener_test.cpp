#include "navvi_types/transform_listener.hpp"

#include <gtest/gtest.h>

namespace navvi_types {
namespace {

geometry_msgs::TransformStamped moved(const char* parent, const char* child, double x,
                                      double stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time(stamp);
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation.x = x;
  transform.transform.rotation.w = 1.0;
  return transform;
}

TEST(Newest, T4_is_not_what_was_once_refused_as_ahead_when_its_time_has_come) {
  ros::Time::init();
  tf2::BufferCore buffer;
  const auto x = [&](double now) -> std::optional<double> {
    const auto found = newest(buffer, "map", "base_link", ros::Time(now));
    return found ? std::optional(found->transform.translation.x) : std::nullopt;
  };
  EXPECT_EQ(x(10.0), std::nullopt) << "none came";
  buffer.setTransform(moved("map", "odom", 1.0, 10.0), "test", true);
  buffer.setTransform(moved("odom", "base_link", 2.0, 10.0), "test");
  EXPECT_EQ(x(10.05), 3.0);
  for (const double late : {0.0, 0.02, 0.04})
    buffer.setTransform(moved("odom", "base_link", 9.0, 11.0 + late), "test");
  EXPECT_EQ(x(10.05), std::nullopt);
  EXPECT_EQ(x(10.9), std::nullopt);
  buffer.setTransform(moved("odom", "base_link", 2.5, 10.9), "test");
  EXPECT_EQ(x(10.9), 3.5) << "the next one counts, and what is fixed is known still";
  EXPECT_EQ(x(10.7), 3.5) << "clocks and messages differ by less than 0.3 s";
}

/// A buffer that gets a localizer's and odometry's transforms as TransformListener gives them.
struct Placed {
  void take(const geometry_msgs::TransformStamped& one) {
    buffer.setTransform(one, "test");
    if (const auto held = place.at_the_stamp_of(one)) buffer.setTransform(*held, "test");
  }
  [[nodiscard]] std::optional<double> x(double time) const {
    if (!buffer.canTransform("map", "base_link", ros::Time(time))) return std::nullopt;
    const auto found = buffer.lookupTransform("map", "base_link", ros::Time(time));
    return found.transform.translation.x;
  }

  tf2::BufferCore buffer;
  HeldPlace place{"odom"};
};

TEST(HeldPlace, H5_serves_until_the_localizer_corrects_it_five_seconds_later) {
  Placed robot;
  for (int tick = 0; tick <= 600; ++tick) {  // 30 s
    const double now = 10.0 + 0.05 * tick;
    if (tick % 100 == 0) robot.take(moved("map", "odom", 1.0 + tick / 100, now));
    robot.take(moved("odom", "base_link", 0.0, now));
    ASSERT_EQ(robot.x(now), 1.0 + tick / 100) << now;
  }
  EXPECT_EQ(robot.x(34.95), 5.0) << "a scan of before the correction";
}

TEST(HeldPlace, H5_is_lost_when_the_localizer_has_missed_its_time_twice) {
  Placed robot;
  for (int tick = 0; tick <= 100; ++tick) {
    const double now = 10.0 + 0.1 * tick;
    if (tick <= 50) robot.take(moved("map", "odom", 1.0, now + 0.1));  // ahead, as amcl does
    robot.take(moved("odom", "base_link", 0.0, now));
    if (tick > 0) {
      EXPECT_EQ(robot.x(now).has_value(), now < 16.15) << now;
    }
  }
}

}  // namespace
}  // namespace navvi_types
