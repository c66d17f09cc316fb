#include "navvi_nav/telling.hpp"

#include <gtest/gtest.h>

namespace navvi_nav {
namespace {

Status following() {
  Status status;
  status.state = State::following;
  status.heading.waypoint = {3.0, 4.0};
  return status;
}

TEST(Telling, whatStaysTheSameIsToldTenTimesASecond) {
  Telling telling;
  int told = 0;
  for (int beat = 0; beat < 40; ++beat) told += telling.due(following(), 0.05 * beat) ? 1 : 0;
  EXPECT_EQ(told, 20);
}

TEST(Telling, anotherStateOrWayPointIsToldAtOnceAndOnce) {
  Telling telling;
  Status status = following();
  EXPECT_TRUE(telling.due(status, 1.0));
  status.heading.waypoint.x = 3.1;
  EXPECT_TRUE(telling.due(status, 1.01));
  EXPECT_FALSE(telling.due(status, 1.02));
  status.state = State::blocked;
  EXPECT_TRUE(telling.due(status, 1.03));
}

TEST(Telling, howFarItIsChangesWithoutHaste) {
  Telling telling;
  Status status = following();
  EXPECT_TRUE(telling.due(status, 1.0));
  status.heading.waypoint_distance = 2.0;
  EXPECT_FALSE(telling.due(status, 1.05));
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
