#include "scenario/floor_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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
  // Each row with a rim of one cell in which nothing stands.
  const std::size_t w = width_ + 2;
  std::vector<std::uint8_t> count(size(), 0), here(w, 0), ahead(w, 0);
  const std::vector<std::uint8_t> blocked(blocked_.begin(), blocked_.end());
  // Along a row, from the end to which the direction leads.
  for (std::size_t y = 0; y < height_; ++y) {
    std::uint8_t* row = &count[y * width_];
    const std::uint8_t* stands = &blocked[y * width_];
    bool left = false, right = false;
    for (std::size_t x = 0; x < width_; ++x) {
      left = left || stands[x] != 0;
      if (left) ++row[x];
    }
    for (std::size_t x = width_; x-- > 0;) {
      right = right || stands[x] != 0;
      if (right) ++row[x];
    }
  }
  // From row to row, up and down, each straight and to both sides.
  for (const bool up : {true, false}) {
    for (std::size_t side = 0; side < 3; ++side) {
      std::fill(ahead.begin(), ahead.end(), std::uint8_t{0});
      for (std::size_t j = 0; j < height_; ++j) {
        const std::size_t y = up ? height_ - 1 - j : j;
        for (std::size_t x = 0; x < width_; ++x) {
          here[x + 1] = blocked[y * width_ + x] | ahead[x + side];
          if (here[x + 1]) ++count[y * width_ + x];
        }
        std::swap(here, ahead);
      }
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

template <typename Visit>
void FloorGrid::for_each_neighbour(std::size_t cell, Visit visit) const {
  const auto straight = static_cast<float>(cell_size_);
  const float diagonal = straight * std::sqrt(2.0F);
  const std::size_t x = cell % width_;
  const std::size_t y = cell / width_;
  const std::size_t last_x = std::min(x + 1, width_ - 1);
  const std::size_t last_y = std::min(y + 1, height_ - 1);
  for (std::size_t j = y - std::min<std::size_t>(y, 1); j <= last_y; ++j)
    for (std::size_t i = x - std::min<std::size_t>(x, 1); i <= last_x; ++i)
      if (i != x || j != y) visit(j * width_ + i, i != x && j != y ? diagonal : straight);
}

/// Dijkstra's search with buckets (Dial, 1969): within a length of one step the order is of no
/// matter.
FloorGrid::Ways FloorGrid::ways_from(std::size_t start, double least) const {
  Ways ways{std::vector<float>(size(), std::numeric_limits<float>::infinity())};
  using Entry = std::pair<float, std::size_t>;
  std::array<std::vector<Entry>, 4> open;  // by steps: those of now, and up to three more
  const auto steps = [this](float length) {
    return static_cast<std::size_t>(length / static_cast<float>(cell_size_));
  };
  ways.length[start] = 0.0F;
  open[0].push_back({0.0F, start});
  for (std::size_t now = 0, empty = 0; empty < open.size(); ++now) {
    std::vector<Entry>& bucket = open[now % open.size()];
    empty = bucket.empty() ? empty + 1 : 0;
    for (std::size_t i = 0; i < bucket.size(); ++i) {  // it may grow meanwhile
      const auto [length, cell] = bucket[i];
      if (length > ways.length[cell]) continue;
      for_each_neighbour(cell, [&](std::size_t next, float step) {
        const float longer = length + step;
        if (longer >= ways.length[next] || clearance_[next] < least) return;
        ways.length[next] = longer;
        open[steps(longer) % open.size()].push_back({longer, next});
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
