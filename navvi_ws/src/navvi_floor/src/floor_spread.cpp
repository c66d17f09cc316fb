#include "floor_spread.hpp"

#include <array>
#include <cmath>
#include <navvi_types/angles.hpp>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace navvi_floor {
namespace {

constexpr int kUnknown = std::numeric_limits<std::int16_t>::min();
constexpr double kSteep = 0.95;  // rise over run taken for 45 degrees, less the voxels' rounding
constexpr int kRampSteps = 3;    // at equal distances, that make a ramp

/// A direction over columns, the longer side of which is 1.
struct Heading {
  double x;
  double y;
};
const std::array<Heading, 16> kHeadings = [] {
  std::array<Heading, 16> all{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double x = std::cos(navvi_types::kPi / 8 * static_cast<double>(i));
    const double y = std::sin(navvi_types::kPi / 8 * static_cast<double>(i));
    const double longer = std::max(std::abs(x), std::abs(y));
    all[i] = {x / longer, y / longer};
  }
  return all;
}();

/// Whether the treads between steps are those of one slope, rounded to columns.
bool alike(int tread, int other) {
  const auto [shorter, longer] = std::minmax(tread, other);
  return longer <= shorter + std::max(2, shorter / 4);
}

/// The height of the floor in each column.
class Spread {
 public:
  Spread(std::vector<Ground>& ground, const HeightField& field, const Climbing& climbing)
      : ground_(ground),
        field_(field),
        climbing_(climbing),
        window_(climbing.steep_reach()),
        height_(ground.size(), kUnknown) {}

  /// \returns the columns that it spread to
  std::vector<int> flood() {
    std::vector<int> waiting;
    for (int at = 0; at < static_cast<int>(ground_.size()); ++at) {
      if (ground(at) != Ground::floor) continue;
      set_height(at, climbing_.floor_top);
      bool ends = false;
      for_neighbours(at, [&](int to) { ends = ends || ground(to) != Ground::floor; });
      if (ends) waiting.push_back(at);
    }
    const auto seeds = static_cast<std::ptrdiff_t>(waiting.size());
    for (std::size_t done = 0; done < waiting.size(); ++done) {
      const int from = waiting[done];
      for_neighbours(from, [&](int to) {
        if (ground(to) == Ground::floor) return;
        const int top = place_near(to, height(from), std::max(1, climbing_.step));
        if (top == kUnknown || !climbs(from, height(from), to, top)) {
          if (ground(to) == Ground::none && blocked(to, height(from)))
            ground(to) = Ground::obstacle;
          return;
        }
        ground(to) = Ground::floor;
        set_height(to, top);
        waiting.push_back(to);
      });
    }
    return {waiting.begin() + seeds, waiting.end()};
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
        cliff = cliff || (height(at) > height(to) && !climbs(to, height(to), at, height(at)));
      });
      if (cliff || (!level && steep(at))) taken.push_back(at);
    }
    for (const int at : taken) ground(at) = Ground::obstacle;
  }

 private:
  Ground& ground(int at) { return ground_[static_cast<std::size_t>(at)]; }
  [[nodiscard]] int height(int at) const { return height_[static_cast<std::size_t>(at)]; }
  void set_height(int at, int level) {
    height_[static_cast<std::size_t>(at)] = static_cast<std::int16_t>(level);
  }

  template <typename Visit>
  void for_neighbours(int at, Visit visit) {
    const int width = field_.width();
    const int x = at % width;
    if (x > 0) visit(at - 1);
    if (x + 1 < width) visit(at + 1);
    if (at >= width) visit(at - width);
    if (at + width < static_cast<int>(ground_.size())) visit(at + width);
  }

  /// Whether the robot passes between neighbours of these heights.
  [[nodiscard]] bool climbs(int from, int from_height, int to, int to_height) const {
    const int rise = std::abs(to_height - from_height);
    if (rise <= climbing_.step) return true;
    if (rise > 1) return false;
    return from_height < to_height ? on_ramp(from, from_height, to) : on_ramp(to, to_height, from);
  }

  /// Whether the step of one level from `low` up to its neighbour `high` is one of kRampSteps in a
  /// row, in some direction.
  [[nodiscard]] bool on_ramp(int low, int height, int high) const {
    const int width = field_.width();
    const int dx = high % width - low % width;
    const int dy = high / width - low / width;
    return std::any_of(kHeadings.begin(), kHeadings.end(), [&](const Heading& heading) {
      if (heading.x * dx + heading.y * dy <= 0.0) return false;
      const Treads up = treads(high, height + 1, heading, 1);
      if (up[1] > 0 && alike(up[0], up[1])) return true;
      const Treads down = treads(low, height, {-heading.x, -heading.y}, -1);
      return (up[0] > 0 && down[0] > 0 && alike(up[0], down[0])) ||
             (down[1] > 0 && alike(down[0], down[1]));
    });
  }

  /// Columns of the first treads from a column on that end in a step of `rise`; 0: there is none.
  using Treads = std::array<int, kRampSteps - 1>;
  [[nodiscard]] Treads treads(int from, int height, const Heading& heading, int rise) const {
    Treads found{};
    const int x = from % field_.width();
    const int y = from / field_.width();
    const double longest = climbing_.longest_tread / norm({heading.x, heading.y});
    std::size_t count = 0;
    for (int step = 1, begin = 0; step - begin <= longest; ++step) {
      const int ahead_x = x + static_cast<int>(std::lround(step * heading.x));
      const int ahead_y = y + static_cast<int>(std::lround(step * heading.y));
      if (ahead_x < 0 || ahead_y < 0 || ahead_x >= field_.width() || ahead_y >= field_.height())
        break;
      const int top = place_near(ahead_y * field_.width() + ahead_x, height, 1);
      if (top == height) continue;
      if (top != height + rise) break;
      found[count++] = step - begin;
      if (count == found.size()) break;
      begin = step;
      height = top;
    }
    return found;
  }

  /// The place to stand in a column that is nearest in height, or kUnknown if none is within `step`
  /// levels.
  [[nodiscard]] int place_near(int column, int from, int step) const {
    int best = kUnknown;
    int ceiling = std::numeric_limits<int>::max();
    field_.downwards(static_cast<std::size_t>(column), [&](Span span) {
      const int away = std::abs(span.top - from);
      if (away <= step && ceiling - span.top >= climbing_.headroom &&
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
    if (det < 1e-6) return std::max(a, c) > 0.5 && norm({p, q}) >= kSteep * std::max(a, c);
    return norm({p * c - q * b, q * a - p * b}) >= kSteep * det;
  }

  std::vector<Ground>& ground_;
  const HeightField& field_;
  Climbing climbing_;
  int window_;
  std::vector<std::int16_t> height_;
};

}  // namespace

std::vector<int> spread_floor(std::vector<Ground>& ground, const HeightField& field,
                              const Climbing& climbing) {
  Spread spread(ground, field, climbing);
  std::vector<int> reached = spread.flood();
  if (!reached.empty()) spread.take_back();
  return reached;
}

}  // namespace navvi_floor
