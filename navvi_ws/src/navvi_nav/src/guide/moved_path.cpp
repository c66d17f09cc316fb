#include "guide/moved_path.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kAhead = 20.0;   // m, of the path that counts
constexpr double kAside = 0.5;    // m, less is no change to a person
constexpr double kSample = 0.25;  // m

double away(Point point, const Path& path) {
  double best = distance(point, path.front());
  for (std::size_t i = 1; i < path.size(); ++i)
    best = std::min(best, distance(point, nearest_on_segment(point, path[i - 1], path[i])));
  return best;
}

}  // namespace

double moved_length(const Path& old, const Path& fresh) {
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

}  // namespace navvi_nav::guide
