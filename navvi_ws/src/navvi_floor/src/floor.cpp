#include "navvi_floor/floor.hpp"

#include <cstring>

#include "navvi_floor/parallel.hpp"

namespace navvi_floor {
namespace {

constexpr double kTolerance = 1e-9;  // m
constexpr double kRounding = 1e-6;   // cells, or steps

double distance_to_box(Point p, Point low, Point high) {
  const double dx = std::max({low.x - p.x, 0.0, p.x - high.x});
  const double dy = std::max({low.y - p.y, 0.0, p.y - high.y});
  return norm({dx, dy});
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

/// In what gaps between the squares of two cells are measured.
struct Measure {
  int unit = 1;  ///< units along a cell's side
  int grow = 0;  ///< units, by which one of the two is larger

  /// Units squared between two that lie so many cells apart along one axis.
  [[nodiscard]] int squared_gap(int cells) const {
    const int between = std::max(0, (std::abs(cells) - 1) * unit - grow);
    return between * between;
  }
};

/// How many cells away, along the column, the nearest one is that blocks.
struct ColumnSteps {
  std::vector<std::uint8_t> steps;  ///< row by row
  int stride = 0;                   ///< in a row
  int aside = 0;                    ///< of these, at the left of the area that is measured
};

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

/// Squared gaps of an area's cells: least over the rows within `reach` cells. `store(y, values)`
/// takes each row.
template <typename Number, typename Store>
void for_each_row(const ColumnSteps& columns, const Area& area, int reach, const Measure& measure,
                  const Store& store) {
  // Nothing nearer than `reach` is as far as anything: one more than any sum that counts.
  std::vector<Number> squares(static_cast<std::size_t>(reach) + 2);
  for (int k = 0; k <= reach + 1; ++k)
    squares[static_cast<std::size_t>(k)] = static_cast<Number>(measure.squared_gap(k));
  const int count = area.columns();
  const int aside = columns.aside;
  const int first = std::max(0, aside - reach);
  const int last = std::min(columns.stride, aside + count + reach);
  std::vector<Number> gaps(static_cast<std::size_t>(count + 2 * reach), 0);
  std::vector<Number> row(static_cast<std::size_t>(count));
  for (int y = area.low.y; y < area.high.y; ++y) {
    const std::uint8_t* from =
        columns.steps.data() + static_cast<std::ptrdiff_t>(y - area.low.y) * columns.stride;
    for (int x = first; x < last; ++x)
      gaps[static_cast<std::size_t>(x - aside + reach)] =
          squares[std::min<std::size_t>(from[x], squares.size() - 1)];
    least_over_row(gaps.data(), count, reach, squares, row.data());
    store(y, row.data());
  }
}

}  // namespace

Floor::Floor(FloorGround ground, const FloorDistances& distances, int threads, const Floor* before)
    : origin_(ground.origin),
      cell_size_(ground.cell_size),
      height_(ground.height),
      reach_(std::min(distances.reach, (kMaxReach - 1) * ground.cell_size)),
      reach_cells_(static_cast<int>(std::ceil(reach_ / ground.cell_size - kRounding)) + 1),
      margin_(distances.margin),
      ground_(std::move(ground.ground)) {
  measure(threads, before);
}

Ground Floor::ground(Cell cell) const {
  return contains(cell) ? ground_.at(cell.x - origin_.x, cell.y - origin_.y) : Ground::none;
}

bool Floor::changed(const Area& wanted) const {
  if (changed_.empty()) return true;
  const Area known = clipped(wanted, area());
  for (int y = (known.low.y - origin_.y) / kNote; y * kNote < known.high.y - origin_.y; ++y)
    for (int x = (known.low.x - origin_.x) / kNote; x * kNote < known.high.x - origin_.x; ++x)
      if (changed_[static_cast<std::size_t>(y * notes_across() + x)]) return true;
  return false;
}

void Floor::note_changes(const Floor& before) {
  changed_.resize(static_cast<std::size_t>(notes_across() * ((rows() + kNote - 1) / kNote)));
  const auto differ = [&](int x, int y, int count) {
    return std::memcmp(ground_.row(y) + x, before.ground_.row(y) + x,
                       static_cast<std::size_t>(count)) != 0;
  };
  for (int y = 0; y < rows(); ++y) {
    if (ground_.shares(y, before.ground_)) continue;
    for (int x = 0; x < columns() && differ(x, y, columns() - x); x += kNote)
      if (differ(x, y, std::min(kNote, columns() - x)))
        changed_[static_cast<std::size_t>(y / kNote * notes_across() + x / kNote)] = true;
  }
}

/// Square by square. One around which nothing differs is as before.
void Floor::measure(int threads, const Floor* before) {
  constexpr int kSquare = 256;  // cells
  const double margin_cells = margin_ / cell_size_;
  const double spare = std::ceil(margin_cells - kRounding) - margin_cells;
  grow_ = std::min(kStepsPerCellSide / 2,
                   std::max(0, static_cast<int>(spare * kStepsPerCellSide + kRounding)));
  if (before != nullptr && (before->cell_size_ != cell_size_ || before->reach_ != reach_ ||
                            before->margin_ != margin_ || !(before->area() == area())))
    before = nullptr;
  if (before != nullptr) {
    note_changes(*before);
    gap2_ = before->gap2_;
    open_ = before->open_;
  } else {
    gap2_ = {columns(), rows()};
    open_ = {columns(), rows()};
  }
  std::vector<Area> squares;
  for (Cell low = origin_; low.y < area().high.y; low.y += kSquare) {
    for (low.x = origin_.x; low.x < area().high.x; low.x += kSquare) {
      const Area square = clipped({low, {low.x + kSquare, low.y + kSquare}}, area());
      if (changed(grown(square, influence()))) squares.push_back(square);
    }
  }
  for (const Area& square : squares) {  // before threads write to them
    for (int y = square.low.y; y < square.high.y; ++y) {
      (void)gap2_.own_row(y - origin_.y);
      (void)open_.own_row(y - origin_.y);
    }
  }
  in_parallel(static_cast<int>(squares.size()), threads,
              [&](int i) { measure(squares[static_cast<std::size_t>(i)]); });
}

/// Two passes: how far along each column, then the least sum over each row within reach.
void Floor::measure(const Area& square) {
  const Area around = clipped(grown(square, influence()), area());
  const Area beside{{around.low.x, square.low.y}, {around.high.x, square.high.y}};
  const ColumnSteps columns{steps_along_columns(beside), beside.columns(),
                            square.low.x - beside.low.x};
  const double margin_cells = margin_ / cell_size_;
  const auto is_open = [](auto least) { return [least](auto gap2) { return gap2 >= least; }; };
  const auto keep_open = [&](int y, const auto* row, const auto& far_enough) {
    std::uint8_t* open = open_.own_row(y - origin_.y) + square.low.x - origin_.x;
    for (int x = 0; x < square.columns(); ++x) open[x] = far_enough(row[x]);
  };
  const auto whole = static_cast<std::uint16_t>(std::ceil(margin_cells * margin_cells - kRounding));
  const bool whole_cells = grow_ == 0;
  const auto rough = [&](auto number) {
    using Number = decltype(number);
    for_each_row<Number>(columns, square, reach_cells_, Measure{}, [&](int y, const Number* row) {
      std::copy_n(row, square.columns(), gap2_.own_row(y - origin_.y) + square.low.x - origin_.x);
      if (whole_cells) keep_open(y, row, is_open(std::max<std::uint16_t>(whole, 1)));
    });
  };
  // The least of numbers with a sign is one step to processors, that of others two.
  if (2 * Measure{}.squared_gap(reach_cells_ + 1) <= std::numeric_limits<std::int16_t>::max())
    rough(std::int16_t{0});
  else
    rough(std::uint16_t{0});
  if (whole_cells) return;
  const double margin_steps = margin_cells * kStepsPerCellSide;
  const int far = std::max(1, static_cast<int>(std::ceil(margin_steps * margin_steps - kRounding)));
  const int reach = margin_reach();
  const auto fine = [&](auto number) {
    using Number = decltype(number);
    for_each_row<Number>(
        columns, square, reach, {kStepsPerCellSide, grow_},
        [&](int y, const Number* row) { keep_open(y, row, is_open(static_cast<Number>(far))); });
  };
  if (2 * Measure{kStepsPerCellSide, 0}.squared_gap(reach + 1) <=
      std::numeric_limits<std::uint16_t>::max())
    fine(std::uint16_t{0});
  else
    fine(std::uint32_t{0});
}

/// How many cells away, along the column, the nearest one that blocks is; at most reach_cells_ + 1.
/// What lies beyond the grid blocks.
std::vector<std::uint8_t> Floor::steps_along_columns(const Area& area) const {
  const auto width = static_cast<std::size_t>(area.columns());
  const auto cap = static_cast<std::uint8_t>(reach_cells_ + 1);
  std::vector<std::uint8_t> out(width * static_cast<std::size_t>(area.rows()));
  std::vector<std::uint8_t> steps(width);
  const auto pass = [&](int y) {
    const Ground* here = ground_.row(y - origin_.y) + area.low.x - origin_.x;
    for (std::size_t x = 0; x < width; ++x) {
      const auto next = static_cast<std::uint8_t>(steps[x] + (steps[x] < cap));
      steps[x] = here[x] == Ground::floor ? next : std::uint8_t{0};
    }
  };
  const auto row_of = [&](int y) {
    return out.begin() + static_cast<std::ptrdiff_t>(width) * (y - area.low.y);
  };
  // Whatever blocks beyond these rows is too far away to count.
  const int first = std::max(origin_.y, area.low.y - reach_cells_);
  const int last = std::min(origin_.y + rows(), area.high.y + reach_cells_) - 1;
  for (int y = first; y < area.high.y; ++y) {
    pass(y);
    if (y >= area.low.y) std::copy(steps.begin(), steps.end(), row_of(y));
  }
  std::fill(steps.begin(), steps.end(), std::uint8_t{0});
  for (int y = last; y >= area.low.y; --y) {
    pass(y);
    if (y >= area.high.y) continue;
    const auto to = row_of(y);
    std::transform(steps.begin(), steps.end(), to, to,
                   [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
  }
  return out;
}

double Floor::clearance(Point point, double most) const {
  const Cell at = cell_at(point);
  const double known = gap(at);
  double best = std::min(reach_, most);
  if (known >= reach_ || known > most + kTolerance) return best;
  const int window = static_cast<int>(std::ceil(known / cell_size_)) + 3;
  double far = known + 1.5 * cell_size_;  // from any point of the cell one is nearer
  for (int y = at.y - window; y <= at.y + window; ++y) {
    const double dy = std::max({y * cell_size_ - point.y, 0.0, point.y - (y + 1) * cell_size_});
    if (dy > far) continue;
    for (int x = at.x - window; x <= at.x + window; x += stride({x, y})) {
      const double dx = std::max({x * cell_size_ - point.x, 0.0, point.x - (x + 1) * cell_size_});
      if (dx > far || ground({x, y}) == Ground::floor) continue;
      best = std::min(best, norm({dx, dy}));
      far = std::min(far, best);
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

double Space::clearance(Point point, double most) const {
  double best = floor->clearance(point, most);
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

}  // namespace navvi_floor
