#include "smooth/channel.hpp"

namespace navvi_nav::smooth {
namespace {

constexpr double kSpacing = 0.5;      // m, less than twice the radius of any robot that matters
constexpr double kMostRungs = 400.0;  // a path that is too long for so many has them farther apart
constexpr double kLeastReach = 0.6;   // m, of a rung, also where no room is preferred
constexpr double kSlack = 1e-6;       // samples

Point unit(Point a) { return (1.0 / norm(a)) * a; }
Point left_of(Point a) { return {-a.y, a.x}; }

}  // namespace

Channel::Channel(const Path& path, const map::Space& space, const Clearances& room)
    : room_(room), step_(std::max(room.preferred, kLeastReach) / kSide) {
  place_rungs(path);
  measure(space);
  untangle();
}

void Channel::place_rungs(const Path& path) {
  const double spacing = std::max(kSpacing, length_of(path) / kMostRungs);
  double along = 0.0;
  Point before;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double length = distance(path[i], path[i + 1]);
    if (length == 0.0) continue;
    const Point course = (1.0 / length) * (path[i + 1] - path[i]);
    const int parts = static_cast<int>(std::ceil(length / spacing));
    for (int k = 0; k < parts; ++k) {
      const double share = static_cast<double>(k) / parts;
      const bool corner = k == 0 && !rungs_.empty();
      Point across = left_of(course);
      if (corner && norm(course + before) > 1e-3) across = left_of(unit(course + before));
      rungs_.push_back(
          {path[i] + share * (path[i + 1] - path[i]), across, corner, along + share * length});
    }
    along += length;
    before = course;
  }
  rungs_.push_back({path.back(), left_of(before), false, along});
}

void Channel::measure(const map::Space& space) {
  const double reach = kSide * step_;
  std::vector<Cylinder> near;
  for (std::size_t i = 0; i < rungs_.size(); ++i) {
    Rung& rung = rungs_[i];
    near.clear();
    for (const Cylinder& cylinder : *space.cylinders) {
      if (distance(cylinder.center, rung.at) <
          room_.radius + room_.preferred + reach + cylinder.radius)
        near.push_back(cylinder);
    }
    const auto free = [&](int sample) {
      const Point at = point(i, sample);
      double gap = space.floor->gap(space.floor->cell_at(at));
      for (const Cylinder& cylinder : near)
        gap = std::min(gap, distance(at, cylinder.center) - cylinder.radius);
      rung.gap[kSide + sample] = gap;
      return gap >= room_.radius;
    };
    (void)free(0);  // by definition
    if (i == 0 || i + 1 == rungs_.size()) continue;
    while (rung.high < kSide && free(rung.high + 1)) ++rung.high;
    while (rung.low > -kSide && free(rung.low - 1)) --rung.low;
  }
}

/// Shortens rungs that cross each other, so that a path that crosses them in order leads forward.
void Channel::untangle() {
  for (std::size_t i = 1; i < rungs_.size(); ++i) {
    Rung& a = rungs_[i - 1];
    Rung& b = rungs_[i];
    const double turned = cross(a.across, b.across);
    if (std::abs(turned) < 1e-9) continue;
    const double on_a = cross(b.at - a.at, b.across) / turned / step_;
    const double on_b = cross(b.at - a.at, a.across) / turned / step_;
    if (on_a > a.high || on_a < a.low || on_b > b.high || on_b < b.low) continue;
    const auto cut = [](Rung& rung, double at) {
      if (at > 0.0)
        rung.high = std::max(0, static_cast<int>(std::ceil(at)) - 1);
      else
        rung.low = std::min(0, static_cast<int>(std::floor(at)) + 1);
    };
    cut(a, on_a);
    cut(b, on_b);
  }
}

double Channel::gap(std::size_t rung, double sample) const {
  const Rung& r = rungs_[rung];
  const double at = std::clamp(sample, static_cast<double>(r.low), static_cast<double>(r.high));
  const int below = std::min(static_cast<int>(std::floor(at)), kSide - 1);
  const double share = at - below;
  const double low = r.gap[kSide + below];
  return share > 0.0 ? low + share * (r.gap[kSide + below + 1] - low) : low;
}

/// True if the point is no farther from the ladder's middle than a rung may be long.
bool Channel::beside(Point point) const {
  for (std::size_t i = 1; i < rungs_.size(); ++i) {
    if (distance(point, nearest_on_segment(point, rungs_[i - 1].at, rungs_[i].at)) <=
        kSide * step_ + 1e-6)
      return true;
  }
  return false;
}

bool Channel::holds(const Path& path) const {
  if (path.size() < 2 || !(path.front() == rungs_.front().at) || !(path.back() == rungs_.back().at))
    return false;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    if (!beside(path[i])) return false;
  }
  std::size_t leg = 1;
  double from = 0.0;  // share of the leg that is behind
  for (std::size_t i = 1; i + 1 < rungs_.size(); ++i) {
    const Rung& rung = rungs_[i];
    for (;; ++leg, from = 0.0) {
      if (leg >= path.size()) return false;
      const Point course = path[leg] - path[leg - 1];
      const double sample = crossing(i, path[leg - 1], course);
      if (!(sample >= rung.low - kSlack && sample <= rung.high + kSlack)) continue;
      const Point meets = rung.at + (sample * step_) * rung.across;
      const double share = dot(meets - path[leg - 1], course) / dot(course, course);
      if (share < from - kSlack || share > 1.0 + kSlack) continue;
      from = std::max(from, share);
      break;
    }
  }
  return true;
}

bool Channel::narrow(std::size_t from, std::size_t to, Point a, Point b) {
  Rung* worst = nullptr;
  double least = 0.0;
  double side = 0.0;
  for (std::size_t i = from; i <= to; ++i) {
    const double sample = crossing(i, a, b - a);
    if (!(std::abs(sample) > kSlack)) continue;
    Rung& rung = rungs_[i];
    if (sample > 0.0 ? rung.high == 0 : rung.low == 0) continue;
    const double here = gap(i, sample);
    if (worst && here >= least) continue;
    least = here;
    worst = &rung;
    side = sample;
  }
  if (!worst) return false;
  if (side > 0.0)
    worst->high = std::max(0, std::min(worst->high, static_cast<int>(std::ceil(side))) - 1);
  else
    worst->low = std::min(0, std::max(worst->low, static_cast<int>(std::floor(side))) + 1);
  return true;
}

}  // namespace navvi_nav::smooth
