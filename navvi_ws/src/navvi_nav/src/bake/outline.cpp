#include "bake/outline.hpp"

#include <algorithm>
#include <utility>

namespace navvi_nav::bake {
namespace {

constexpr std::size_t kLongestNotch = 24;  // corners

/// Corners that must stay: the ends of walls, and places that the outline visits twice.
std::vector<char> fixed_corners(const std::vector<OutlineCorner>& outline) {
  std::vector<char> fixed(outline.size(), 0);
  std::vector<std::pair<std::pair<int, int>, std::size_t>> places;
  places.reserve(outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const OutlineCorner& before = outline[i > 0 ? i - 1 : outline.size() - 1];
    fixed[i] = !outline[i].wall || !before.wall;
    places.push_back({{outline[i].x, outline[i].y}, i});
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i].first == places[i - 1].first)
      fixed[places[i].second] = fixed[places[i - 1].second] = 1;
  }
  return fixed;
}

}  // namespace

std::int64_t turn(const OutlineCorner& from, const OutlineCorner& to, const OutlineCorner& at) {
  return static_cast<std::int64_t>(to.x - from.x) * (at.y - from.y) -
         static_cast<std::int64_t>(to.y - from.y) * (at.x - from.x);
}

std::int64_t twice_area(const std::vector<OutlineCorner>& outline) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const OutlineCorner& before = outline[i > 0 ? i - 1 : outline.size() - 1];
    sum += static_cast<std::int64_t>(outline[i].x) * before.y -
           static_cast<std::int64_t>(before.x) * outline[i].y;
  }
  return sum;
}

void grow_walls(std::vector<OutlineCorner>& outline, const TileCells& cells, int grow) {
  for (OutlineCorner& corner : outline) {
    const int x = corner.x, y = corner.y;
    const int a = cells.is_open(x - 1, y - 1), b = cells.is_open(x, y - 1);
    const int c = cells.is_open(x - 1, y), d = cells.is_open(x, y);
    corner.x *= map::kStepsPerCellSide;
    corner.y *= map::kStepsPerCellSide;
    const bool touch = a == d && b == c;  // all alike, or two open cells that share this point only
    if (touch) continue;
    const int out_x = (a + c > b + d) - (a + c < b + d);
    const int out_y = (a + b > c + d) - (a + b < c + d);
    if (x > 0 && x < cells.size) corner.x += grow * out_x;
    if (y > 0 && y < cells.size) corner.y += grow * out_y;
  }
}

void fill_notches(std::vector<OutlineCorner>& outline, double error) {
  const std::size_t count = outline.size();
  if (count < 4) return;
  const std::vector<char> fixed = fixed_corners(outline);
  const auto start =
      static_cast<std::size_t>(std::find(fixed.begin(), fixed.end(), 1) - fixed.begin()) % count;
  const auto at = [&](std::size_t i) -> const OutlineCorner& {
    return outline[(start + i) % count];
  };
  const auto is_notch = [&](std::size_t from, std::size_t to) {
    const OutlineCorner& a = at(from);
    const OutlineCorner& b = at(to);
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double length2 = dx * dx + dy * dy;
    const double limit = error * error * length2;
    for (std::size_t k = from + 1; k < to; ++k) {
      const auto side = static_cast<double>(turn(a, b, at(k)));
      const double along = dx * (at(k).x - a.x) + dy * (at(k).y - a.y);
      if (side < 0.0 || side * side > limit || along < 0.0 || along > length2) return false;
    }
    return length2 != 0.0;
  };
  std::vector<OutlineCorner> kept;
  kept.reserve(count);
  for (std::size_t i = 0; i < count;) {
    kept.push_back(at(i));
    std::size_t next = i + 1;
    for (std::size_t j = i + 2; j <= std::min(count, i + kLongestNotch); ++j) {
      if (fixed[(start + j - 1) % count] || !at(j - 1).wall) break;
      if (is_notch(i, j)) next = j;
    }
    i = next;
  }
  if (kept.size() >= 3) outline = std::move(kept);
}

}  // namespace navvi_nav::bake
