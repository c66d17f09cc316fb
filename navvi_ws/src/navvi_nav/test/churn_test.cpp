#include "navvi_nav/churn.hpp"

#include <gtest/gtest.h>

#include "navvi_nav/interest.hpp"

namespace navvi_nav {
namespace {

TEST(Churn, counts_what_moved_aside_of_the_next_twenty_metres) {
  const Path path{{0, 0}, {10, 0}, {10, 5}};
  EXPECT_DOUBLE_EQ(Churn::moved(path, path), 0.0);
  EXPECT_DOUBLE_EQ(Churn::moved(path, {{0, 0}, {10, 0.4}, {10, 5}}), 0.0);
  EXPECT_NEAR(Churn::moved(path, {{0, 0}, {10, 0}, {15, 0}}), 4.5, 0.3);
  EXPECT_NEAR(Churn::moved(path, {}), 15.0, 1e-9);
  EXPECT_NEAR(Churn::moved({{0, 0}, {90, 0}}, {{0, 3}, {90, 3}}), 20.0, 1e-9);
  EXPECT_DOUBLE_EQ(Churn::moved({}, path), 0.0);
  EXPECT_DOUBLE_EQ(Churn::moved({{1, 1}, {1, 1}}, path), 0.0);
}

TEST(Churn, forgets_after_a_minute) {
  Churn churn;
  churn.add(10.0, 3.0);
  churn.add(40.0, 4.0);
  EXPECT_DOUBLE_EQ(churn.per_minute(50.0), 7.0);
  EXPECT_DOUBLE_EQ(churn.per_minute(80.0), 4.0);
  EXPECT_DOUBLE_EQ(churn.per_minute(200.0), 0.0);
  churn.reset();
  EXPECT_DOUBLE_EQ(churn.per_minute(45.0), 0.0);
}

TEST(Interest, is_in_places_within_the_ellipse_that_were_left) {
  Interest interest;
  const Cylinder hole{1, {5, 2}, 0.5, {}};
  const auto better = [&](double length, const std::vector<Cylinder>& now) {
    return interest.better_way({0, 0}, {10, 0}, length, now, 0.1, 0.5);
  };
  EXPECT_FALSE(better(12.0, {}));
  interest.searched({hole});
  EXPECT_FALSE(better(12.0, {hole}));
  EXPECT_TRUE(better(12.0, {}));
  EXPECT_FALSE(better(9.9, {}));  // nothing is shorter than straight on
  Cylinder moved = hole;
  moved.center.y += 0.05;
  EXPECT_FALSE(better(12.0, {moved}));
  moved.center.y += 0.2;
  EXPECT_TRUE(better(12.0, {moved}));
  moved = hole;
  moved.radius = 0.3;
  EXPECT_TRUE(better(12.0, {moved}));
  interest.searched({{1, {5, 7}, 0.5, {}}});
  EXPECT_FALSE(better(12.0, {}));
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
