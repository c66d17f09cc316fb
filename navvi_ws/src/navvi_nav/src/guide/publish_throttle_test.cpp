#include "guide/publish_throttle.hpp"

#include <gtest/gtest.h>

namespace navvi_nav::guide {
namespace {

Guidance following() {
  Guidance status;
  status.state = Guidance::State::following;
  status.waypoint = {3.0, 4.0};
  return status;
}

TEST(PublishThrottle, publishes_what_stays_the_same_ten_times_a_second) {
  PublishThrottle throttle;
  int published = 0;
  for (int beat = 0; beat < 40; ++beat) published += throttle.due(following(), 0.05 * beat) ? 1 : 0;
  EXPECT_EQ(published, 20);
}

TEST(PublishThrottle, publishes_another_state_or_way_point_at_once_and_once) {
  PublishThrottle throttle;
  Guidance status = following();
  EXPECT_TRUE(throttle.due(status, 1.0));
  status.waypoint.x() = 3.1;
  EXPECT_TRUE(throttle.due(status, 1.01));
  EXPECT_FALSE(throttle.due(status, 1.02));
  status.state = Guidance::State::blocked;
  EXPECT_TRUE(throttle.due(status, 1.03));
}

TEST(PublishThrottle, does_not_hurry_for_another_distance) {
  PublishThrottle throttle;
  Guidance status = following();
  EXPECT_TRUE(throttle.due(status, 1.0));
  status.waypoint_distance = 2.0;
  EXPECT_FALSE(throttle.due(status, 1.05));
}

TEST(MeshThrottle, publishes_a_large_mesh_less_often) {
  MeshThrottle throttle(0.5);
  EXPECT_TRUE(throttle.due(0.0));
  EXPECT_TRUE(throttle.due(0.1));  // none was published yet
  throttle.published(100, 1.0);
  EXPECT_FALSE(throttle.due(1.4));
  EXPECT_TRUE(throttle.due(1.5));
  throttle.published(8000, 2.0);
  EXPECT_FALSE(throttle.due(3.9));
  EXPECT_TRUE(throttle.due(4.0));
}

}  // namespace
}  // namespace navvi_nav::guide
