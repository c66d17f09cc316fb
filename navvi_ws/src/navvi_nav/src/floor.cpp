#include "navvi_nav/floor.hpp"

#include <limits>

namespace navvi_nav {
namespace {

constexpr double kTolerance = 1e-9;  // m

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

int squared_gap(int cells) {
  const int between = std::max(0, std::abs(cells) - 1);
  return between * between;
}

}  // namespace

Floor::Floor(Cell origin, int columns, int rows, double cell_size, double height,
             std::vector<Ground> ground, double reach, double margin)
    : origin_(origin),
      columns_(columns),
      rows_(rows),
      cell_size_(cell_size),
      height_(height),
      reach_(reach),
      reach_cells_(static_cast<int>(std::ceil(reach / cell_size)) + 1),
      ground_(std::move(ground)) {
  const double margin_cells = margin / cell_size;
  open_gap2_ = margin_cells * margin_cells - 1e-6;
  measure_gaps();
  find_components();
}

std::size_t Floor::index(Cell cell) const {
  return static_cast<std::size_t>(cell.y - origin_.y) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(cell.x - origin_.x);
}

bool Floor::contains(Cell cell) const {
  return cell.x >= origin_.x && cell.y >= origin_.y && cell.x < origin_.x + columns_ &&
         cell.y < origin_.y + rows_;
}

Cell Floor::cell_at(Point point) const {
  constexpr double kFar = 1e8;
  return {static_cast<int>(std::floor(std::clamp(point.x / cell_size_, -kFar, kFar))),
          static_cast<int>(std::floor(std::clamp(point.y / cell_size_, -kFar, kFar)))};
}

Point Floor::center_of(Cell cell) const {
  return {(cell.x + 0.5) * cell_size_, (cell.y + 0.5) * cell_size_};
}

Ground Floor::ground(Cell cell) const {
  return contains(cell) ? ground_[index(cell)] : Ground::none;
}

int Floor::gap2(Cell cell) const { return contains(cell) ? gap2_[index(cell)] : 0; }

bool Floor::open(Cell cell) const {
  return ground(cell) == Ground::floor && gap2(cell) >= open_gap2_;
}

bool Floor::any_open() const {
  return std::any_of(component_.begin(), component_.end(), [](std::int32_t c) { return c >= 0; });
}

int Floor::component(Cell cell) const { return contains(cell) ? component_[index(cell)] : -1; }

double Floor::gap(Cell cell) const {
  return std::min(reach_, std::sqrt(static_cast<double>(gap2(cell))) * cell_size_);
}

/// Two passes: the gap along each column, then the least sum over each row within reach.
void Floor::measure_gaps() {
  const int reach = reach_cells_;
  const int cap =
      std::min(reach * reach, static_cast<int>(std::numeric_limits<std::uint16_t>::max()));
  const auto width = static_cast<std::size_t>(columns_);
  std::vector<std::uint16_t> along_column(ground_.size(), 0);
  const auto sweep = [&](int begin, int end, int step, bool first) {
    for (int x = 0; x < columns_; ++x) {
      int steps = 0;  // the row beyond the grid blocks
      for (int y = begin; y != end; y += step) {
        const std::size_t at = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
        steps = ground_[at] == Ground::floor ? std::min(steps + 1, reach + 1) : 0;
        const auto value = static_cast<std::uint16_t>(steps);
        along_column[at] = first ? value : std::min(along_column[at], value);
      }
    }
  };
  sweep(0, rows_, 1, true);
  sweep(rows_ - 1, -1, -1, false);

  gap2_.assign(ground_.size(), 0);
  std::vector<int> column(static_cast<std::size_t>(columns_ + 2 * reach));
  std::vector<int> row(width);
  for (int y = 0; y < rows_; ++y) {
    const std::size_t base = static_cast<std::size_t>(y) * width;
    std::fill(column.begin(), column.end(), 0);
    for (std::size_t x = 0; x < width; ++x) {
      const int steps = along_column[base + x];
      column[x + static_cast<std::size_t>(reach)] = steps == 0 ? 0 : squared_gap(steps);
    }
    std::fill(row.begin(), row.end(), cap);
    for (int shift = -reach; shift <= reach; ++shift) {
      const int aside = squared_gap(shift);
      const int* from = column.data() + reach + shift;
      for (std::size_t x = 0; x < width; ++x) row[x] = std::min(row[x], from[x] + aside);
    }
    for (std::size_t x = 0; x < width; ++x) {
      if (ground_[base + x] == Ground::floor) gap2_[base + x] = static_cast<std::uint16_t>(row[x]);
    }
  }
}

void Floor::find_components() {
  component_.assign(ground_.size(), -1);
  std::vector<Cell> waiting;
  int count = 0;
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      const Cell seed{origin_.x + x, origin_.y + y};
      if (!open(seed) || component(seed) >= 0) continue;
      component_[index(seed)] = count;
      waiting.push_back(seed);
      while (!waiting.empty()) {
        const Cell cell = waiting.back();
        waiting.pop_back();
        for (const Cell next : {Cell{cell.x + 1, cell.y}, Cell{cell.x - 1, cell.y},
                                Cell{cell.x, cell.y + 1}, Cell{cell.x, cell.y - 1}}) {
          if (!open(next) || component(next) >= 0) continue;
          component_[index(next)] = count;
          waiting.push_back(next);
        }
      }
      ++count;
    }
  }
}

double Floor::clearance(Point point) const {
  const Cell at = cell_at(point);
  const double known = gap(at);
  if (known >= reach_) return reach_;
  const int window = static_cast<int>(std::ceil(known / cell_size_)) + 3;
  double best = reach_;
  for (int y = at.y - window; y <= at.y + window; ++y) {
    for (int x = at.x - window; x <= at.x + window; ++x) {
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
      for (int x = cell.x - window; x <= cell.x + window; ++x) {
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

}  // namespace navvi_nav
