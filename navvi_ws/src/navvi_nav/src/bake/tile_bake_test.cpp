#include "bake/tile_bake.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace navvi_nav::bake {
namespace {

constexpr int kSteps = map::kStepsPerCellSide;

/// Open cells anywhere, by a function of the cell.
class Field {
 public:
  Field(int columns, int rows)
      : columns_(columns), rows_(rows), open_(static_cast<std::size_t>(columns * rows), 0) {}

  [[nodiscard]] bool open(int x, int y) const {
    return x >= 0 && y >= 0 && x < columns_ && y < rows_ && open_[at(x, y)] != 0;
  }
  void set(int x, int y, bool open) {
    if (x >= 0 && y >= 0 && x < columns_ && y < rows_) open_[at(x, y)] = open ? 1 : 0;
  }
  [[nodiscard]] TileCells tile(map::Cell origin, int size) const {
    TileCells out{origin, size, {}, {}};
    for (int y = -1; y <= size; ++y) {
      for (int x = -1; x <= size; ++x) out.open.push_back(open(origin.x + x, origin.y + y) ? 1 : 0);
    }
    return out;
  }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int count() const {
    int sum = 0;
    for (const char cell : open_) sum += cell;
    return sum;
  }

 private:
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y * columns_ + x);
  }
  int columns_, rows_;
  std::vector<char> open_;
};

/// Free ground with round and square things on it, or noise, or a labyrinth of narrow ways.
Field random_field(unsigned seed, int columns, int rows) {
  std::mt19937 random(seed);
  const auto pick = [&random](int count) {
    return static_cast<int>(random() % static_cast<unsigned>(count));
  };
  Field field(columns, rows);
  const int kind = static_cast<int>(seed % 4);
  const int open_of_10 = kind == 0 ? 5 : kind == 1 ? 9 : 10;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) field.set(x, y, pick(10) < open_of_10);
  }
  for (int thing = 0; kind >= 2 && thing < columns * rows / 60; ++thing) {
    const int cx = pick(columns), cy = pick(rows), reach = 1 + pick(kind == 2 ? 8 : 3);
    const bool round = pick(2) == 0;
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        if (!round || x * x + y * y <= reach * reach) field.set(cx + x, cy + y, false);
      }
    }
  }
  return field;
}

std::int64_t twice_area(const mesh::GridPolygon& polygon) {
  std::int64_t sum = 0;
  const auto& c = polygon.corners;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const auto& next = c[(i + 1) % c.size()];
    sum +=
        static_cast<std::int64_t>(c[i][0]) * next[1] - static_cast<std::int64_t>(next[0]) * c[i][1];
  }
  return sum;
}

std::int64_t twice_area(const std::vector<mesh::GridPolygon>& polygons) {
  std::int64_t sum = 0;
  for (const mesh::GridPolygon& polygon : polygons) sum += twice_area(polygon);
  return sum;
}

/// Strictly, of a point in half steps.
bool holds(const mesh::GridPolygon& polygon, int x2, int y2) {
  const auto& c = polygon.corners;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const auto& b = c[(i + 1) % c.size()];
    const std::int64_t side = static_cast<std::int64_t>(b[0] - c[i][0]) * (y2 - 2 * c[i][1]) -
                              static_cast<std::int64_t>(b[1] - c[i][1]) * (x2 - 2 * c[i][0]);
    if (side <= 0) return false;
  }
  return true;
}

bool convex(const mesh::GridPolygon& polygon) {
  const auto& c = polygon.corners;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const auto& a = c[i];
    const auto& b = c[(i + 1) % c.size()];
    const auto& d = c[(i + 2) % c.size()];
    if (static_cast<std::int64_t>(b[0] - a[0]) * (d[1] - b[1]) <
        static_cast<std::int64_t>(b[1] - a[1]) * (d[0] - b[0]))
      return false;
  }
  return c.size() >= 3 && twice_area(polygon) > 0;
}

/// True if the place, in half steps, lies in an open cell or at most `grow` steps beside one.
bool near_open(const Field& field, int x2, int y2, int grow) {
  const auto cell = [](int at2) { return at2 >= 0 ? at2 / (2 * kSteps) : -1; };
  for (int y = cell(y2 - 2 * grow); y <= cell(y2 + 2 * grow); ++y) {
    for (int x = cell(x2 - 2 * grow); x <= cell(x2 + 2 * grow); ++x) {
      if (field.open(x, y)) return true;
    }
  }
  return false;
}

std::vector<mesh::GridPolygon> bake_all(const Field& field, int size, const BakeConfig& config) {
  std::vector<mesh::GridPolygon> out;
  for (int y = 0; y < field.rows(); y += size) {
    for (int x = 0; x < field.columns(); x += size) {
      for (mesh::GridPolygon& polygon : bake_tile(field.tile({x, y}, size), config))
        out.push_back(std::move(polygon));
    }
  }
  return out;
}

TEST(TileBake, makes_nothing_of_a_tile_without_open_cells) {
  EXPECT_TRUE(bake_tile(Field(32, 32).tile({0, 0}, 32), {}).empty());
}

TEST(TileBake, makes_one_polygon_of_an_open_tile_and_of_a_lone_cell) {
  Field field(32, 32);
  field.set(4, 5, true);
  const auto lone = bake_tile(field.tile({0, 0}, 32), {});
  ASSERT_EQ(lone.size(), 1U);
  EXPECT_EQ(twice_area(lone), 2 * kSteps * kSteps);
  for (int i = 0; i < 32 * 32; ++i) field.set(i % 32, i / 32, true);
  const auto all = bake_tile(field.tile({0, 0}, 32), {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(twice_area(all), 2 * 32 * 32 * kSteps * kSteps);
}

TEST(TileBake, covers_exactly_the_open_cells_if_nothing_is_smoothed_or_grown) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const Field field = random_field(seed, 64, 32);
    BakeConfig config;
    config.contour_error = 0.0;
    config.merge_region = static_cast<int>(seed % 3) * 100;
    config.max_corners = seed % 2 == 0 ? 12 : 3;
    config.watershed = seed >= 12;
    for (const int size : {32, 64}) {
      const auto polygons = bake_all(field, size, config);
      EXPECT_EQ(twice_area(polygons), std::int64_t{2} * field.count() * kSteps * kSteps) << seed;
      for (const mesh::GridPolygon& polygon : polygons) ASSERT_TRUE(convex(polygon)) << seed;
    }
  }
}

TEST(TileBake, covers_no_point_twice_and_none_beyond_the_grown_open_cells) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Field field = random_field(seed, 64, 64);
    BakeConfig config;
    config.contour_error = 0.5 * static_cast<double>(seed % 4);
    config.grow = static_cast<int>(seed % 3) * 4;
    config.watershed = seed >= 20;
    const auto polygons = bake_all(field, 32, config);
    std::mt19937 random(seed);
    for (const mesh::GridPolygon& polygon : polygons) ASSERT_TRUE(convex(polygon)) << seed;
    for (int probe = 0; probe < 1500; ++probe) {
      const int x2 = static_cast<int>(random() % (128 * kSteps)) | 1;
      const int y2 = static_cast<int>(random() % (128 * kSteps)) | 1;
      int covers = 0;
      for (const mesh::GridPolygon& polygon : polygons) covers += holds(polygon, x2, y2) ? 1 : 0;
      ASSERT_LE(covers, 1) << seed;
      if (covers == 1) {
        ASSERT_TRUE(near_open(field, x2, y2, config.grow)) << seed << ": " << x2 << ' ' << y2;
      }
    }
  }
}

TEST(TileBake, gives_back_what_whole_cells_took_too_much) {
  Field field(32, 32);
  for (int i = 0; i < 20 * 20; ++i) field.set(5 + i % 20, 5 + i / 20, true);
  BakeConfig config;
  config.grow = 8;
  const auto polygons = bake_tile(field.tile({0, 0}, 32), config);
  EXPECT_EQ(twice_area(polygons), 2 * 21 * 21 * kSteps * kSteps);
}

TEST(TileBake, smooths_a_slanted_wall_at_the_cost_of_its_notches) {
  Field field(66, 66);
  for (int y = 0; y < 66; ++y) {
    for (int x = 0; x < 66; ++x) field.set(x, y, 2 * x + y > 60);
  }
  BakeConfig exact;
  exact.contour_error = 0.0;
  const auto stairs = bake_tile(field.tile({1, 1}, 64), exact);
  const auto smooth = bake_tile(field.tile({1, 1}, 64), {});
  EXPECT_LT(4 * smooth.size(), stairs.size());
  const auto lost = twice_area(stairs) - twice_area(smooth);
  EXPECT_GE(lost, 0);
  EXPECT_LE(lost, 2 * 31 * kSteps * kSteps);
}

}  // namespace
}  // namespace navvi_nav::bake
