#include "navvi_nav/hold.hpp"

namespace navvi_nav {
namespace {

constexpr double kBack = 120.0 / 180 * M_PI;  // rad, from the course that is followed
constexpr double kCourse = 1.0;               // m, how much of a path makes its course

/// From the path's start to the point kCourse along it.
Point course_of(const Path& path) {
  double left = kCourse;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = distance(path[i - 1], path[i]);
    if (length >= left)
      return path[i - 1] + (left / length) * (path[i] - path[i - 1]) - path.front();
    left -= length;
  }
  return path.back() - path.front();
}

bool leads_back(const Path& followed, const Path& fresh) {
  if (fresh.size() < 2) return true;
  const Point a = course_of(followed);
  const Point b = course_of(fresh);
  return std::abs(std::atan2(cross(a, b), dot(a, b))) > kBack;
}

}  // namespace

void HoldConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"hold_time", Range{0.0, 60.0}, "s",
         "a path cut by moving things is kept so long at most; 0: never kept"},
        hold_time);
  visit({"hold_meeting", Range{0.0, 60.0}, "s",
         "nobody is led back for what comes along the path until it is so close"},
        hold_meeting);
  visit({"wait_distance", Range{0.0, 100.0}, "m",
         "nearer than this a person is told to wait for what crosses, or closes the only way"},
        wait_distance);
}

bool Hold::goes_on(double time, bool held) {
  if (!held) {
    since_.reset();
    return false;
  }
  if (!since_) since_ = time;
  return time - *since_ < config_.hold_time;
}

bool Hold::waits(double time, const Way& way) {
  if (way.state == Way::State::clears) return goes_on(time, true);
  if (way.state != Way::State::comes) since_.reset();
  return false;
}

bool Hold::keeps(double time, const Way& way, const Path& followed, const Path& fresh) {
  const bool comes = way.state == Way::State::comes && way.meets_in > config_.hold_meeting &&
                     leads_back(followed, fresh);
  return goes_on(time, comes || way.state == Way::State::clears);
}

bool Hold::must_wait(const Way& way) const {
  return config_.hold_time > 0.0 && way.state <= Way::State::clears && way.wait &&
         is_near(way.wait->at);
}

}  // namespace navvi_nav
