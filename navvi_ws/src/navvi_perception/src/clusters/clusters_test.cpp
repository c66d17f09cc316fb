#include "clusters/clusters.hpp"

#include <gtest/gtest.h>

namespace navvi_perception::clusters {
namespace {

TEST(Clusters, finds_none_in_nothing) {
  EXPECT_TRUE(clusters_of({}, 0.3, 0.2, {0.0, 0.0}).empty());
}

TEST(Clusters, joins_near_points_and_leaves_a_far_one_alone) {
  const std::vector<Eigen::Vector3d> points{{2.0, 0.0, 0.1}, {2.0, 0.2, 0.3},  {2.0, 0.4, 0.1},
                                            {5.0, 5.0, 0.1}, {-3.0, 0.0, 0.1}, {-3.1, 0.0, 0.1},
                                            {-3.2, 0.0, 0.1}};
  const auto found = clusters_of(points, 0.3, 0.1, {0.0, 0.0});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].members, (std::vector<std::size_t>{6, 5, 4}));
  EXPECT_EQ(found[1].members.size(), 3U);
  EXPECT_DOUBLE_EQ(found[1].length, 0.4);
  EXPECT_DOUBLE_EQ(found[1].top, 0.3);
  EXPECT_EQ(found[2].members, std::vector<std::size_t>{3});
}

TEST(Clusters, puts_the_cylinder_behind_the_surface_that_was_seen) {
  const std::vector<Eigen::Vector3d> points{{2.0, 0.0, 0.1}, {2.0, 0.01, 0.1}, {2.0, -0.01, 0.1}};
  const auto found = clusters_of(points, 0.3, 0.25, {0.0, 0.0});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(found[0].radius, 0.25);
  EXPECT_NEAR(found[0].centre.x(), 2.24, 1e-9);
}

TEST(StandingThings, keep_their_numbers_while_they_grow_and_others_come) {
  StandingThings things;
  std::uint32_t next = 1;
  (void)things.update({{0, 0}, {1, 0}, {40, 40}}, 5, next);
  ASSERT_EQ(things.now().size(), 2U);
  const std::uint32_t first = things.now()[0].id;
  (void)things.update({{0, 0}, {1, 0}, {6, 0}, {12, 0}, {-80, -80}}, 5, next);
  ASSERT_EQ(things.now().size(), 2U);
  EXPECT_EQ(things.now()[0].id, first);
  EXPECT_EQ(things.now()[0].cells.size(), 4U);
  EXPECT_GT(things.now()[1].id, 2U);
}

TEST(StandingThings, of_one_that_parts_the_larger_keeps_the_number) {
  StandingThings things;
  std::uint32_t next = 1;
  (void)things.update({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}, 1, next);
  (void)things.update({{0, 0}, {2, 0}, {3, 0}, {4, 0}}, 1, next);
  ASSERT_EQ(things.now().size(), 2U);
  EXPECT_EQ(things.now()[0].id, 1U);
  EXPECT_EQ(things.now()[0].cells.size(), 3U);
  EXPECT_EQ(things.now()[1].id, 2U);
}

}  // namespace
}  // namespace navvi_perception::clusters
