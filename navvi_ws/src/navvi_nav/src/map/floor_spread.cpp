#include "map/floor_spread.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace navvi_nav::map {
namespace {

constexpr int kUnknown = std::numeric_limits<int>::min();
constexpr double kSteep = 0.95;  // rise over run taken for 45 degrees, less the voxels' rounding

/// The height of the floor in each column.
class Spread {
 public:
  Spread(std::vector<Ground>& ground, const HeightField& field, const Climbing& climbing)
      : ground_(ground),
        field_(field),
        climbing_(climbing),
        window_(std::max(3, climbing.step)),
        height_(ground.size(), kUnknown) {}

  void flood() {
    std::vector<int> waiting;
    for (int at = 0; at < static_cast<int>(ground_.size()); ++at) {
      if (ground(at) != Ground::floor) continue;
      height(at) = climbing_.floor_top;
      waiting.push_back(at);
    }
    for (std::size_t done = 0; done < waiting.size(); ++done) {
      const int from = waiting[done];
      for_neighbours(from, [&](int to) {
        if (ground(to) == Ground::floor) return;
        const int top = place_near(to, height(from));
        if (top == kUnknown) {
          if (ground(to) == Ground::none && blocked(to, height(from)))
            ground(to) = Ground::obstacle;
          return;
        }
        ground(to) = Ground::floor;
        height(to) = top;
        waiting.push_back(to);
      });
    }
  }

  /// What is judged is the floor as it spread, so that the order of the cells does not matter.
  void take_back() {
    std::vector<int> taken;
    for (int at = 0; at < static_cast<int>(ground_.size()); ++at) {
      if (height(at) == kUnknown) continue;
      bool level = true, cliff = false;
      for_neighbours(at, [&](int to) {
        if (height(to) == kUnknown) return;
        level = level && height(to) == height(at);
        cliff = cliff || height(at) - height(to) > climbing_.step;
      });
      if (cliff || (!level && steep(at))) taken.push_back(at);
    }
    for (const int at : taken) ground(at) = Ground::obstacle;
  }

 private:
  Ground& ground(int at) { return ground_[static_cast<std::size_t>(at)]; }
  int& height(int at) { return height_[static_cast<std::size_t>(at)]; }

  template <typename Visit>
  void for_neighbours(int at, Visit visit) {
    const int width = field_.width();
    const int x = at % width;
    if (x > 0) visit(at - 1);
    if (x + 1 < width) visit(at + 1);
    if (at >= width) visit(at - width);
    if (at + width < static_cast<int>(ground_.size())) visit(at + width);
  }

  /// The place to stand in a column that is nearest in height, or kUnknown if none can be stepped
  /// on from there.
  int place_near(int column, int from) const {
    int best = kUnknown;
    int ceiling = std::numeric_limits<int>::max();
    field_.downwards(static_cast<std::size_t>(column), [&](Span span) {
      const int away = std::abs(span.top - from);
      if (away <= climbing_.step && ceiling - span.top >= climbing_.headroom &&
          (best == kUnknown || away < std::abs(best - from)))
        best = span.top;
      ceiling = span.bottom;
      return true;
    });
    return best;
  }

  bool blocked(int column, int from) const {
    bool found = false;
    field_.downwards(static_cast<std::size_t>(column), [&](Span span) {
      found = span.top > from && span.bottom < from + climbing_.headroom;
      return !found;
    });
    return found;
  }

  /// Fits a plane to the floor around, as far as it is joined to the cell rather than a storey
  /// above or below. The window is so wide that a single step in it does not look steep.
  bool steep(int at) {
    const int width = field_.width();
    const int x = at % width;
    const int y = at / width;
    double n = 0, sx = 0, sy = 0, sh = 0, sxx = 0, sxy = 0, syy = 0, sxh = 0, syh = 0;
    for (int dy = std::max(-window_, -y); dy <= std::min(window_, field_.height() - 1 - y); ++dy) {
      for (int dx = std::max(-window_, -x); dx <= std::min(window_, width - 1 - x); ++dx) {
        const int other = height(at + dy * width + dx);
        if (other == kUnknown) continue;
        const int rise = other - height(at);
        if (std::abs(rise) > climbing_.step + 2 * std::max(std::abs(dx), std::abs(dy))) continue;
        n += 1, sx += dx, sy += dy, sh += rise;
        sxx += dx * dx, sxy += dx * dy, syy += dy * dy, sxh += dx * rise, syh += dy * rise;
      }
    }
    const double a = sxx - sx * sx / n, b = sxy - sx * sy / n, c = syy - sy * sy / n;
    const double p = sxh - sx * sh / n, q = syh - sy * sh / n;
    const double det = a * c - b * b;
    if (det < 1e-6) return std::max(a, c) > 0.5 && std::hypot(p, q) >= kSteep * std::max(a, c);
    return std::hypot(p * c - q * b, q * a - p * b) >= kSteep * det;
  }

  std::vector<Ground>& ground_;
  const HeightField& field_;
  Climbing climbing_;
  int window_;
  std::vector<int> height_;
};

}  // namespace

void spread_floor(std::vector<Ground>& ground, const HeightField& field, const Climbing& climbing) {
  Spread spread(ground, field, climbing);
  spread.flood();
  spread.take_back();
}

}  // namespace navvi_nav::map
