#include <gtest/gtest.h>

#include "door.hpp"

namespace navvi_nav::bake {
namespace {

TEST(Doors, at_any_angle_pass_a_robot_3_cm_narrower_and_none_that_is_wider) {
  expect_doors_judged_by_width(0, 700);
}

}  // namespace
}  // namespace navvi_nav::bake
