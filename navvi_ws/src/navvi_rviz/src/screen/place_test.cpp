#include "screen/place.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_rviz::screen {
namespace {

const Eigen::Vector2d kPicture(1920.0, 1080.0);

/// One after another each lies in the picture, and over none before it or what is taken.
void expect_apart(const std::vector<Plate>& plates, const Eigen::Vector2d& picture,
                  std::vector<Rect> taken) {
  for (const Plate& plate : plates) {
    const auto corner = place(plate, picture, {taken, {}});
    ASSERT_TRUE(corner) << plate.anchor.transpose();
    const Rect mine(*corner, *corner + plate.size);
    EXPECT_TRUE(Rect(Eigen::Vector2d::Zero(), picture).contains(mine)) << plate.anchor.transpose();
    for (const Rect& other : taken)
      EXPECT_LE(mine.intersection(other).sizes().minCoeff(), 0.0) << plate.anchor.transpose();
    taken.push_back(mine);
  }
}

TEST(Place, plates_lie_inside_and_never_over_each_other_or_what_is_taken) {
  std::vector<Plate> plates;
  for (const double x : {-500.0, 0.0, 900.0, 1000.0, 5000.0})
    for (const double y : {-50.0, 100.0, 130.0, 2000.0})
      plates.push_back({{x, y}, {300.0, 50.0}, std::nullopt});
  expect_apart(plates, kPicture, {{Eigen::Vector2d(600.0, 0.0), Eigen::Vector2d(1300.0, 120.0)}});
}

TEST(Place, large_plates_in_a_low_picture_go_aside) {
  expect_apart({{{950.0, 300.0}, {280.0, 110.0}, std::nullopt},
                {{950.0, 280.0}, {740.0, 110.0}, std::nullopt},
                {{950.0, 400.0}, {310.0, 110.0}, std::nullopt}},
               {1920.0, 560.0},
               {{Eigen::Vector2d(500.0, 10.0), Eigen::Vector2d(1400.0, 260.0)},
                {Eigen::Vector2d(850.0, 290.0), Eigen::Vector2d(1060.0, 500.0)}});
}

TEST(Place, a_plate_without_room_beside_what_is_always_free_is_not_drawn) {
  const Rect most(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1800.0, 1080.0));
  const Plate plate{{900.0, 500.0}, {300.0, 50.0}, std::nullopt};
  EXPECT_FALSE(place(plate, kPicture, {{most}, {}}));
  EXPECT_TRUE(place(plate, kPicture, {{}, {most}})) << "where it rather would not be";
  const Rect half(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1800.0, 600.0));
  EXPECT_GT(place(plate, kPicture, {{}, {half}})->y(), 600.0);
}

TEST(Place, a_plate_alone_is_over_the_middle_of_its_place) {
  const auto corner = place({{960.0, 540.0}, {200.0, 40.0}, std::nullopt}, kPicture, {});
  EXPECT_DOUBLE_EQ(corner->x(), 860.0);
  EXPECT_LT(corner->y() + 40.0, 540.0);
}

TEST(Place, a_plate_that_went_aside_stays_there_while_what_drove_it_off_passes) {
  Plate plate{{960.0, 540.0}, {200.0, 40.0}, std::nullopt};
  const auto passing = [](double x) {
    return Rect(Eigen::Vector2d(x, 450.0), Eigen::Vector2d(x + 150.0, 600.0));
  };
  Eigen::Vector2d corner;
  int moves = 0;
  for (double x = 500.0; x < 1300.0; x += 5.0) {
    const Eigen::Vector2d now = *place(plate, kPicture, {{passing(x)}, {}});
    moves += x > 500.0 && !now.isApprox(corner) ? 1 : 0;
    corner = now;
    plate.before = corner - plate.anchor;
    EXPECT_FALSE(Rect(corner, corner + plate.size).intersects(passing(x)));
  }
  EXPECT_LE(moves, 4);
  EXPECT_DOUBLE_EQ(corner.x(), 860.0) << "there is room again";
}

TEST(EdgeArrow, is_there_only_for_what_is_outside) {
  EXPECT_FALSE(edge_arrow({0.0, 0.0, -5.0}, Eigen::Vector2d(960.0, 540.0), kPicture, 60.0));
  const auto right = edge_arrow({5.0, 0.0, -1.0}, Eigen::Vector2d(4000.0, 540.0), kPicture, 60.0);
  ASSERT_TRUE(right);
  EXPECT_NEAR(right->at.x(), 1860.0, 1e-6);
  EXPECT_NEAR(right->angle, 0.0, 1e-6);
}

TEST(EdgeArrow, points_down_to_what_is_behind_the_camera_and_to_its_side) {
  const auto behind = edge_arrow({0.0, 0.0, 5.0}, std::nullopt, kPicture, 60.0);
  ASSERT_TRUE(behind);
  EXPECT_NEAR(behind->at.y(), 1020.0, 1e-6);
  EXPECT_NEAR(behind->angle, -0.5 * M_PI, 1e-6);
  EXPECT_LT(edge_arrow({-5.0, 0.0, 5.0}, std::nullopt, kPicture, 60.0)->at.x(), 900.0);
}

TEST(WayAhead, is_counted_from_the_robot_on_a_leg_however_long_it_is) {
  const std::vector<Eigen::Vector3d> path = {{0, 0, 0}, {10, 0, 0}, {10, 5, 0}};
  EXPECT_TRUE(way_ahead(path, {4.0, 0.5}, 2.0)->isApprox(Eigen::Vector3d(6, 0, 0)));
  EXPECT_TRUE(way_ahead(path, {9.0, 0.5}, 2.0)->isApprox(Eigen::Vector3d(10, 1, 0)));
  EXPECT_TRUE(way_ahead(path, {10.0, 4.5}, 2.0)->isApprox(Eigen::Vector3d(10, 5, 0)));
  EXPECT_FALSE(way_ahead({}, {0.0, 0.0}, 2.0));
  EXPECT_TRUE(way_ahead({{1, 1, 0}}, {0.0, 0.0}, 2.0)->isApprox(Eigen::Vector3d(1, 1, 0)));
}

}  // namespace
}  // namespace navvi_rviz::screen
