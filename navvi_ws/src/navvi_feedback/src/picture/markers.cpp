#include "picture/markers.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <navvi_types/angles.hpp>
#include <navvi_types/msg_conversion.hpp>

namespace navvi_feedback::picture {
namespace {

using navvi_types::point_msg;
using visualization_msgs::Marker;

struct Color {
  float r, g, b;
};
// Contrast on RViz's grey (48, 48, 48), by WCAG's formula: 3.8, 3.5 and 12.7 to 1; purple on
// white 3.5.
constexpr Color kPurple{0.80F, 0.30F, 1.00F};
constexpr Color kRed{1.00F, 0.15F, 0.15F};
constexpr Color kWhite{1.00F, 1.00F, 1.00F};

constexpr double kPathWidth = 0.22;   // m
constexpr double kOutline = 0.08;     // m, of the path, on each side
constexpr double kPathHeight = 0.08;  // m, above the floor, so that it is not in it
constexpr double kGoalHeight = 2.5;   // m
constexpr double kGoalRadius = 1.0;   // m
constexpr double kStopRadius = 0.4;   // m, about as the robot
constexpr double kStopHeight = 0.5;   // m, as its top, which would hide what lies on the floor
constexpr double kSlight = 0.26;      // rad, about half an hour on the clock: no arrow
constexpr double kLabelHeight = 0.7;  // m, of the letters
constexpr int kRingPoints = 48;
constexpr double kAbove =
    0.1;  // m, of the line over its edge: less, and a far camera mixes the two

Marker absent(const char* ns, int id) {
  Marker marker;
  marker.header.frame_id = "map";
  marker.ns = ns;
  marker.id = id;
  marker.action = Marker::DELETE;
  marker.pose.orientation.w = 1.0;
  return marker;
}

Marker shape(const char* ns, int id, int type, const Color& color) {
  Marker marker = absent(ns, id);
  marker.action = Marker::ADD;
  marker.type = type;
  marker.color.r = color.r;
  marker.color.g = color.g;
  marker.color.b = color.b;
  marker.color.a = 1.0F;
  return marker;
}

Marker strip(const char* ns, int id, const std::vector<Eigen::Vector2d>& places, double width,
             double height, const Color& color) {
  Marker marker = shape(ns, id, Marker::LINE_STRIP, color);
  marker.scale.x = width;
  for (const Eigen::Vector2d& place : places) marker.points.push_back(point_msg(place, height));
  return marker;
}

Marker label(int id, const std::string& text, const Eigen::Vector2d& place, double height,
             double size) {
  Marker marker = shape("label", id, Marker::TEXT_VIEW_FACING, kWhite);
  marker.text = text;
  marker.pose.position = point_msg(place, height);
  marker.scale.z = size;
  return marker;
}

std::vector<Eigen::Vector2d> ring(const Eigen::Vector2d& center, double radius) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i <= kRingPoints; ++i) {
    const double angle = 2.0 * navvi_types::kPi * i / kRingPoints;
    places.push_back(center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return places;
}

/// Where the path leads from the way-point on, by the turn that is said, as a unit vector.
std::optional<Eigen::Vector2d> course_after(const std::vector<Eigen::Vector2d>& path,
                                            const Guidance& guidance) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if ((path[i] - guidance.waypoint).norm() < (path[nearest] - guidance.waypoint).norm())
      nearest = i;
  }
  if (nearest == 0) return std::nullopt;
  const Eigen::Vector2d leg = path[nearest] - path[nearest - 1];
  return Eigen::Rotation2Dd(-guidance.turn_angle) * leg.normalized();
}

void add_path(const std::vector<Eigen::Vector2d>& path, std::vector<Marker>& markers) {
  if (path.size() < 2) return;
  markers[0] = strip("path", 0, path, kPathWidth + 2.0 * kOutline, kPathHeight, kWhite);
  markers[1] = strip("path", 1, path, kPathWidth, kPathHeight + kAbove, kPurple);
}

void add_goal(const Eigen::Vector2d& goal, const cues::Phrases& words,
              std::vector<Marker>& markers) {
  Marker pole = shape("goal", 0, Marker::CYLINDER, kRed);
  pole.pose.position = point_msg(goal, kGoalHeight / 2.0);
  pole.scale.x = pole.scale.y = 0.5;
  pole.scale.z = kGoalHeight;
  markers[2] = pole;
  markers[3] = strip("goal", 1, ring(goal, kGoalRadius), 0.15, kPathHeight, kWhite);
  markers[4] = label(0, words.picture().at("plate_goal"), goal, kGoalHeight + kLabelHeight,
                     kLabelHeight * 1.3);
}

void add_turn(const Guidance& guidance, const std::vector<Eigen::Vector2d>& path,
              const std::string& words, std::vector<Marker>& markers) {
  const std::optional<Eigen::Vector2d> course = course_after(path, guidance);
  if (guidance.waypoint_is_goal || !course || std::abs(guidance.turn_angle) < kSlight ||
      !std::isfinite(guidance.waypoint_distance))
    return;
  Marker arrow = shape("turn", 0, Marker::ARROW, kWhite);
  arrow.points = {point_msg(guidance.waypoint, 0.5),
                  point_msg(guidance.waypoint + 1.4 * *course, 0.5)};
  arrow.scale.x = 0.25;
  arrow.scale.y = 0.6;
  arrow.scale.z = 0.6;
  markers[5] = arrow;
  if (!words.empty()) markers[6] = label(1, words, guidance.waypoint, 1.8, 0.6 * kLabelHeight);
}

}  // namespace

visualization_msgs::MarkerArray guide_markers(const std::optional<Guidance>& guidance,
                                              const std::vector<Eigen::Vector2d>& path,
                                              const cues::Phrases& words, const std::string& turn,
                                              const std::optional<Eigen::Vector2d>& stop) {
  visualization_msgs::MarkerArray array;
  std::vector<Marker>& markers = array.markers;
  markers = {absent("path", 0),  absent("path", 1), absent("goal", 0), absent("goal", 1),
             absent("label", 0), absent("turn", 0), absent("label", 1), absent("stop", 0)};
  if (!guidance || !guidance->leads()) return array;
  add_path(path, markers);
  add_goal(guidance->goal, words, markers);
  add_turn(*guidance, path, turn, markers);
  if (stop) markers[7] = strip("stop", 0, ring(*stop, kStopRadius), 0.1, kStopHeight, kWhite);
  for (Marker& marker : markers) marker.pose.position.z += guidance->floor;
  return array;
}

Guidance preview_of(const std::vector<Eigen::Vector2d>& path) {
  Guidance guidance;
  guidance.state = Guidance::State::following;
  guidance.goal = guidance.waypoint = path.back();
  guidance.waypoint_is_goal = true;
  return guidance;
}

void stamp(visualization_msgs::MarkerArray& markers, const ros::Time& time) {
  for (Marker& marker : markers.markers) marker.header.stamp = time;
}

}  // namespace navvi_feedback::picture
