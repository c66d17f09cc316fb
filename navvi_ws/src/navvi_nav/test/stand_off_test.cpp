#include "navvi_nav/stand_off.hpp"

#include <gtest/gtest.h>

namespace navvi_nav {
namespace {

MovingThing forklift(double yaw) { return {{7, {5, 0}, 1.35, {}}, yaw, 2.4, 1.1}; }

/// \returns s after which it is due, asked every 0.5 s; 100 if never
double due_after(StandOff& stand_off, const MovingThing& blocker, double from = 0.0) {
  for (double time = 0.0; time < 100.0; time += 0.5) {
    stand_off.update(from + time, {2, 0.3}, blocker);
    if (stand_off.due()) return time;
  }
  return 100.0;
}

TEST(StandOff, is_noticed_after_a_while_if_the_thing_faces_the_robot) {
  StandOff stand_off{StandOffConfig{}};
  EXPECT_EQ(due_after(stand_off, forklift(M_PI)), 10.0);
  EXPECT_EQ(stand_off.due(), 7U);
  stand_off.reset();
  EXPECT_EQ(due_after(stand_off, forklift(0.0)), 100.0);
  EXPECT_EQ(due_after(stand_off, forklift(M_PI / 2)), 100.0);
}

TEST(StandOff, begins_anew_when_the_way_was_free_or_another_closes_it) {
  StandOff stand_off{StandOffConfig{}};
  stand_off.update(0.0, {2, 0}, forklift(M_PI));
  stand_off.update(9.0, {2, 0}, std::nullopt);
  stand_off.update(9.5, {2, 0}, forklift(M_PI));
  stand_off.update(18.0, {2, 0}, forklift(M_PI));
  EXPECT_FALSE(stand_off.due());
  MovingThing other = forklift(M_PI);
  other.cylinder.id = 8;
  stand_off.update(19.0, {2, 0}, other);
  stand_off.update(21.0, {2, 0}, other);
  EXPECT_FALSE(stand_off.due());
}

TEST(StandOff, never_is_due_if_no_time_is_set) {
  StandOffConfig config;
  config.make_room_after = 0.0;
  StandOff stand_off{config};
  EXPECT_EQ(due_after(stand_off, forklift(M_PI)), 100.0);
}

TEST(StandOff, gives_the_thing_time_to_pass_and_then_lets_it_be) {
  StandOff stand_off{StandOffConfig{}};
  for (int time = 0; time < 2; ++time) {
    ASSERT_EQ(due_after(stand_off, forklift(M_PI)), 10.0);
    stand_off.went_aside(100.0, 7);
    EXPECT_FALSE(stand_off.due());
    EXPECT_EQ(stand_off.aside_for(119.0), 7U);
    EXPECT_FALSE(stand_off.aside_for(121.0));
  }
  EXPECT_EQ(due_after(stand_off, forklift(M_PI)), 100.0);
  stand_off.forget();
  EXPECT_EQ(due_after(stand_off, forklift(M_PI)), 10.0);
}

TEST(StandOff, wants_the_ground_before_the_thing) {
  const auto ground = ground_needed(forklift(M_PI));
  const auto needs = [&](Point place) {
    return std::any_of(ground.begin(), ground.end(), [place](const Cylinder& one) {
      return distance(place, one.center) < one.radius;
    });
  };
  EXPECT_TRUE(needs({2, 0.5}));
  EXPECT_TRUE(needs({-3, 0}));
  EXPECT_FALSE(needs({2, 1.2}));
  EXPECT_FALSE(needs({7, 0}));
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
