#include "grid_world.hpp"

namespace navvi_nav {
namespace {

using Kind = GridWorld::CellKind;

int pick(std::mt19937& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

mesh::GridPolygon rectangle(int x0, int y0, int x1, int y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

/// A rectangle as one, two or four polygons.
void add_split(std::vector<mesh::GridPolygon>& out, int x0, int y0, int x1, int y1,
               std::mt19937& random) {
  const int x = pick(random, x0, x1);
  const int y = pick(random, y0, y1);
  switch (random() % 5) {
    case 0:
      out.push_back({{{x0, y0}, {x1, y0}, {x1, y1}}});
      out.push_back({{{x0, y0}, {x1, y1}, {x0, y1}}});
      return;
    case 1:  // a fan round a point inside
      if (x == x0 || x == x1 || y == y0 || y == y1) break;
      out.push_back({{{x0, y0}, {x1, y0}, {x, y}}});
      out.push_back({{{x1, y0}, {x1, y1}, {x, y}}});
      out.push_back({{{x1, y1}, {x0, y1}, {x, y}}});
      out.push_back({{{x0, y1}, {x0, y0}, {x, y}}});
      return;
    case 2:  // slanted cut
      if (x == x0 || x == x1) break;
      out.push_back({{{x0, y0}, {x, y0}, {x1, y1}, {x0, y1}}});
      out.push_back({{{x, y0}, {x1, y0}, {x1, y1}}});
      return;
    default:
      break;
  }
  out.push_back(rectangle(x0, y0, x1, y1));
}

}  // namespace

GridWorld::GridWorld(int columns, int rows)
    : columns_(columns),
      rows_(rows),
      cells_(static_cast<std::size_t>(columns * rows), CellKind::free) {}

void GridWorld::fill(int x, int y, int width, int height, CellKind kind) {
  for (int row = std::max(y, 0); row < std::min(y + height, rows_); ++row) {
    for (int column = std::max(x, 0); column < std::min(x + width, columns_); ++column)
      at(column, row) = kind;
  }
}

std::vector<mesh::GridPolygon> GridWorld::polygons(std::uint32_t seed) const {
  std::mt19937 random(seed);
  std::vector<char> taken(cells_.size(), 0);
  std::vector<std::size_t> order(cells_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  if (seed % 2 == 1) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  }
  const auto open = [&](int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        if (x < 0 || y < 0 || x >= columns_ || y >= rows_ || at(x, y) != Kind::free ||
            taken[static_cast<std::size_t>(y * columns_ + x)] != 0)
          return false;
      }
    }
    return true;
  };
  std::vector<mesh::GridPolygon> out;
  for (const std::size_t index : order) {
    const int x = static_cast<int>(index) % columns_;
    const int y = static_cast<int>(index) / columns_;
    if (at(x, y) == Kind::lower_left) out.push_back({{{x, y}, {x + 1, y}, {x, y + 1}}});
    if (at(x, y) == Kind::lower_right) out.push_back({{{x, y}, {x + 1, y}, {x + 1, y + 1}}});
    int x0 = x, y0 = y, x1 = x + 1, y1 = y + 1;
    if (!open(x0, y0, x1, y1)) continue;
    const int most = 1 + static_cast<int>(random() % 12);
    for (bool grew = true; grew;) {
      grew = false;
      if (x1 - x0 < most && open(x1, y0, x1 + 1, y1)) ++x1, grew = true;
      if (y1 - y0 < most && open(x0, y1, x1, y1 + 1)) ++y1, grew = true;
      if (x1 - x0 < most && open(x0 - 1, y0, x0, y1)) --x0, grew = true;
      if (y1 - y0 < most && open(x0, y0 - 1, x1, y0)) --y0, grew = true;
    }
    for (int row = y0; row < y1; ++row) {
      for (int column = x0; column < x1; ++column)
        taken[static_cast<std::size_t>(row * columns_ + column)] = 1;
    }
    add_split(out, x0, y0, x1, y1, random);
  }
  return out;
}

Point GridWorld::somewhere(std::mt19937& random) const {
  for (;;) {
    const int x = pick(random, 0, columns_ - 1);
    const int y = pick(random, 0, rows_ - 1);
    if (at(x, y) == Kind::blocked) continue;
    const double u = 0.25 * pick(random, 0, 4);
    const double v = 0.25 * pick(random, 0, 4);
    if (at(x, y) == Kind::lower_left && u + v > 1.0) continue;
    if (at(x, y) == Kind::lower_right && v > u) continue;
    return {x + u, y + v};
  }
}

GridWorld grid_world(WorldKind kind, std::uint32_t seed) {
  std::mt19937 random(seed);
  switch (kind) {
    case WorldKind::warehouse: {
      const int length = pick(random, 2, 5), depth = pick(random, 1, 2);
      const int bay = pick(random, 1, 3), aisle = pick(random, 1, 3);
      const int across = pick(random, 2, 4), along = pick(random, 2, 5);
      GridWorld out(bay + across * (length + bay), aisle + along * (depth + aisle));
      for (int i = 0; i < across; ++i) {
        for (int j = 0; j < along; ++j)
          out.fill(bay + i * (length + bay), aisle + j * (depth + aisle), length, depth);
      }
      return out;
    }
    case WorldKind::clutter: {
      GridWorld out(16, 12);
      for (int i = pick(random, 4, 12); i > 0; --i)
        out.fill(pick(random, -1, 15), pick(random, -1, 11), pick(random, 1, 4),
                 pick(random, 1, 4));
      for (int i = pick(random, 0, 8); i > 0; --i)
        out.fill(pick(random, 0, 15), pick(random, 0, 11), 1, 1,
                 random() % 2 == 0 ? Kind::lower_left : Kind::lower_right);
      return out;
    }
    case WorldKind::maze: {
      GridWorld out(17, 13);
      for (int x = 0; x < 17; ++x) {
        for (int y = 0; y < 13; ++y) {
          const bool post = x % 2 == 1 && y % 2 == 1;
          const bool gate = x % 2 == 1 || y % 2 == 1;
          if (post || (gate && random() % 100 < 35)) out.fill(x, y, 1, 1);
        }
      }
      return out;
    }
    case WorldKind::splinters: {
      GridWorld out(10, 8);
      for (int i = 0; i < 6; ++i) out.fill(pick(random, 0, 9), pick(random, 0, 7), 1, 1);
      for (int i = 0; i < 24; ++i)
        out.fill(pick(random, 0, 9), pick(random, 0, 7), 1, 1,
                 random() % 2 == 0 ? Kind::lower_right : Kind::lower_left);
      return out;
    }
    default: {
      GridWorld out(14, 10);
      for (int i = pick(random, 20, 60); i > 0; --i)
        out.fill(pick(random, 0, 13), pick(random, 0, 9), 1, 1);
      return out;
    }
  }
}

}  // namespace navvi_nav
