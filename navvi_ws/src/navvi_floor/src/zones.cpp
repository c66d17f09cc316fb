#include "navvi_floor/zones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <navvi_config/reader.hpp>
#include <navvi_types/spoken.hpp>

namespace navvi_floor {
namespace {

using Kind = navvi_types::ZoneState::Kind;

constexpr std::size_t kMostZones = 200, kMostCorners = 100;
constexpr double kBrakes = 0.75 * navvi_types::kBrakes;  // m/s^2
constexpr double kReacts = 0.3;  // s, from the pose to the brakes
constexpr double kLeaves = 0.2;  // m/s, out of a closed zone
constexpr double kTold = 0.25;   // m/s; a zone that leaves less is told

[[noreturn]] void reject(const std::string& file, const YAML::Node& at, const std::string& what) {
  throw navvi_config::ConfigError(file + ", line " + std::to_string(at.Mark().line + 1) + ": " +
                                  what + ".");
}

/// Each edge of the polygon, as work(from, to).
template <typename Work>
void for_each_edge(const std::vector<Point>& corners, const Work& work) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    work(corners[i], corners[(i + 1) % corners.size()]);
}

bool edges_cross(const std::vector<Point>& corners) {
  const auto parts = [](Point a, Point b, Point c, Point d) {
    return cross(b - a, c - a) * cross(b - a, d - a) < 0.0;
  };
  bool found = false;
  for_each_edge(corners, [&](Point a, Point b) {
    for_each_edge(corners, [&](Point c, Point d) {
      found = found || (parts(a, b, c, d) && parts(c, d, a, b));
    });
  });
  return found;
}

Zone read_zone(const std::string& file, const YAML::Node& item) {
  constexpr double kFar = navvi_types::kFarthest;
  Zone zone;
  std::string kind;
  std::vector<double> numbers;
  navvi_config::read_fields(
      [&](navvi_config::Visitor& visit) {
        visit(zone.name, "name", navvi_config::Any{}, "", "as it is spoken");
        visit(kind, "kind", navvi_config::OneOf{{"keep_out", "slow", "rack"}}, "", "its rule");
        visit(zone.speed, "speed", navvi_config::Range{0.1, 3.0}, "m/s", "the most in a slow zone");
        visit(numbers, "corners", navvi_config::Range{-kFar, kFar}, "m", "x, y of each, in map");
      },
      item, file);
  if (kind.empty()) reject(file, item, "a zone lacks \"kind\"; it must be keep_out, slow or rack");
  zone.kind = navvi_types::from_word<Kind>(kind).value();
  if ((zone.kind == Kind::slow) != (zone.speed > 0.0))
    reject(file, item, "\"speed\" (m/s) belongs to each slow zone, and to no other");
  if (!navvi_types::is_place_name(zone.name))
    reject(file, item,
           "\"name\" cannot be spoken; allowed are letters and digits, in words of at most 20 bytes "
           "with one blank between two, at most 40 bytes in all");
  if (numbers.size() % 2 != 0 || numbers.size() < 6 || numbers.size() > 2 * kMostCorners)
    reject(file, item,
           "\"corners\" must be x and y of 3 to 100 corners, such as [0, 0, 4, 0, 4, 2]");
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    zone.corners.push_back({numbers[i], numbers[i + 1]});
  if (edges_cross(zone.corners))
    reject(file, item,
           "the lines between the \"corners\" of \"" + zone.name +
               "\" cross; allowed are corners in their order round the zone");
  return zone;
}

double distance_to_edges(const Zone& zone, Point point) {
  double least = std::numeric_limits<double>::infinity();
  for_each_edge(zone.corners, [&](Point a, Point b) {
    least = std::min(least, distance(point, nearest_on_segment(point, a, b)));
  });
  return least;
}

/// m/s, from which a robot has braked to `end` after `gap`, m.
double most_before(double gap, double end) {
  const double lost = kBrakes * kReacts;
  const double squared = lost * lost + end * end + 2.0 * kBrakes * std::max(0.0, gap);
  return std::max(end, std::sqrt(squared) - lost);
}

/// What one zone allows.
struct Allowed {
  double forward = navvi_types::kFastest;
  double backward = navvi_types::kFastest;

  [[nodiscard]] double least() const { return std::min(forward, backward); }
  void limit(double most) {
    forward = std::min(forward, most);
    backward = std::min(backward, most);
  }
};

Allowed allowed_by(const Zone& zone, Point robot, double yaw, double radius) {
  Allowed allowed;
  const Point ahead{std::cos(yaw), std::sin(yaw)};
  const bool closed = zone.kind != Kind::slow;
  if (zone.contains(robot)) {
    allowed.limit(closed ? kLeaves : zone.speed);
    return allowed;
  }
  for_each_edge(zone.corners, [&](Point a, Point b) {
    const Point to = nearest_on_segment(robot, a, b) - robot;
    const double far = norm(to), toward = dot(ahead, to) / std::max(far, 1e-9);
    const double most = most_before(far - radius, zone.speed);
    if (toward > 0.0) allowed.forward = std::min(allowed.forward, most / toward);
    if (toward < 0.0) allowed.backward = std::min(allowed.backward, -most / toward);
    if (!closed && far < radius) allowed.limit(zone.speed);
  });
  return allowed;
}

}  // namespace

bool Zone::contains(Point point) const {
  int turns = 0;  // of the border round the point, also where it goes round twice
  for_each_edge(corners, [&](Point a, Point b) {
    if ((a.y > point.y) != (b.y > point.y) &&
        point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x))
      turns += b.y > a.y ? 1 : -1;
  });
  return turns != 0;
}

Zones::Zones(const std::string& file) {
  if (file.empty()) return;
  const YAML::Node root = navvi_config::load_yaml(file);
  if (!root.IsSequence() || root.size() > kMostZones)
    reject(file, root,
           "the file must be a list of at most 200 zones, such as - {name: press, kind: keep_out, "
           "corners: [0, 0, 4, 0, 4, 2]}");
  for (const YAML::Node& item : root) zones_.push_back(read_zone(file, item));
}

void Zones::close(MapSurvey& survey) const {
  const double cell = survey.cell_size, touches = std::sqrt(0.5) * cell;
  for (const Zone& zone : zones_) {
    if (zone.kind == Kind::slow) continue;
    Point low = zone.corners.front(), high = low;
    for (const Point corner : zone.corners) {
      low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
      high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
    }
    const auto index = [cell](double at, int first, int count) {
      return static_cast<int>(std::clamp(std::floor(at / cell) - first, -1.0, 1.0 * count));
    };
    const int bottom = std::max(0, index(low.y, survey.low.y, survey.rows) - 1);
    const int top = std::min(survey.rows - 1, index(high.y, survey.low.y, survey.rows) + 1);
    const int left = std::max(0, index(low.x, survey.low.x, survey.columns) - 1);
    const int right = std::min(survey.columns - 1, index(high.x, survey.low.x, survey.columns) + 1);
    for (int y = bottom; y <= top; ++y) {
      Ground* const row = survey.ground.own_row(y);
      for (int x = left; x <= right; ++x) {
        const Point middle{(survey.low.x + x + 0.5) * cell, (survey.low.y + y + 0.5) * cell};
        if (zone.contains(middle) || distance_to_edges(zone, middle) <= touches)
          row[x] = Ground::obstacle;
      }
    }
  }
}

navvi_types::ZoneState Zones::at(Point robot, double yaw, double radius) const {
  navvi_types::ZoneState state;
  double told = kTold;
  for (const Zone& zone : zones_) {
    const Allowed allowed = allowed_by(zone, robot, yaw, radius);
    state.forward = std::min(state.forward, allowed.forward);
    state.backward = std::min(state.backward, allowed.backward);
    const bool is_in = zone.contains(robot) || distance_to_edges(zone, robot) < radius;
    if (zone.kind == Kind::slow ? is_in && state.kind == Kind::none : allowed.least() < told) {
      if (zone.kind != Kind::slow) told = allowed.least();
      state.kind = zone.kind;
      state.name = zone.name;
    }
  }
  return state;
}

}  // namespace navvi_floor
