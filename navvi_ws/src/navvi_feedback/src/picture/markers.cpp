#include "picture/markers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>

namespace navvi_feedback::picture {
namespace {

using visualization_msgs::Marker;

struct Color {
  float r, g, b;
};
// Contrast on RViz's grey (48, 48, 48), by WCAG's formula: 3.8, 3.5 and 12.7 to 1; purple on
// white 3.5.
constexpr Color kPurple{0.80F, 0.30F, 1.00F};
constexpr Color kRed{1.00F, 0.15F, 0.15F};
constexpr Color kWhite{1.00F, 1.00F, 1.00F};

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

geometry_msgs::Point at(const Eigen::Vector2d& place, double height) {
  geometry_msgs::Point point;
  point.x = place.x();
  point.y = place.y();
  point.z = height;
  return point;
}

Marker strip(const char* ns, int id, const std::vector<Eigen::Vector2d>& places, double width,
             double height, const Color& color) {
  Marker marker = shape(ns, id, Marker::LINE_STRIP, color);
  marker.scale.x = width;
  for (const Eigen::Vector2d& place : places) marker.points.push_back(at(place, height));
  return marker;
}

Marker label(int id, const std::string& text, const Eigen::Vector2d& place, double height,
             double size) {
  Marker marker = shape("label", id, Marker::TEXT_VIEW_FACING, kWhite);
  marker.text = text;
  marker.pose.position = at(place, height);
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

void add_path(const MarkersConfig& config, const std::vector<Eigen::Vector2d>& path,
              std::vector<Marker>& markers) {
  if (path.size() < 2) return;
  markers[0] =
      strip("path", 0, path, config.path_width + 2.0 * config.outline, config.path_height, kWhite);
  markers[1] = strip("path", 1, path, config.path_width, config.path_height + kAbove, kPurple);
}

void add_goal(const MarkersConfig& config, const Eigen::Vector2d& goal, const cues::Phrases& words,
              std::vector<Marker>& markers) {
  Marker pole = shape("goal", 0, Marker::CYLINDER, kRed);
  pole.pose.position = at(goal, config.goal_height / 2.0);
  pole.scale.x = pole.scale.y = 0.5;
  pole.scale.z = config.goal_height;
  markers[2] = pole;
  markers[3] = strip("goal", 1, ring(goal, config.goal_radius), 0.15, config.path_height, kWhite);
  markers[4] = label(0, words.picture().at("plate_goal"), goal,
                     config.goal_height + config.label_height, config.label_height * 1.3);
}

void add_turn(const MarkersConfig& config, const Guidance& guidance,
              const std::vector<Eigen::Vector2d>& path, const std::string& words,
              std::vector<Marker>& markers) {
  const std::optional<Eigen::Vector2d> course = course_after(path, guidance);
  if (guidance.waypoint_is_goal || !course || std::abs(guidance.turn_angle) < config.slight ||
      !std::isfinite(guidance.waypoint_distance))
    return;
  Marker arrow = shape("turn", 0, Marker::ARROW, kWhite);
  arrow.points = {at(guidance.waypoint, 0.5), at(guidance.waypoint + 1.4 * *course, 0.5)};
  arrow.scale.x = 0.25;
  arrow.scale.y = 0.6;
  arrow.scale.z = 0.6;
  markers[5] = arrow;
  if (!words.empty())
    markers[6] = label(1, words, guidance.waypoint, 1.8, 0.6 * config.label_height);
}

}  // namespace

void MarkersConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(path_width, "path_width", Range{0.05, 1.0}, "m", "width of the path's line");
  visit(outline, "outline", Range{0.0, 0.5}, "m", "width of the white edge on each side of it");
  visit(path_height, "path_height", Range{0.0, 1.0}, "m", "of the line above the floor");
  visit(goal_height, "goal_height", Range{0.5, 10.0}, "m", "height of the goal's pole");
  visit(goal_radius, "goal_radius", Range{0.1, 5.0}, "m",
        "of the ring within which the goal is reached");
  visit(slight, "slight", Range{0.0, 1.6}, "rad", "smallest turn of a corner that is shown as a turn");
  visit(label_height, "label_height", Range{0.1, 3.0}, "m", "height of the letters");
}

visualization_msgs::MarkerArray guide_markers(const MarkersConfig& config,
                                              const std::optional<Guidance>& guidance,
                                              const std::vector<Eigen::Vector2d>& path,
                                              const cues::Phrases& words,
                                              const std::string& turn) {
  visualization_msgs::MarkerArray array;
  std::vector<Marker>& markers = array.markers;
  markers = {absent("path", 0),  absent("path", 1), absent("goal", 0), absent("goal", 1),
             absent("label", 0), absent("turn", 0), absent("label", 1)};
  if (!guidance || !guidance->leads()) return array;
  add_path(config, path, markers);
  add_goal(config, guidance->goal, words, markers);
  add_turn(config, *guidance, path, turn, markers);
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
