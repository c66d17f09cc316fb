#include "look/ribbon.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/msg_conversion.hpp>

namespace navvi_rviz::look {
namespace {

constexpr double kLongestTangent = 0.6;  // m, from a corner to where its arc begins
constexpr double kStep = 0.15;           // rad, of an arc

Eigen::Vector2d left_of(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// The corner as an arc from `in` before it to `in` behind it, m. Directions have length 1.
void add_arc(const Eigen::Vector2d& corner, const Eigen::Vector2d& before,
             const Eigen::Vector2d& behind, double in, std::vector<Eigen::Vector2d>& line) {
  const double turn = std::atan2(left_of(before).dot(behind), before.dot(behind));
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kStep)));
  const double radius = in / std::tan(0.5 * std::abs(turn));
  const Eigen::Vector2d begin = corner - in * before;
  const Eigen::Vector2d inward = std::copysign(1.0, turn) * left_of(before);
  for (int i = 0; i <= steps; ++i) {
    const double angle = std::abs(turn) * i / steps;
    line.push_back(begin + radius * (std::sin(angle) * before + (1.0 - std::cos(angle)) * inward));
  }
}

std::vector<Eigen::Vector2d> without_repetition(const std::vector<Eigen::Vector2d>& line) {
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2d& point : line)
    if (points.empty() || (point - points.back()).norm() > 1e-3) points.push_back(point);
  return points;
}

/// To the left at each point, as long as keeps bands as wide in a bend as elsewhere.
std::vector<Eigen::Vector2d> sideways(const std::vector<Eigen::Vector2d>& line) {
  const bool closed = line.size() > 2 && (line.front() - line.back()).norm() < 1e-6;
  std::vector<Eigen::Vector2d> legs;
  for (std::size_t i = 1; i < line.size(); ++i)
    legs.push_back(left_of((line[i] - line[i - 1]).normalized()));
  std::vector<Eigen::Vector2d> sides;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector2d& before = i > 0 ? legs[i - 1] : closed ? legs.back() : legs[0];
    const Eigen::Vector2d& behind = i < legs.size() ? legs[i] : closed ? legs[0] : legs.back();
    const Eigen::Vector2d sum = before + behind;
    sides.push_back(2.0 * sum / std::max(sum.squaredNorm(), 1.0));
  }
  return sides;
}

}  // namespace

std_msgs::ColorRGBA color_msg(const Color& color) {
  std_msgs::ColorRGBA msg;
  msg.r = color.r;
  msg.g = color.g;
  msg.b = color.b;
  msg.a = 1.0F;
  return msg;
}

void add_triangle(const std::array<geometry_msgs::Point, 3>& corners, const Color& color,
                  visualization_msgs::Marker& marker) {
  marker.points.insert(marker.points.end(), corners.begin(), corners.end());
  marker.colors.push_back(color_msg(color));
}

void add_quad(const std::array<geometry_msgs::Point, 4>& corners, const Color& color,
              visualization_msgs::Marker& marker) {
  add_triangle({corners[0], corners[1], corners[2]}, color, marker);
  add_triangle({corners[0], corners[2], corners[3]}, color, marker);
}

std::vector<Eigen::Vector2d> rounded(const std::vector<Eigen::Vector2d>& line) {
  const std::vector<Eigen::Vector2d> points = without_repetition(line);
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> result{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d before = points[i] - points[i - 1], behind = points[i + 1] - points[i];
    const double in = std::min({kLongestTangent, 0.45 * before.norm(), 0.45 * behind.norm()});
    const double cosine = before.normalized().dot(behind.normalized());
    if (cosine > 0.999 || cosine < -0.999)
      result.push_back(points[i]);
    else
      add_arc(points[i], before.normalized(), behind.normalized(), in, result);
  }
  result.push_back(points.back());
  return result;
}

void add_ribbon(const std::vector<Eigen::Vector2d>& line, double from, double to, double height,
                const Color& color, visualization_msgs::Marker& marker) {
  if (line.size() < 2) return;
  const std::vector<Eigen::Vector2d> sides = sideways(line);
  const auto place = [&](std::size_t i, double distance) {
    return navvi_types::point_msg(line[i] + distance * sides[i], height);
  };
  for (std::size_t i = 1; i < line.size(); ++i)
    add_quad({place(i - 1, from), place(i, from), place(i, to), place(i - 1, to)}, color, marker);
}

void add_borders(const std::vector<Eigen::Vector2d>& line, double from, double to, double height,
                 const Color& color, visualization_msgs::Marker& marker) {
  add_ribbon(line, from, to, height, color, marker);
  add_ribbon(line, -to, -from, height, color, marker);
}

}  // namespace navvi_rviz::look
