#include "guide/path_instability.hpp"

#include <gtest/gtest.h>

namespace navvi_nav::guide {
namespace {

TEST(PathInstability, counts_what_moved_aside_of_the_next_twenty_metres) {
  const Path path{{0, 0}, {10, 0}, {10, 5}};
  EXPECT_DOUBLE_EQ(PathInstability::moved(path, path), 0.0);
  EXPECT_DOUBLE_EQ(PathInstability::moved(path, {{0, 0}, {10, 0.4}, {10, 5}}), 0.0);
  EXPECT_NEAR(PathInstability::moved(path, {{0, 0}, {10, 0}, {15, 0}}), 4.5, 0.3);
  EXPECT_NEAR(PathInstability::moved(path, {}), 15.0, 1e-9);
  EXPECT_NEAR(PathInstability::moved({{0, 0}, {90, 0}}, {{0, 3}, {90, 3}}), 20.0, 1e-9);
  EXPECT_DOUBLE_EQ(PathInstability::moved({}, path), 0.0);
  EXPECT_DOUBLE_EQ(PathInstability::moved({{1, 1}, {1, 1}}, path), 0.0);
}

TEST(PathInstability, forgets_after_a_minute) {
  PathInstability instability;
  instability.add(10.0, 3.0);
  instability.add(40.0, 4.0);
  EXPECT_DOUBLE_EQ(instability.per_minute(50.0), 7.0);
  EXPECT_DOUBLE_EQ(instability.per_minute(80.0), 4.0);
  EXPECT_DOUBLE_EQ(instability.per_minute(200.0), 0.0);
  instability.reset();
  EXPECT_DOUBLE_EQ(instability.per_minute(45.0), 0.0);
}

}  // namespace
}  // namespace navvi_nav::guide
