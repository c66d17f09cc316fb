#include "guide/path_instability.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kAhead = 20.0;   // m, of the path that counts
constexpr double kAside = 0.5;    // m, less is no change to a person
constexpr double kSample = 0.25;  // m
constexpr double kMinute = 60.0;  // s

double away(Point point, const Path& path) {
  double best = distance(point, path.front());
  for (std::size_t i = 1; i < path.size(); ++i)
    best = std::min(best, distance(point, nearest_on_segment(point, path[i - 1], path[i])));
  return best;
}

}  // namespace

double PathInstability::moved(const Path& old, const Path& fresh) {
  if (fresh.empty()) return std::min(kAhead, length_of(old));
  double sum = 0.0;
  double before = 0.0;
  for (std::size_t i = 1; i < old.size() && before < kAhead; ++i) {
    const Point leg = old[i] - old[i - 1];
    const double length = norm(leg);
    const double counts = std::min(length, kAhead - before);
    before += length;
    if (counts <= 0.0) continue;
    const int samples = std::max(1, static_cast<int>(std::ceil(counts / kSample)));
    for (int k = 0; k < samples; ++k) {
      const double share = (k + 0.5) / samples * counts / length;
      if (away(old[i - 1] + share * leg, fresh) > kAside) sum += counts / samples;
    }
  }
  return sum;
}

void PathInstability::add(double time, double metres) {
  while (!moves_.empty() && moves_.front().first <= time - kMinute) moves_.pop_front();
  moves_.push_back({time, metres});
}

double PathInstability::per_minute(double time) const {
  double sum = 0.0;
  for (const auto& [when, metres] : moves_) {
    if (when > time - kMinute) sum += metres;
  }
  return sum;
}

}  // namespace navvi_nav::guide
