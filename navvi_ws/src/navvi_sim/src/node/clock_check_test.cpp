#include "node/clock_check.hpp"

#include <gtest/gtest.h>

namespace navvi_sim::node {
namespace {

TEST(ClockCheck, T1_takes_its_own_late_message_for_no_other_clock) {
  for (const double late : {0.0, 0.02, 0.26, 2.0, 97.0})
    EXPECT_FALSE(is_another_clock("/sim_node", "/sim_node", 100.0 - late, 100.0)) << late;
}

TEST(ClockCheck, T1_tells_another_clock_by_a_jump_and_a_forged_name_by_one_ahead) {
  EXPECT_TRUE(is_another_clock("/play", "/sim_node", 3.0, 100.0));
  EXPECT_TRUE(is_another_clock("/play", "/sim_node", 100.3, 100.0));
  EXPECT_TRUE(is_another_clock("/sim_node", "/sim_node", 100.3, 100.0));
  EXPECT_FALSE(is_another_clock("/play", "/sim_node", 100.2, 100.0));
}

}  // namespace
}  // namespace navvi_sim::node
