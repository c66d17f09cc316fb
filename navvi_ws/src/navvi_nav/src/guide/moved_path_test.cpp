#include "guide/moved_path.hpp"

#include <gtest/gtest.h>

namespace navvi_nav::guide {
namespace {

TEST(MovedPath, counts_what_moved_aside_of_the_next_twenty_metres) {
  const Path path{{0, 0}, {10, 0}, {10, 5}};
  EXPECT_DOUBLE_EQ(moved_length(path, path), 0.0);
  EXPECT_DOUBLE_EQ(moved_length(path, {{0, 0}, {10, 0.4}, {10, 5}}), 0.0);
  EXPECT_NEAR(moved_length(path, {{0, 0}, {10, 0}, {15, 0}}), 4.5, 0.3);
  EXPECT_NEAR(moved_length(path, {}), 15.0, 1e-9);
  EXPECT_NEAR(moved_length({{0, 0}, {90, 0}}, {{0, 3}, {90, 3}}), 20.0, 1e-9);
  EXPECT_DOUBLE_EQ(moved_length({}, path), 0.0);
  EXPECT_DOUBLE_EQ(moved_length({{1, 1}, {1, 1}}, path), 0.0);
}

}  // namespace
}  // namespace navvi_nav::guide
