#include "scenario/floor_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::scenario {
namespace {

constexpr std::size_t kMaxCells = 200'000'000;
constexpr double kFar = 1e12;  // cells squared

/// Squared distance transform of a row of samples (Felzenszwalb and Huttenlocher, 2012).
void transform(std::vector<double>& f, std::vector<double>& out, std::vector<std::size_t>& sites,
               std::vector<double>& borders) {
  const std::size_t n = f.size();
  const auto at = [](std::size_t i) { return static_cast<double>(i); };
  std::size_t k = 0;
  sites[0] = 0;
  borders[0] = -kFar;
  borders[1] = kFar;
  for (std::size_t q = 1; q < n; ++q) {
    const auto border = [&] {
      const std::size_t p = sites[k];
      return ((f[q] + at(q) * at(q)) - (f[p] + at(p) * at(p))) / (2.0 * (at(q) - at(p)));
    };
    double s = border();
    while (k > 0 && s <= borders[k]) {
      --k;
      s = border();
    }
    if (s <= borders[k]) s = borders[k];
    ++k;
    sites[k] = q;
    borders[k] = s;
    borders[k + 1] = kFar;
  }
  k = 0;
  for (std::size_t q = 0; q < n; ++q) {
    while (borders[k + 1] < at(q)) ++k;
    const double way = at(q) - at(sites[k]);
    out[q] = way * way + f[sites[k]];
  }
}

}  // namespace

FloorGrid::FloorGrid(const occupancy::OccupancyMap& map, double floor_height, double robot_height)
    : cell_size_(map.resolution()) {
  int min_x = occupancy::OccupancyMap::kCenter;
  int min_y = occupancy::OccupancyMap::kCenter;
  int max_x = -occupancy::OccupancyMap::kCenter;
  int max_y = -occupancy::OccupancyMap::kCenter;
  map.for_each_cube([&](const occupancy::OccupiedCube& cube) {
    min_x = std::min(min_x, cube.x);
    min_y = std::min(min_y, cube.y);
    max_x = std::max(max_x, cube.x + cube.side);
    max_y = std::max(max_y, cube.y + cube.side);
  });
  if (min_x >= max_x) return;
  width_ = static_cast<std::size_t>(max_x - min_x);
  height_ = static_cast<std::size_t>(max_y - min_y);
  if (width_ * height_ > kMaxCells)
    throw WorldError("the world covers more than " + std::to_string(kMaxCells) +
                     " voxels of ground; allowed is a smaller world or a coarser resolution");
  corner_ = {min_x * cell_size_, min_y * cell_size_};
  mark(map, min_x, min_y, static_cast<int>(std::lround(floor_height / cell_size_)), robot_height);
  const double excess = static_cast<double>(open_.size()) / static_cast<double>(kFineCells);
  if (excess > 1.0) coarsen(static_cast<std::size_t>(std::ceil(std::sqrt(excess))));
  measure_clearance();
}

void FloorGrid::mark(const occupancy::OccupancyMap& map, int low_x, int low_y, int floor,
                     double headroom) {
  blocked_.assign(width_ * height_, false);
  open_.assign(width_ * height_, false);
  map.for_each_cube([&](const occupancy::OccupiedCube& cube) {
    const int top = cube.z + cube.side;
    const bool is_floor = top == floor;
    const bool blocks = top > floor && (cube.z - floor) * cell_size_ < headroom;
    if (!is_floor && !blocks) return;
    const auto side = static_cast<std::size_t>(cube.side);
    const auto x0 = static_cast<std::size_t>(cube.x - low_x);
    const auto y0 = static_cast<std::size_t>(cube.y - low_y);
    for (std::size_t y = y0; y < y0 + side; ++y)
      for (std::size_t x = x0; x < x0 + side; ++x)
        (blocks ? blocked_ : open_)[y * width_ + x] = true;
  });
  for (std::size_t i = 0; i < open_.size(); ++i)
    if (blocked_[i]) open_[i] = false;
}

void FloorGrid::coarsen(std::size_t factor) {
  const std::size_t width = (width_ + factor - 1) / factor;
  const std::size_t height = (height_ + factor - 1) / factor;
  // What lies beyond the map is closed, and so are the cells that reach there.
  std::vector<bool> open(width * height, false);
  std::vector<bool> blocked(width * height, false);
  for (std::size_t i = 0; i < blocked_.size(); ++i)
    if (blocked_[i]) blocked[i / width_ / factor * width + i % width_ / factor] = true;
  for (std::size_t y = 0; y < height_ / factor; ++y)
    for (std::size_t x = 0; x < width_ / factor; ++x) {
      bool all = true;
      for (std::size_t i = 0; i < factor * factor && all; ++i)
        all = open_[(y * factor + i / factor) * width_ + x * factor + i % factor];
      open[y * width + x] = all;
    }
  open_ = std::move(open);
  blocked_ = std::move(blocked);
  width_ = width;
  height_ = height;
  cell_size_ *= static_cast<double>(factor);
}

void FloorGrid::measure_clearance() {
  // A rim of closed cells around the grid: beyond it there is no floor.
  const std::size_t w = width_ + 2;
  const std::size_t h = height_ + 2;
  std::vector<double> squared(w * h, 0.0);
  for (std::size_t y = 0; y < height_; ++y)
    for (std::size_t x = 0; x < width_; ++x)
      if (open_[y * width_ + x]) squared[(y + 1) * w + x + 1] = kFar / 4.0;
  const std::size_t longest = std::max(w, h);
  std::vector<std::size_t> sites(longest);
  std::vector<double> borders(longest + 1);
  std::vector<double> line(h);
  std::vector<double> out(h);
  for (std::size_t x = 0; x < w; ++x) {
    for (std::size_t y = 0; y < h; ++y) line[y] = squared[y * w + x];
    transform(line, out, sites, borders);
    for (std::size_t y = 0; y < h; ++y) squared[y * w + x] = out[y];
  }
  line.resize(w);
  out.resize(w);
  clearance_.assign(width_ * height_, 0.0);
  for (std::size_t y = 1; y + 1 < h; ++y) {
    for (std::size_t x = 0; x < w; ++x) line[x] = squared[y * w + x];
    transform(line, out, sites, borders);
    for (std::size_t x = 1; x + 1 < w; ++x)
      // To the edge of the closed cell, seen from its side that is the farthest in.
      clearance_[(y - 1) * width_ + x - 1] =
          std::max(0.0, (std::sqrt(out[x]) - std::sqrt(0.5)) * cell_size_);
  }
}

std::vector<std::uint8_t> FloorGrid::walls_around() const {
  std::vector<std::uint8_t> count(size(), 0);
  std::vector<bool> met(size());
  const auto width = static_cast<long>(width_);
  const auto height = static_cast<long>(height_);
  for (long direction = 0; direction < 9; ++direction) {
    const long dx = direction % 3 - 1;
    const long dy = direction / 3 - 1;
    if (dx == 0 && dy == 0) continue;
    // From the side to which the direction leads, so that the cell ahead is known.
    for (long j = 0; j < height; ++j)
      for (long i = 0; i < width; ++i) {
        const long x = dx > 0 ? width - 1 - i : i;
        const long y = dy > 0 ? height - 1 - j : j;
        const auto cell = static_cast<std::size_t>(y * width + x);
        const auto ahead = static_cast<std::size_t>((y + dy) * width + x + dx);
        const bool ends = x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height;
        met[cell] = blocked_[cell] || (!ends && met[ahead]);
        if (met[cell]) ++count[cell];
      }
  }
  return count;
}

Eigen::Vector2d FloorGrid::centre(std::size_t cell) const {
  return corner_ + cell_size_ * Eigen::Vector2d(static_cast<double>(cell % width_) + 0.5,
                                                static_cast<double>(cell / width_) + 0.5);
}

std::size_t FloorGrid::cell_at(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d index = ((point - corner_) / cell_size_).array().floor();
  if (!(index.x() >= 0.0 && index.y() >= 0.0 && index.x() < static_cast<double>(width_) &&
        index.y() < static_cast<double>(height_)))
    return kNone;
  return static_cast<std::size_t>(index.y()) * width_ + static_cast<std::size_t>(index.x());
}

FloorGrid::Ways FloorGrid::ways_from(std::size_t start, double least) const {
  Ways ways{std::vector<float>(size(), std::numeric_limits<float>::infinity()),
            std::vector<std::size_t>(size(), kNone)};
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  ways.length[start] = 0.0F;
  open.push({0.0F, start});
  const auto straight = static_cast<float>(cell_size_);
  const float diagonal = straight * std::sqrt(2.0F);
  while (!open.empty()) {
    const auto [length, cell] = open.top();
    open.pop();
    if (length > ways.length[cell]) continue;
    const auto x = static_cast<long>(cell % width_);
    const auto y = static_cast<long>(cell / width_);
    for (long dy = -1; dy <= 1; ++dy)
      for (long dx = -1; dx <= 1; ++dx) {
        const long nx = x + dx;
        const long ny = y + dy;
        if (nx < 0 || ny < 0 || nx >= static_cast<long>(width_) || ny >= static_cast<long>(height_))
          continue;
        const std::size_t next =
            static_cast<std::size_t>(ny) * width_ + static_cast<std::size_t>(nx);
        const float longer = length + (dx != 0 && dy != 0 ? diagonal : straight);
        if (clearance_[next] < least || longer >= ways.length[next]) continue;
        ways.length[next] = longer;
        ways.before[next] = cell;
        open.push({longer, next});
      }
  }
  return ways;
}

bool FloorGrid::sees(std::size_t from, std::size_t to, double least) const {
  const Eigen::Vector2d start(static_cast<double>(from % width_),
                              static_cast<double>(from / width_));
  const Eigen::Vector2d end(static_cast<double>(to % width_), static_cast<double>(to / width_));
  const Eigen::Vector2d way = end - start;
  const auto steps = static_cast<int>(std::ceil(2.0 * way.cwiseAbs().maxCoeff()));
  for (int i = 1; i < steps; ++i) {
    const Eigen::Vector2d at = start + way * (static_cast<double>(i) / steps);
    const std::size_t cell = static_cast<std::size_t>(std::lround(at.y())) * width_ +
                             static_cast<std::size_t>(std::lround(at.x()));
    if (clearance_[cell] < least) return false;
  }
  return true;
}

std::vector<Eigen::Vector2d> FloorGrid::way_back(const Ways& ways, std::size_t cell,
                                                 double least) const {
  std::vector<std::size_t> cells;
  for (; cell != kNone; cell = ways.before[cell]) cells.push_back(cell);
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
