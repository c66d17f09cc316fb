#include "scenario/floor_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::scenario {
namespace {

constexpr std::size_t kMaxCells = 200'000'000;
constexpr double kMaxReach = 180.0;  // cells; gap2_ has 16 bits

}  // namespace

FloorGrid::FloorGrid(const occupancy::OccupancyMap& map, double floor_height, double robot_height,
                     double reach)
    : cell_size_(map.resolution()) {
  int min_x = occupancy::OccupancyMap::kCenter;
  int min_y = occupancy::OccupancyMap::kCenter;
  int max_x = -occupancy::OccupancyMap::kCenter;
  int max_y = -occupancy::OccupancyMap::kCenter;
  map.for_each_cube_in(
      [&](const occupancy::OccupiedCube& cube) {
        return cube.x < min_x || cube.x + cube.side > max_x || cube.y < min_y ||
               cube.y + cube.side > max_y;
      },
      [&](const occupancy::OccupiedCube& cube) {
        min_x = std::min(min_x, cube.x);
        min_y = std::min(min_y, cube.y);
        max_x = std::max(max_x, cube.x + cube.side);
        max_y = std::max(max_y, cube.y + cube.side);
      });
  if (min_x >= max_x) return;
  const auto width = static_cast<std::size_t>(max_x - min_x);
  const auto height = static_cast<std::size_t>(max_y - min_y);
  if (width * height > kMaxCells)
    throw WorldError("the world covers more than " + std::to_string(kMaxCells) +
                     " voxels of ground; allowed is a smaller world or a coarser resolution");
  const double excess = static_cast<double>(width * height) / static_cast<double>(kFineCells);
  const auto factor = static_cast<unsigned>(std::ceil(std::sqrt(excess)));
  corner_ = {min_x * cell_size_, min_y * cell_size_};
  width_ = (width + factor - 1) / factor + 2;
  height_ = (height + factor - 1) / factor + 2;
  const std::vector<std::uint8_t> open =
      mark(map, min_x, min_y, static_cast<int>(std::lround(floor_height / cell_size_)),
           robot_height, factor);
  cell_size_ *= static_cast<double>(factor);
  measure_clearance(open, reach);
}

std::vector<std::uint8_t> FloorGrid::mark(const occupancy::OccupancyMap& map, int low_x, int low_y,
                                          int floor, double headroom, unsigned factor) {
  blocked_.assign(width_ * height_, 0);
  std::vector<std::uint16_t> count(width_ * height_, 0);  // voxels of floor
  const auto low = [&](const occupancy::OccupiedCube& cube) {
    return cube.z + cube.side >= floor && (cube.z - floor) * cell_size_ < headroom;
  };
  map.for_each_cube_in(low, [&](const occupancy::OccupiedCube& cube) {
    if (!low(cube)) return;
    const bool blocks = cube.z + cube.side > floor;
    const auto x0 = static_cast<unsigned>(cube.x - low_x);
    const auto y0 = static_cast<unsigned>(cube.y - low_y);
    const unsigned x1 = x0 + static_cast<unsigned>(cube.side);
    const unsigned y1 = y0 + static_cast<unsigned>(cube.side);
    const unsigned first = x0 / factor, last = (x1 - 1) / factor;
    for (unsigned y = y0 / factor; y * factor < y1; ++y) {
      const std::size_t row = (y + 1) * width_ + 1;
      if (blocks) {
        std::fill(&blocked_[row + first], &blocked_[row + last] + 1, std::uint8_t{1});
        continue;
      }
      const unsigned deep = std::min(y1, (y + 1) * factor) - std::max(y0, y * factor);
      const auto add = [&](unsigned x, unsigned wide) {
        count[row + x] = static_cast<std::uint16_t>(count[row + x] + deep * wide);
      };
      for (unsigned x = first; x <= last; ++x) add(x, factor);
      add(first, first * factor - x0);  // what is not of the cube
      add(last, x1 - (last + 1) * factor);
    }
  });
  std::vector<std::uint8_t> open(count.size());
  for (std::size_t i = 0; i < count.size(); ++i)
    open[i] = count[i] == factor * factor && blocked_[i] == 0;
  return open;
}

/// Two passes: how far along each column, then the least sum over each row within reach.
void FloorGrid::measure_clearance(const std::vector<std::uint8_t>& open, double reach) {
  if (reach > kMaxReach * cell_size_)
    throw WorldError("a clearance of " + std::to_string(reach) + " m is more than " +
                     std::to_string(kMaxReach * cell_size_) +
                     " m, the most that is measured over cells of " + std::to_string(cell_size_) +
                     " m; allowed is a narrower robot or a coarser resolution");
  const auto most = static_cast<std::uint8_t>(std::ceil(reach / cell_size_ + std::sqrt(0.5)));
  std::vector<std::uint8_t> steps(open.size(), 0);
  const auto one_more = [most](std::uint8_t step) {
    return static_cast<std::uint8_t>(step + (step < most));
  };
  const std::size_t width = width_, last = open.size() - width;
  for (std::size_t row = width; row < last; row += width) {
    const std::uint8_t* const is_open = &open[row];
    const std::uint8_t* const before = &steps[row - width];
    std::uint8_t* const here = &steps[row];
    for (std::size_t x = 0; x < width; ++x)
      here[x] = is_open[x] != 0 ? one_more(before[x]) : std::uint8_t{0};
  }
  for (std::size_t row = last - width; row > 0; row -= width) {
    const std::uint8_t* const before = &steps[row + width];
    std::uint8_t* const here = &steps[row];
    for (std::size_t x = 0; x < width; ++x) here[x] = std::min(here[x], one_more(before[x]));
  }
  gap2_.assign(open.size(), 0);
  std::vector<std::uint16_t> line(width + 2U * most, 0);  // with as much to either side
  for (std::size_t row = width; row < last; row += width) {
    for (std::size_t x = 0; x < width; ++x)
      line[most + x] = static_cast<std::uint16_t>(steps[row + x] * steps[row + x]);
    std::uint16_t* const least = &gap2_[row];
    std::copy_n(&line[most], width, least);
    for (std::size_t shift = 1; shift <= most; ++shift) {
      const std::uint16_t* const left = &line[most - shift];
      const std::uint16_t* const right = &line[most + shift];
      const auto aside = static_cast<std::uint16_t>(shift * shift);
      for (std::size_t x = 0; x < width; ++x) {
        const auto sum = static_cast<std::uint16_t>(std::min(left[x], right[x]) + aside);
        least[x] = std::min(least[x], sum);
      }
    }
  }
}

int FloorGrid::gap2_of(double least) const {
  int gap2 = 1;
  while (clearance_of(gap2) < least) ++gap2;
  return gap2;
}

FloorGrid::Cells FloorGrid::cells_clear_by(double least) const {
  const int gap2 = gap2_of(least);
  Cells cells;
  cells.reserve(size());
  for (std::uint32_t cell = 0; cell < size(); ++cell)
    if (gap2_[cell] >= gap2) cells.push_back(cell);
  return cells;
}

std::vector<std::uint8_t> FloorGrid::walls_around() const {
  std::vector<std::uint8_t> count(size(), 0), here(width_, 0), ahead(width_, 0);
  // Along a row: from the first that stands on, and up to the last.
  for (std::size_t row = 0; row < size(); row += width_) {
    const std::uint8_t* const stands = &blocked_[row];
    std::size_t first = 0, end = width_;
    while (first < width_ && stands[first] == 0) ++first;
    while (end > first && stands[end - 1] == 0) --end;
    std::uint8_t* const here = &count[row];
    for (std::size_t x = first; x < width_; ++x) ++here[x];
    for (std::size_t x = 0; x < end && first < end; ++x) ++here[x];
  }
  // From row to row, up and down, each straight and to both sides.
  for (const bool up : {true, false}) {
    for (std::size_t side = 0; side < 3; ++side) {
      std::fill(ahead.begin(), ahead.end(), std::uint8_t{0});
      for (std::size_t j = 1; j + 1 < height_; ++j) {
        const std::size_t row = (up ? height_ - 1 - j : j) * width_;
        const std::uint8_t* const stands = &blocked_[row + 1];
        const std::uint8_t* const before = &ahead[side];
        std::uint8_t* const now = &here[1];
        std::uint8_t* const sum = &count[row + 1];
        const std::size_t inner = width_ - 2;
        for (std::size_t x = 0; x < inner; ++x) {
          const auto either = static_cast<std::uint8_t>(stands[x] | before[x]);
          now[x] = either;
          sum[x] = static_cast<std::uint8_t>(sum[x] + either);
        }
        std::swap(here, ahead);
      }
    }
  }
  return count;
}

Eigen::Vector2d FloorGrid::centre(std::size_t cell) const {
  return corner_ + cell_size_ * Eigen::Vector2d(static_cast<double>(cell % width_) - 0.5,
                                                static_cast<double>(cell / width_) - 0.5);
}

std::size_t FloorGrid::cell_at(const Eigen::Vector2d& point) const {
  const Eigen::Array2d index = ((point - corner_) / cell_size_).array().floor() + 1.0;
  if (!(index.x() >= 1.0 && index.y() >= 1.0 && index.x() < static_cast<double>(width_ - 1) &&
        index.y() < static_cast<double>(height_ - 1)))
    return kNone;
  return static_cast<std::size_t>(index.y()) * width_ + static_cast<std::size_t>(index.x());
}

template <typename Visit>
void FloorGrid::for_each_neighbour(std::size_t cell, Visit visit) const {
  const auto straight = static_cast<float>(cell_size_);
  const float diagonal = straight * std::sqrt(2.0F);
  visit(cell - width_ - 1, diagonal);
  visit(cell - width_, straight);
  visit(cell - width_ + 1, diagonal);
  visit(cell - 1, straight);
  visit(cell + 1, straight);
  visit(cell + width_ - 1, diagonal);
  visit(cell + width_, straight);
  visit(cell + width_ + 1, diagonal);
}

/// Dijkstra's search with buckets (Dial, 1969): within a length of one step the order is of no
/// matter.
FloorGrid::Ways FloorGrid::ways_from(std::size_t start, double least) const {
  constexpr float kEver = std::numeric_limits<float>::infinity();
  const int gap2 = gap2_of(least);
  Ways ways{std::vector<float>(size())};
  for (std::size_t cell = 0; cell < size(); ++cell)
    ways.length[cell] = gap2_[cell] >= gap2 ? kEver : -kEver;  // nothing is shorter than that
  struct Entry {
    float length;
    std::uint32_t cell;
  };
  std::array<std::vector<Entry>, 4> open;  // by steps: those of now, and up to three more
  ways.length[start] = 0.0F;
  open[0].push_back({0.0F, static_cast<std::uint32_t>(start)});
  for (std::size_t now = 0, empty = 0; empty < open.size(); ++now) {
    std::vector<Entry>& bucket = open[now % open.size()];
    empty = bucket.empty() ? empty + 1 : 0;
    for (std::size_t i = 0; i < bucket.size(); ++i) {  // it may grow meanwhile
      const auto [length, cell] = bucket[i];
      if (length > ways.length[cell]) continue;
      for_each_neighbour(cell, [&, length = length](std::size_t next, float step) {
        const float longer = length + step;
        if (longer >= ways.length[next]) return;
        ways.length[next] = longer;
        const auto steps = static_cast<unsigned>(longer / static_cast<float>(cell_size_));
        open[steps % open.size()].push_back({longer, static_cast<std::uint32_t>(next)});
      });
    }
    bucket.clear();
  }
  return ways;
}

std::size_t FloorGrid::before(const Ways& ways, std::size_t cell) const {
  std::size_t best = kNone;
  for_each_neighbour(cell, [&](std::size_t from, float step) {
    if (ways.length[from] + step == ways.length[cell] &&
        (best == kNone || ways.length[from] < ways.length[best]))
      best = from;
  });
  return best;
}

bool FloorGrid::sees(std::size_t from, std::size_t to, double least) const {
  const auto place = [this](std::size_t cell) {  // without the rim
    return Eigen::Vector2d(static_cast<double>(cell % width_) - 1.0,
                           static_cast<double>(cell / width_) - 1.0);
  };
  const Eigen::Vector2d start = place(from);
  const Eigen::Vector2d way = place(to) - start;
  const auto steps = static_cast<int>(std::ceil(2.0 * way.cwiseAbs().maxCoeff()));
  for (int i = 1; i < steps; ++i) {
    const Eigen::Vector2d at = start + way * (static_cast<double>(i) / steps);
    const std::size_t cell = static_cast<std::size_t>(std::lround(at.y()) + 1) * width_ +
                             static_cast<std::size_t>(std::lround(at.x()) + 1);
    if (clearance(cell) < least) return false;
  }
  return true;
}

std::vector<Eigen::Vector2d> FloorGrid::way_back(const Ways& ways, std::size_t cell,
                                                 double least) const {
  std::vector<std::size_t> cells;
  for (; cell != kNone; cell = before(ways, cell)) cells.push_back(cell);
  std::vector<Eigen::Vector2d> way{centre(cells.front())};
  for (std::size_t at = 0; at + 1 < cells.size();) {
    std::size_t stride = 1;
    std::size_t next = at + 1;  // the next cell of the way is always seen
    while (next + stride < cells.size() && sees(cells[at], cells[next + stride], least)) {
      next += stride;
      stride *= 2;
    }
    for (; stride > 0; stride /= 2)
      while (next + stride < cells.size() && sees(cells[at], cells[next + stride], least))
        next += stride;
    at = next;
    way.push_back(centre(cells[at]));
  }
  return way;
}

}  // namespace navvi_sim::scenario
