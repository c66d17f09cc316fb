#include "smooth/waypoints.hpp"

#include <limits>

namespace navvi_nav::smooth {
namespace {

constexpr int kTries = 6;            // of narrowing the channel
constexpr double kNearCorner = 1.1;  // m, stations stand close together within it
constexpr double kStationGap = 2.0;  // m, between stations elsewhere
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Rungs on which the path may turn: close together about the corners of the channel.
std::vector<std::size_t> stations_of(const Channel& channel) {
  const auto& rungs = channel.rungs();
  std::vector<double> corners;
  for (const auto& rung : rungs) {
    if (rung.corner) corners.push_back(rung.along);
  }
  std::vector<std::size_t> out{0};
  std::size_t next = 0;  // corner
  for (std::size_t i = 1; i + 1 < rungs.size(); ++i) {
    const double at = rungs[i].along;
    while (next < corners.size() && corners[next] < at - kNearCorner) ++next;
    const bool near = next < corners.size() && corners[next] <= at + kNearCorner;
    if (near || at - rungs[out.back()].along >= kStationGap) out.push_back(i);
  }
  out.push_back(rungs.size() - 1);
  return out;
}

/// What is seen from a point through one rung after the other: directions between two.
class Wedge {
 public:
  explicit Wedge(Point from) : from_(from) {}
  [[nodiscard]] bool sees(Point at) const {
    const Point course = at - from_;
    return !open_ || (cross(right_, course) >= -1e-9 && cross(course, left_) >= -1e-9);
  }
  /// Nothing is seen past the ends of a rung. \returns false if nothing is left
  bool pass(Point right, Point left) {
    const Point to_right = right - from_;
    const Point to_left = left - from_;
    if (!open_ || cross(right_, to_right) > 0.0) right_ = to_right;
    if (!open_ || cross(to_left, left_) > 0.0) left_ = to_left;
    open_ = true;
    return cross(right_, left_) >= -1e-9;
  }

 private:
  Point from_;
  Point right_;
  Point left_;
  bool open_ = false;
};

/// Dynamic programming over the candidates, station by station.
class Choice {
 public:
  Choice(const Channel& channel, const SmoothingConfig& config);
  struct Stop {
    std::size_t rung = 0;
    int sample = 0;
  };
  /// From end to end; empty if there is no way.
  [[nodiscard]] std::vector<Stop> run();

 private:
  struct Candidate {
    Stop stop;
    Point point;
    double cost = kNever;
    std::size_t from = 0;
  };

  [[nodiscard]] double dearness(const Candidate& a, const Candidate& b) const;
  [[nodiscard]] bool pass(Wedge& wedge, std::size_t rung) const;
  void extend(std::size_t station, std::size_t from);
  void improve(std::size_t from, std::size_t to, const Wedge& wedge);

  const Channel& channel_;
  const SmoothingConfig& config_;
  std::vector<std::size_t> stations_;  // rungs
  std::vector<Candidate> candidates_;
  std::vector<std::size_t> first_of_;  // candidate, by station; one more at the end
};

Choice::Choice(const Channel& channel, const SmoothingConfig& config)
    : channel_(channel), config_(config), stations_(stations_of(channel)) {
  for (const std::size_t rung : stations_) {
    first_of_.push_back(candidates_.size());
    const auto& r = channel.rungs()[rung];
    for (int sample = r.low; sample <= r.high; ++sample) {
      if (sample % 2 == 0 || sample == r.low || sample == r.high)
        candidates_.push_back({{rung, sample}, channel.point(rung, sample), kNever, 0});
    }
  }
  first_of_.push_back(candidates_.size());
  candidates_.front().cost = 0.0;
}

/// The mean of 1 + weight * missing^2 over the rungs that a leg crosses, ends included.
double Choice::dearness(const Candidate& a, const Candidate& b) const {
  const auto price = [this](std::size_t rung, double sample) {
    const double missing = channel_.room().missing(channel_.gap(rung, sample));
    return 1.0 + config_.clearance_weight * missing * missing;
  };
  double sum = 0.5 * (price(a.stop.rung, a.stop.sample) + price(b.stop.rung, b.stop.sample));
  const Point course = b.point - a.point;
  for (std::size_t i = a.stop.rung + 1; i < b.stop.rung; ++i)
    sum += price(i, channel_.crossing(i, a.point, course));
  return sum / static_cast<double>(b.stop.rung - a.stop.rung);
}

bool Choice::pass(Wedge& wedge, std::size_t rung) const {
  const auto& r = channel_.rungs()[rung];
  return wedge.pass(channel_.point(rung, r.low), channel_.point(rung, r.high));
}

/// Offers `from` to every candidate that it sees through all rungs in between.
void Choice::extend(std::size_t station, std::size_t from) {
  Wedge wedge(candidates_[from].point);
  std::size_t rung = stations_[station];
  for (std::size_t t = station + 1; t < stations_.size(); ++t) {
    for (++rung; rung < stations_[t]; ++rung) {
      if (!pass(wedge, rung)) return;
    }
    for (std::size_t to = first_of_[t]; to < first_of_[t + 1]; ++to) improve(from, to, wedge);
    if (!pass(wedge, rung)) return;
  }
}

void Choice::improve(std::size_t from, std::size_t to, const Wedge& wedge) {
  const Candidate& a = candidates_[from];
  Candidate& b = candidates_[to];
  const double length = distance(a.point, b.point);
  const double brief = std::max(0.0, 1.0 - length / config_.short_leg);
  const double start = a.cost + config_.turn_price * (brief + (from == 0 ? 0.0 : 1.0));
  if (start + length >= b.cost || !wedge.sees(b.point)) return;
  const double sum = start + length * dearness(a, b);
  if (sum >= b.cost) return;
  b.cost = sum;
  b.from = from;
}

std::vector<Choice::Stop> Choice::run() {
  for (std::size_t s = 0; s + 1 < stations_.size(); ++s) {
    for (std::size_t i = first_of_[s]; i < first_of_[s + 1]; ++i) {
      if (candidates_[i].cost < kNever) extend(s, i);
    }
  }
  if (candidates_.back().cost == kNever) return {};
  std::vector<Stop> out;
  for (std::size_t i = candidates_.size() - 1; i != 0; i = candidates_[i].from)
    out.push_back(candidates_[i].stop);
  out.push_back(candidates_.front().stop);
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace

bool clear(const Path& path, const map::Space& space, double radius) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!space.segment_clear(path[i - 1], path[i], radius)) return false;
  }
  return true;
}

Path choose_waypoints(Channel channel, const map::Space& space, double radius,
                      const SmoothingConfig& config) {
  for (int i = 0; i < kTries; ++i) {
    const std::vector<Choice::Stop> stops = Choice(channel, config).run();
    Path path;
    for (const auto& stop : stops) path.push_back(channel.point(stop.rung, stop.sample));
    bool narrowed = false;
    for (std::size_t k = 1; k < path.size(); ++k) {
      if (space.segment_clear(path[k - 1], path[k], radius)) continue;
      if (!channel.narrow(stops[k - 1].rung, stops[k].rung, path[k - 1], path[k])) return {};
      narrowed = true;
    }
    if (!narrowed) return path;
  }
  return {};
}

}  // namespace navvi_nav::smooth
