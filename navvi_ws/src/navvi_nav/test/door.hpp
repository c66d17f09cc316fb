#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <navvi_floor/resample.hpp>
#include <random>
#include <vector>

#include "bake/map_bake.hpp"
#include "join.hpp"

namespace navvi_nav {

/// A room of 6 x 6 m, and in it a wall at any angle with a door, all in squares.
class Door {
 public:
  /// Draws one. \param square  m, of the map
  Door(std::mt19937& random, double square) : square_(square) {
    const auto between = [&random](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    const double angle = between(0.0, 2.0 * 3.14159265358979);
    along_ = {std::cos(angle), std::sin(angle)};
    middle_ = {between(-0.8, 0.8), between(-0.8, 0.8)};
    half_gap_ = between(0.3, 0.5);
    half_wall_ = between(0.75, 3.0) * square;
    shift_ = random() % 2 == 0 ? 0.0 : between(-0.3, 0.3);
    cells_ = static_cast<int>(std::ceil(6.0 / square));
    low_ = {static_cast<int>(random() % 400) - 200, static_cast<int>(random() % 400) - 200};
    for (int y = 0; y < cells_; ++y)
      for (int x = 0; x < cells_; ++x) side_.push_back(side_of(x, y));
  }

  /// m, the least distance between squares of the two sides. A disc of that diameter passes, and
  /// none that is larger, for each side is one piece with the room's walls.
  [[nodiscard]] double width() const {
    const std::vector<map::Cell> left = squares(1), right = squares(2);
    int least2 = cells_ * cells_;
    for (const map::Cell a : left) {
      for (const map::Cell b : right) {
        const int dx = std::max(0, std::abs(a.x - b.x) - 1);
        const int dy = std::max(0, std::abs(a.y - b.y) - 1);
        least2 = std::min(least2, dx * dx + dy * dy);
      }
    }
    return std::sqrt(least2) * square_;
  }

  [[nodiscard]] map::MapSurvey survey(double margin) const {
    map::GroundGrid grid{square_, {low_.x * square_, low_.y * square_}, cells_, cells_, {}};
    for (const int side : side_)
      grid.ground.push_back(side == 0 ? map::Ground::floor : map::Ground::obstacle);
    map::SurveyConfig how;
    how.margin = margin;
    return map::resample(std::move(grid), how);
  }

  /// m, a point in front of the door, or behind it
  [[nodiscard]] Point beside(bool behind) const {
    const Point across{-along_.y, along_.x};
    const double half = cells_ * square_ / 2.0;
    return Point{low_.x * square_ + half, low_.y * square_ + half} + middle_ +
           (behind ? -1.5 : 1.5) * across;
  }

 private:
  /// 0: floor, 1 and 2: the wall to the two sides of the door, 3: the room's walls
  [[nodiscard]] int side_of(int x, int y) const {
    if (x == 0 || y == 0 || x == cells_ - 1 || y == cells_ - 1) return 3;
    const Point at =
        Point{(x + 0.5 - cells_ / 2.0) * square_, (y + 0.5 - cells_ / 2.0) * square_} - middle_;
    const double u = at.x * along_.x + at.y * along_.y, v = at.y * along_.x - at.x * along_.y;
    if (u < -half_gap_ && std::abs(v) <= half_wall_) return 1;
    if (u > half_gap_ && std::abs(v - shift_) <= half_wall_) return 2;
    return 0;
  }
  /// Those of a side that floor lies beside.
  [[nodiscard]] std::vector<map::Cell> squares(int side) const {
    const auto at = [&](int x, int y) { return side_[static_cast<std::size_t>(y * cells_ + x)]; };
    std::vector<map::Cell> out;
    for (int y = 1; y < cells_ - 1; ++y) {
      for (int x = 1; x < cells_ - 1; ++x) {
        const bool beside =
            at(x - 1, y) == 0 || at(x + 1, y) == 0 || at(x, y - 1) == 0 || at(x, y + 1) == 0;
        if (at(x, y) == side && beside) out.push_back({x, y});
      }
    }
    return out;
  }

  double square_;
  Point along_;   // the wall, of length 1
  Point middle_;  // m, of the door from the room's middle
  double half_gap_ = 0.0;
  double half_wall_ = 0.0;
  double shift_ = 0.0;  // m, of one side across the wall
  int cells_ = 0;       // along the room's sides
  map::Cell low_;
  std::vector<int> side_;  // of each square, row by row
};

inline mesh::Mesh mesh_of(const bake::BakedMap& map) {
  std::vector<mesh::GridPolygon> all;
  for (const auto& [tile, polygons] : map.tiles)
    all.insert(all.end(), polygons.begin(), polygons.end());
  return mesh::join(all, map.floor->cell_size() / map::kStepsPerCellSide);
}

inline bool leads_through(const Door& door, const bake::MapBakeConfig& config) {
  const mesh::Mesh mesh = mesh_of(bake::bake_map(door.survey(config.margin), config));
  const auto front = mesh.locate(door.beside(false), 0.0);
  const auto back = mesh.locate(door.beside(true), 0.0);
  EXPECT_TRUE(front && back);
  return front && back &&
         mesh.polygon(front->polygon).component == mesh.polygon(back->polygon).component;
}

/// Doors 3 to 20 cm wider than the robot must lead through, those up to 10 cm narrower must not.
/// \param first, last  seeds, a door each; the last excluded
inline void expect_doors_judged_by_width(unsigned first, unsigned last) {
  int wide = 0, narrow = 0;
  for (unsigned seed = first; seed < last; ++seed) {
    std::mt19937 random(seed);
    const double square = std::array{0.025, 0.05, 0.1, 0.04, 0.0625}[seed % 5];
    bake::MapBakeConfig config;
    config.threads = 1;
    config.tile_size = seed % 3 == 0 ? 32.0 : 4.0;
    config.margin = std::array{0.35, 0.345, 0.35, 0.33, 0.35, 0.37, 0.355}[seed % 7];
    Door door(random, square);
    const auto spare = [&] { return door.width() - 2.0 * config.margin; };
    while (!(spare() >= 0.03 && spare() <= 0.2) && !(spare() <= -1e-9 && spare() >= -0.1))
      door = Door(random, square);
    const bool is_wide = spare() > 0.0;
    EXPECT_EQ(leads_through(door, config), is_wide)
        << "seed " << seed << ": squares of " << square << " m, margin " << config.margin
        << " m, door " << door.width() << " m";
    ++(is_wide ? wide : narrow);
  }
  EXPECT_GT(wide, static_cast<int>(last - first) / 2);
  EXPECT_GT(narrow, static_cast<int>(last - first) / 5);
}

}  // namespace navvi_nav
