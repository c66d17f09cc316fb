#include "tracks/tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_perception::tracks {
namespace {

class TrackerTest : public testing::Test {
 protected:
  /// One sighting of a thing of 0.3 m at each place.
  void look(double time, const std::vector<Eigen::Vector2d>& places) {
    std::vector<clusters::Cluster> clusters;
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector2d& place : places) {
      clusters.push_back({{points.size()}, place, 0.3, 0.5, 1.0});
      points.emplace_back(place.x(), place.y(), 1.0);
    }
    (void)tracker_.update(clusters, points, time, next_);
  }

  Tracker tracker_{TrackConfig()};
  std::uint32_t next_ = 1;
};

TEST_F(TrackerTest, tells_a_thing_after_its_third_sighting) {
  look(1.0, {{1.0, 1.0}});
  look(1.1, {{1.0, 1.0}});
  EXPECT_FALSE(tracker_.sure(tracker_.now()[0], 1.2));
  look(1.2, {{1.0, 1.0}});
  EXPECT_TRUE(tracker_.sure(tracker_.now()[0], 1.2));
  EXPECT_FALSE(tracker_.drives(tracker_.now()[0]));
  EXPECT_FALSE(tracker_.sure(tracker_.now()[0], 2.8)) << "its sensor is silent";
}

TEST_F(TrackerTest, two_that_pass_each_other_keep_their_numbers_and_velocities) {
  for (int i = 0; i <= 40; ++i) {
    const double x = 0.1 * i;
    look(1.0 + 0.1 * i, {{x, 0.0}, {4.0 - x, 0.8}});
  }
  ASSERT_EQ(tracker_.now().size(), 2U);
  EXPECT_EQ(next_, 3U);
  EXPECT_NEAR(tracker_.now()[0].velocity.x(), 1.0, 0.05);
  EXPECT_NEAR(tracker_.now()[1].velocity.x(), -1.0, 0.05);
  EXPECT_TRUE(tracker_.drives(tracker_.now()[0]));
}

TEST_F(TrackerTest, a_thing_out_of_sight_is_expected_for_a_second_and_then_gone) {
  for (int i = 0; i <= 20; ++i) look(1.0 + 0.1 * i, {{0.1 * i, 0.0}});
  look(3.8, {});
  ASSERT_EQ(tracker_.now().size(), 1U);
  EXPECT_NEAR(tracker_.now()[0].place.x(), 2.8, 0.1);
  look(4.2, {});
  EXPECT_TRUE(tracker_.now().empty());
}

TEST_F(TrackerTest, what_never_moved_settles_and_what_moved_stays_a_mover_when_it_waits) {
  for (int i = 0; i <= 80; ++i) {
    const double x = std::min(0.1 * i, 2.0);
    look(1.0 + 0.1 * i, {{x, 0.0}, {5.0, 5.0 + 0.02 * (i % 2)}});
  }
  EXPECT_FALSE(tracker_.now()[0].settled);
  EXPECT_TRUE(tracker_.now()[0].mover);
  EXPECT_FALSE(tracker_.drives(tracker_.now()[0]));
  EXPECT_TRUE(tracker_.now()[1].settled);
  EXPECT_FALSE(tracker_.now()[1].mover);
}

}  // namespace
}  // namespace navvi_perception::tracks
