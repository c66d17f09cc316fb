#include "picture/markers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace navvi_feedback::picture {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

const std::vector<Eigen::Vector2d> kPath = {{0.0, 0.0}, {4.0, 0.0}, {4.0, -6.0}};

const std::string kPhrases = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/";

MarkerArray markers_of(const std::optional<Guidance>& guidance,
                       const std::vector<Eigen::Vector2d>& path,
                       const std::string& turn = "in 4 meters, 3 o'clock",
                       const std::string& language = "en") {
  return guide_markers(guidance, path, cues::Phrases(kPhrases + language + ".yaml"), turn,
                       Eigen::Vector2d(1.0, 2.0));
}

Guidance following() {
  Guidance guidance;
  guidance.state = Guidance::State::following;
  guidance.goal = {4.0, -6.0};
  guidance.waypoint = {4.0, 0.0};
  guidance.waypoint_distance = 4.0;
  guidance.waypoint_angle = guidance.steer_angle = M_PI / 2.0;
  guidance.turn_angle = M_PI / 2.0;
  return guidance;
}

using Names = std::set<std::string>;

Names shown(const MarkerArray& array) {
  Names result;
  for (const Marker& marker : array.markers)
    if (marker.action == Marker::ADD) result.insert(marker.ns + " " + std::to_string(marker.id));
  return result;
}

const Marker* find(const MarkerArray& array, const std::string& ns, int id) {
  for (const Marker& marker : array.markers) {
    if (marker.ns == ns && marker.id == id) return &marker;
  }
  return nullptr;
}

bool finite(const geometry_msgs::Point& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

double luminance(const std_msgs::ColorRGBA& color) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

double contrast(double one, double other) {
  return (std::max(one, other) + 0.05) / (std::min(one, other) + 0.05);
}

TEST(Markers, without_guidance_and_at_the_goal_everything_is_deleted) {
  Guidance arrived = following();
  arrived.state = Guidance::State::arrived;
  for (const auto& guidance : {std::optional<Guidance>{}, std::optional(Guidance{}),
                               std::optional(arrived)}) {
    const MarkerArray array = markers_of(guidance, kPath);
    EXPECT_EQ(array.markers.size(), markers_of(following(), kPath).markers.size());
    for (const Marker& marker : array.markers) EXPECT_EQ(marker.action, Marker::DELETE);
  }
}

TEST(Markers, show_the_goal_the_path_if_there_is_one_and_the_turn_if_there_is_one) {
  const Names goal = {"goal 0", "goal 1", "label 0", "stop 0"};
  Names way = goal;
  way.insert({"path 0", "path 1"});
  Names turn = way;
  turn.insert("turn 0");
  EXPECT_EQ(shown(markers_of(following(), {})), goal);
  EXPECT_EQ(shown(markers_of(following(), kPath, "")), turn) << "something else is to be done";
  turn.insert("label 1");
  EXPECT_EQ(shown(markers_of(following(), kPath)), turn);
  Guidance guidance = following();
  guidance.turn_angle = 0.17;
  EXPECT_EQ(shown(markers_of(guidance, kPath)), way) << "a slight bend";
  guidance = following();
  guidance.waypoint = guidance.goal;
  guidance.waypoint_is_goal = true;
  EXPECT_EQ(shown(markers_of(guidance, kPath)), way) << "before the goal";
  EXPECT_EQ(shown(markers_of(preview_of(kPath), kPath)), way);
}

TEST(Markers, every_marker_is_finite_and_drawable) {
  for (const Marker& marker : markers_of(following(), kPath).markers) {
    EXPECT_EQ(marker.header.frame_id, "map");
    EXPECT_EQ(marker.action, Marker::ADD) << marker.ns << marker.id;
    EXPECT_TRUE(finite(marker.pose.position));
    EXPECT_EQ(marker.pose.orientation.w, 1.0);
    EXPECT_EQ(marker.color.a, 1.0F);
    EXPECT_GT(marker.scale.x + marker.scale.z, 0.0);
    for (const geometry_msgs::Point& point : marker.points) EXPECT_TRUE(finite(point));
  }
}

TEST(Markers, the_line_is_the_path_with_a_wider_edge_below) {
  const MarkerArray array = markers_of(following(), kPath);
  const Marker& edge = *find(array, "path", 0);
  const Marker& line = *find(array, "path", 1);
  ASSERT_EQ(line.points.size(), kPath.size());
  EXPECT_GT(edge.scale.x, line.scale.x);
  EXPECT_LT(edge.points[0].z, line.points[0].z);
  EXPECT_EQ(line.points[2].y, -6.0);
}

TEST(Markers, the_line_and_the_goal_pass_three_to_one_on_rviz_grey_and_the_line_on_its_edge) {
  const MarkerArray array = markers_of(following(), kPath);
  std_msgs::ColorRGBA grey;
  grey.r = grey.g = grey.b = 48.0F / 255.0F;
  const double line = luminance(find(array, "path", 1)->color);
  EXPECT_GE(contrast(line, luminance(grey)), 3.0);
  EXPECT_GE(contrast(line, luminance(find(array, "path", 0)->color)), 3.0);
  EXPECT_GE(contrast(luminance(find(array, "goal", 0)->color), luminance(grey)), 3.0);
}

TEST(Markers, the_turn_shows_its_words_and_points_along_the_next_leg) {
  const MarkerArray array = markers_of(following(), kPath);
  EXPECT_EQ(find(array, "label", 1)->text, "in 4 meters, 3 o'clock");
  const Marker& arrow = *find(array, "turn", 0);
  ASSERT_EQ(arrow.points.size(), 2u);
  EXPECT_NEAR(arrow.points[1].x, arrow.points[0].x, 1e-9);
  EXPECT_LT(arrow.points[1].y, arrow.points[0].y);
}

TEST(Markers, speak_the_language_of_the_session) {
  EXPECT_EQ(find(markers_of(following(), kPath), "label", 0)->text, "GOAL");
  EXPECT_EQ(find(markers_of(following(), kPath, "", "es"), "label", 0)->text, "META");
}

TEST(Markers, the_arrow_shows_two_corners_that_are_said_as_one_turn_as_one) {
  const std::vector<Eigen::Vector2d> path = {{0.0, 0.0}, {3.5, 0.0}, {4.0, -0.5}, {4.0, -6.0}};
  Guidance guidance = following();
  guidance.waypoint = path[1];
  const Marker arrow = *find(markers_of(guidance, path), "turn", 0);
  ASSERT_EQ(arrow.points.size(), 2u);
  EXPECT_NEAR(arrow.points[1].x, 3.5, 1e-9);
  EXPECT_LT(arrow.points[1].y, -1.0);
}

TEST(Markers, everything_stands_on_the_floor_of_the_map) {
  Guidance guidance = following();
  const MarkerArray flat = markers_of(guidance, kPath);
  guidance.floor = -5.0;
  const MarkerArray sunk = markers_of(guidance, kPath);
  for (std::size_t i = 0; i < flat.markers.size(); ++i) {
    if (flat.markers[i].action != Marker::ADD) continue;
    EXPECT_DOUBLE_EQ(sunk.markers[i].pose.position.z, flat.markers[i].pose.position.z - 5.0);
  }
}

TEST(Markers, a_preview_ends_at_the_end_of_its_path) {
  const MarkerArray array = markers_of(preview_of(kPath), kPath);
  EXPECT_EQ(find(array, "path", 1)->points.size(), kPath.size());
  EXPECT_DOUBLE_EQ(find(array, "goal", 0)->pose.position.y, kPath.back().y());
}

}  // namespace
}  // namespace navvi_feedback::picture
