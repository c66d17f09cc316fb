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

}  // namespace
}  // namespace navvi_types
