#include "navvi_nav/waypoints.hpp"

#include <limits>

namespace navvi_nav {
namespace {

constexpr double kSample = 0.2;  // m

double leg_cost(Point a, Point b, const Space& space, const Room& room, double weight) {
  const double length = distance(a, b);
  if (room.preferred <= 0.0 || weight <= 0.0) return length;
  const int samples = std::max(1, static_cast<int>(std::ceil(length / kSample)));
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Point at = a + ((i + 0.5) / samples) * (b - a);
    double gap = space.floor->gap(space.floor->cell_at(at));
    for (const Cylinder& cylinder : *space.cylinders)
      gap = std::min(gap, distance(at, cylinder.center) - cylinder.radius);
    const double missing =
        std::clamp((room.radius + room.preferred - gap) / room.preferred, 0.0, 1.0);
    sum += 1.0 + weight * missing * missing;
  }
  return length * sum / samples;
}

}  // namespace

double guide_cost(const Path& path, const Space& space, const Room& room,
                  const SmoothingConfig& config) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    sum += leg_cost(path[i - 1], path[i], space, room, config.clearance_weight);
  return sum;
}

bool clear(const Path& path, const Space& space, double radius) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!space.segment_clear(path[i - 1], path[i], radius)) return false;
  }
  return true;
}

Path push_corners(const Path& path, const Space& space, const Room& room) {
  Path out = path;
  for (std::size_t i = 1; i + 1 < out.size(); ++i) {
    const Point in = out[i] - out[i - 1];
    const Point back = out[i] - out[i + 1];
    if (norm(in) == 0.0 || norm(back) == 0.0) continue;
    const Point outward = (1.0 / norm(in)) * in + (1.0 / norm(back)) * back;
    if (norm(outward) < 1e-6) continue;
    for (const double share : {1.0, 0.75, 0.5, 0.25}) {
      const Point moved = out[i] + (share * room.preferred / norm(outward)) * outward;
      if (!space.segment_clear(out[i - 1], moved, room.radius) ||
          !space.segment_clear(moved, out[i + 1], room.radius))
        continue;
      out[i] = moved;
      break;
    }
  }
  return out;
}

Path dense(const Path& path, double spacing) {
  Path out;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const int parts =
        std::max(1, static_cast<int>(std::ceil(distance(path[i], path[i + 1]) / spacing)));
    for (int k = 0; k < parts; ++k)
      out.push_back(path[i] + (static_cast<double>(k) / parts) * (path[i + 1] - path[i]));
  }
  if (!path.empty()) out.push_back(path.back());
  return out;
}

std::vector<Candidate> candidates_along(const Path& path, const Space& space, const Room& room) {
  std::vector<Candidate> out;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const int station = static_cast<int>(i);
    out.push_back({path[i], station});
    if (i == 0 || i + 1 == path.size()) continue;
    const Point along = path[i + 1] - path[i - 1];
    if (norm(along) == 0.0) continue;
    const Point across = (room.preferred / norm(along)) * Point{-along.y, along.x};
    for (const double share : {0.5, 1.0, -0.5, -1.0}) {
      const Point aside = path[i] + share * across;
      if (space.segment_clear(path[i], aside, room.radius)) out.push_back({aside, station});
    }
  }
  // The last point is the last candidate: it has nothing beside it.
  return out;
}

Path choose_waypoints(const std::vector<Candidate>& candidates, const Space& space,
                      const Room& room, const SmoothingConfig& config) {
  const std::size_t count = candidates.size();
  if (count < 2) return {};
  std::vector<double> cost(count, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(count, 0);
  cost[0] = 0.0;
  for (std::size_t to = 1; to < count; ++to) {
    const Point target = candidates[to].point;
    for (std::size_t i = to; i-- > 0;) {
      if (candidates[i].station >= candidates[to].station) continue;
      const Point source = candidates[i].point;
      const double start = cost[i] + (i == 0 ? 0.0 : config.turn_price);
      if (start + distance(source, target) >= cost[to]) continue;
      const double sum = start + leg_cost(source, target, space, room, config.clearance_weight);
      if (sum >= cost[to] || !space.segment_clear(source, target, room.radius)) continue;
      cost[to] = sum;
      from[to] = i;
    }
  }
  if (!std::isfinite(cost.back())) return {};
  Path out;
  for (std::size_t i = count - 1; i != 0; i = from[i]) out.push_back(candidates[i].point);
  out.push_back(candidates.front().point);
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace navvi_nav
