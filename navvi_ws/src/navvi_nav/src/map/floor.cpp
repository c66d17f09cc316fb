#include "map/floor.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "map/parallel.hpp"

namespace navvi_nav::map {
namespace {

constexpr double kTolerance = 1e-9;  // m
constexpr double kRounding = 1e-6;   // cells, or steps

double distance_to_box(Point p, Point low, Point high) {
  const double dx = std::max({low.x - p.x, 0.0, p.x - high.x});
  const double dy = std::max({low.y - p.y, 0.0, p.y - high.y});
  return std::hypot(dx, dy);
}

bool crosses_box(Point a, Point b, Point low, Point high) {
  double from = 0.0;
  double to = 1.0;
  const auto clip = [&](double start, double delta, double min, double max) {
    if (delta == 0.0) return start >= min && start <= max;
    double near = (min - start) / delta;
    double far = (max - start) / delta;
    if (near > far) std::swap(near, far);
    from = std::max(from, near);
    to = std::min(to, far);
    return from <= to;
  };
  return clip(a.x, b.x - a.x, low.x, high.x) && clip(a.y, b.y - a.y, low.y, high.y);
}

double segment_to_box(Point a, Point b, Point low, Point high) {
  if (crosses_box(a, b, low, high)) return 0.0;
  double best = std::min(distance_to_box(a, low, high), distance_to_box(b, low, high));
  for (const Point corner : {low, Point{high.x, low.y}, high, Point{low.x, high.y}})
    best = std::min(best, distance(corner, nearest_on_segment(corner, a, b)));
  return best;
}

/// Units squared between the squares of two cells that lie so many cells apart along one axis, if
/// one is grown by `grow` units. A cell has `unit` units along a side.
int squared_gap(int cells, int unit, int grow) {
  const int between = std::max(0, (std::abs(cells) - 1) * unit - grow);
  return between * between;
}

/// How many cells away, along the column, the nearest one that blocks is; at most `reach` + 1. What
/// lies beyond the grid blocks.
std::vector<std::uint8_t> steps_along_columns(const std::vector<Ground>& ground, int columns,
                                              int rows, int reach, int threads) {
  std::vector<std::uint8_t> out(ground.size());
  constexpr int kBand = 256;
  in_parallel((columns + kBand - 1) / kBand, threads, [&](int band) {
    const int from = band * kBand;
    const int count = std::min(kBand, columns - from);
    const auto at = [&](int y) {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(from);
    };
    const auto cap = static_cast<std::uint8_t>(reach + 1);
    std::array<std::uint8_t, kBand> steps{};
    for (int y = 0; y < rows; ++y) {
      const Ground* here = ground.data() + at(y);
      std::uint8_t* to = out.data() + at(y);
      for (int x = 0; x < count; ++x) {
        const auto next = static_cast<std::uint8_t>(steps[static_cast<std::size_t>(x)] +
                                                    (steps[static_cast<std::size_t>(x)] < cap));
        to[x] = steps[static_cast<std::size_t>(x)] = here[x] == Ground::floor ? next : 0;
      }
    }
    steps.fill(0);
    for (int y = rows - 1; y >= 0; --y) {
      std::uint8_t* to = out.data() + at(y);
      for (int x = 0; x < count; ++x) {
        const auto next = static_cast<std::uint8_t>(steps[static_cast<std::size_t>(x)] +
                                                    (steps[static_cast<std::size_t>(x)] < cap));
        to[x] = steps[static_cast<std::size_t>(x)] = std::min(next, to[x]);
      }
    }
  });
  return out;
}

/// For a row of columns' gaps, with `reach` more on either side: the least of gap + gap along the
/// row, squared, into `row`.
template <typename Number>
void least_over_row(const Number* gaps, int count, int reach, const std::vector<Number>& aside,
                    Number* row) {
  std::copy_n(gaps + reach, count, row);
  for (int shift = 1; shift <= reach; ++shift) {
    const Number add = aside[static_cast<std::size_t>(shift)];
    const Number* left = gaps + reach - shift;
    const Number* right = gaps + reach + shift;
    for (int x = 0; x < count; ++x) {
      const Number least = static_cast<Number>(std::min(left[x], right[x]) + add);
      row[x] = std::min(row[x], least);
    }
  }
}

/// Squared gaps of all cells: least over the rows within `reach` cells, in units. `store(row, x0,
/// values)` takes each row.
template <typename Number, typename Store>
void for_each_row(const std::vector<std::uint8_t>& steps, int columns, int rows, int reach,
                  int unit, int grow, int threads, const Store& store) {
  // Nothing nearer than `reach` is as far as anything: one more than any sum that counts.
  const int farthest = squared_gap(reach + 1, unit, grow);
  std::vector<Number> squares(static_cast<std::size_t>(reach) + 2);
  for (int k = 0; k <= reach + 1; ++k)
    squares[static_cast<std::size_t>(k)] = static_cast<Number>(squared_gap(k, unit, grow));
  squares.back() = static_cast<Number>(farthest);
  constexpr int kBand = 32;
  in_parallel((rows + kBand - 1) / kBand, threads, [&](int band) {
    std::vector<Number> gaps(static_cast<std::size_t>(columns + 2 * reach), 0);
    std::vector<Number> row(static_cast<std::size_t>(columns));
    for (int y = band * kBand; y < std::min(rows, (band + 1) * kBand); ++y) {
      const std::uint8_t* from =
          steps.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(columns);
      for (int x = 0; x < columns; ++x)
        gaps[static_cast<std::size_t>(x + reach)] =
            squares[std::min<std::size_t>(from[x], squares.size() - 1)];
      least_over_row(gaps.data(), columns, reach, squares, row.data());
      store(y, row.data());
    }
  });
}

}  // namespace

Floor::Floor(Cell origin, int columns, int rows, double cell_size, double height,
             std::vector<Ground> ground, double reach, double margin, int threads)
    : origin_(origin),
      columns_(columns),
      rows_(rows),
      cell_size_(cell_size),
      height_(height),
      reach_(std::min(reach, (kMaxReach - 1) * cell_size)),
      reach_cells_(static_cast<int>(std::ceil(reach_ / cell_size - kRounding)) + 1),
      ground_(std::move(ground)) {
  measure(margin, threads);
}

Point Floor::center_of(Cell cell) const {
  return {(cell.x + 0.5) * cell_size_, (cell.y + 0.5) * cell_size_};
}

Ground Floor::ground(Cell cell) const {
  return contains(cell) ? ground_[index(cell)] : Ground::none;
}

bool Floor::same_ground(const Floor& other, Cell low, Cell high) const {
  if (other.origin_.x != origin_.x || other.origin_.y != origin_.y || other.columns_ != columns_ ||
      other.rows_ != rows_)
    return false;
  const int from = std::max(low.x, origin_.x), to = std::min(high.x, origin_.x + columns_);
  for (int y = std::max(low.y, origin_.y); y < std::min(high.y, origin_.y + rows_); ++y) {
    const auto row = static_cast<std::ptrdiff_t>(index({from, y}));
    if (!std::equal(ground_.begin() + row, ground_.begin() + row + std::max(0, to - from),
                    other.ground_.begin() + row))
      return false;
  }
  return true;
}

/// Two passes: how far along each column, then the least sum over each row within reach.
void Floor::measure(double margin, int threads) {
  const auto width = static_cast<std::size_t>(columns_);
  const double margin_cells = margin / cell_size_;
  const double spare = std::ceil(margin_cells - kRounding) - margin_cells;
  grow_ = std::min(kStepsPerCellSide / 2,
                   std::max(0, static_cast<int>(spare * kStepsPerCellSide + kRounding)));
  const std::vector<std::uint8_t> steps =
      steps_along_columns(ground_, columns_, rows_, reach_cells_, threads);
  gap2_.resize(ground_.size());
  open_.resize(ground_.size());
  const auto is_open = [](auto least) { return [least](auto gap2) { return gap2 >= least; }; };
  const auto keep_open = [&](int y, const auto* row, const auto& far_enough) {
    std::uint8_t* open = open_.data() + static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x < width; ++x) open[x] = far_enough(row[x]);
  };
  const auto whole = static_cast<std::uint16_t>(std::ceil(margin_cells * margin_cells - kRounding));
  const bool grown = grow_ > 0;
  for_each_row<std::uint16_t>(
      steps, columns_, rows_, reach_cells_, 1, 0, threads, [&](int y, const std::uint16_t* row) {
        std::copy_n(row, width, gap2_.begin() + static_cast<std::ptrdiff_t>(y) * columns_);
        if (!grown) keep_open(y, row, is_open(std::max<std::uint16_t>(whole, 1)));
      });
  if (!grown) return;
  const double margin_steps = margin_cells * kStepsPerCellSide;
  const int far = std::max(1, static_cast<int>(std::ceil(margin_steps * margin_steps - kRounding)));
  const int reach = static_cast<int>(std::ceil(margin_cells)) + 1;
  const auto fine = [&](auto number) {
    using Number = decltype(number);
    for_each_row<Number>(
        steps, columns_, rows_, reach, kStepsPerCellSide, grow_, threads,
        [&](int y, const Number* row) { keep_open(y, row, is_open(static_cast<Number>(far))); });
  };
  if (2 * squared_gap(reach + 1, kStepsPerCellSide, 0) <= std::numeric_limits<std::uint16_t>::max())
    fine(std::uint16_t{0});
  else
    fine(std::uint32_t{0});
}

double Floor::clearance(Point point) const {
  const Cell at = cell_at(point);
  const double known = gap(at);
  if (known >= reach_) return reach_;
  const int window = static_cast<int>(std::ceil(known / cell_size_)) + 3;
  double best = reach_;
  for (int y = at.y - window; y <= at.y + window; ++y) {
    for (int x = at.x - window; x <= at.x + window; x += stride({x, y})) {
      if (ground({x, y}) == Ground::floor) continue;
      best = std::min(best, distance_to_box(point, {x * cell_size_, y * cell_size_},
                                            {(x + 1) * cell_size_, (y + 1) * cell_size_}));
    }
  }
  return best;
}

std::vector<Cell> Floor::cells_along(Point a, Point b) const {
  std::vector<Cell> cells;
  Cell cell = cell_at(a);
  const Cell last = cell_at(b);
  const Point delta = b - a;
  const int step_x = delta.x > 0 ? 1 : -1;
  const int step_y = delta.y > 0 ? 1 : -1;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto first_border = [&](double start, double along, int at, int step) {
    if (along == 0.0) return kNever;
    return ((step > 0 ? at + 1 : at) * cell_size_ - start) / along;
  };
  double next_x = first_border(a.x, delta.x, cell.x, step_x);
  double next_y = first_border(a.y, delta.y, cell.y, step_y);
  const double each_x = delta.x != 0.0 ? cell_size_ / std::abs(delta.x) : kNever;
  const double each_y = delta.y != 0.0 ? cell_size_ / std::abs(delta.y) : kNever;
  const int steps = std::abs(last.x - cell.x) + std::abs(last.y - cell.y);
  cells.reserve(static_cast<std::size_t>(steps) + 1);
  cells.push_back(cell);
  for (int i = 0; i < steps; ++i) {
    const bool along_x = cell.y == last.y || (cell.x != last.x && next_x < next_y);
    if (along_x) {
      cell.x += step_x;
      next_x += each_x;
    } else {
      cell.y += step_y;
      next_y += each_y;
    }
    cells.push_back(cell);
  }
  return cells;
}

bool Floor::segment_clear(Point a, Point b, double radius) const {
  if (!finite(a) || !finite(b) || !contains(cell_at(a)) || !contains(cell_at(b))) return false;
  const double safe_gap = radius / cell_size_;
  const double safe2 = safe_gap * safe_gap;
  const int window = static_cast<int>(std::ceil(safe_gap)) + 1;
  for (const Cell cell : cells_along(a, b)) {
    if (!contains(cell)) return false;
    const int known = gap2(cell);
    if (ground(cell) != Ground::floor) return false;
    if (known >= safe2) continue;
    for (int y = cell.y - window; y <= cell.y + window; ++y) {
      for (int x = cell.x - window; x <= cell.x + window; x += stride({x, y})) {
        if (ground({x, y}) == Ground::floor) continue;
        if (segment_to_box(a, b, {x * cell_size_, y * cell_size_},
                           {(x + 1) * cell_size_, (y + 1) * cell_size_}) < radius - kTolerance)
          return false;
      }
    }
  }
  return true;
}

double Space::clearance(Point point) const {
  double best = floor->clearance(point);
  for (const Cylinder& cylinder : *cylinders)
    best = std::min(best, distance(point, cylinder.center) - cylinder.radius);
  return best;
}

bool Space::segment_clear(Point a, Point b, double radius) const {
  for (const Cylinder& cylinder : *cylinders) {
    if (distance(cylinder.center, nearest_on_segment(cylinder.center, a, b)) <
        cylinder.radius + radius - kTolerance)
      return false;
  }
  return floor->segment_clear(a, b, radius);
}

}  // namespace navvi_nav::map
