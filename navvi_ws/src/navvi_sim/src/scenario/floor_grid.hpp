#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "navvi_sim/occupancy/occupancy_map.hpp"

namespace navvi_sim::scenario {

/// An OctoMap seen from above: where there is floor with headroom, and how far each place is from
/// where there is none.
class FloorGrid {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  static constexpr std::size_t kFineCells = 2'000'000;

  /// \param floor_height  m; taken to the nearest border of voxels
  /// \param robot_height  m, headroom
  /// Where the map has more than kFineCells voxels of ground, a cell is several voxels wide, and
  /// open only where all of them are.
  FloorGrid(const occupancy::OccupancyMap& map, double floor_height, double robot_height);

  [[nodiscard]] std::size_t size() const { return clearance_.size(); }
  [[nodiscard]] double cell_size() const { return cell_size_; }  ///< m
  [[nodiscard]] Eigen::Vector2d centre(std::size_t cell) const;  ///< m, in map
  /// The cell that holds a point of map, or kNone outside of the grid.
  [[nodiscard]] std::size_t cell_at(const Eigen::Vector2d& point) const;
  /// m, from the cell's centre to the nearest edge of a cell that is blocked or has no floor; 0 for
  /// such a cell.
  [[nodiscard]] double clearance(std::size_t cell) const { return clearance_[cell]; }

  /// Of the 8 directions, in how many something stands: for each cell. In a room it is in all but
  /// those that lead out through a door.
  [[nodiscard]] std::vector<std::uint8_t> walls_around() const;

  /// Calls `visit` with each cell whose centre lies in `box`.
  template <typename Visit>
  void for_each_in(const Eigen::AlignedBox2d& box, Visit visit) const {
    const auto from = [&](double low, double corner) {
      return static_cast<std::size_t>(std::max(0.0, std::ceil((low - corner) / cell_size_ - 0.5)));
    };
    const auto to = [&](double high, double corner, std::size_t count) {
      const double last = std::floor((high - corner) / cell_size_ - 0.5) + 1.0;
      return static_cast<std::size_t>(std::clamp(last, 0.0, static_cast<double>(count)));
    };
    const std::size_t end_x = to(box.max().x(), corner_.x(), width_);
    const std::size_t end_y = to(box.max().y(), corner_.y(), height_);
    for (std::size_t y = from(box.min().y(), corner_.y()); y < end_y; ++y)
      for (std::size_t x = from(box.min().x(), corner_.x()); x < end_x; ++x) visit(y * width_ + x);
  }

  /// Shortest ways over cells with a clearance of `least` or more (and `start` itself), in steps
  /// to the 8 neighbours.
  struct Ways {
    std::vector<float> length;  ///< m, from the start; infinite where no way leads
  };
  [[nodiscard]] Ways ways_from(std::size_t start, double least) const;
  /// The cell before `cell` on the way: of several, the one nearest to the start, and then the
  /// first of the grid; kNone for the start.
  [[nodiscard]] std::size_t before(const Ways& ways, std::size_t cell) const;

  /// From `cell` to where the ways begin, pulled taut: each line goes as far as it sees with a
  /// clearance of `least`. m, in map
  [[nodiscard]] std::vector<Eigen::Vector2d> way_back(const Ways& ways, std::size_t cell,
                                                      double least) const;

  /// Whether the straight line between the centres of two cells keeps a clearance of `least`.
  [[nodiscard]] bool sees(std::size_t from, std::size_t to, double least) const;

 private:
  /// Calls `visit` with each of the 8 neighbours of a cell, in their order, and the length of the
  /// step there, m.
  template <typename Visit>
  void for_each_neighbour(std::size_t cell, Visit visit) const;

  /// \param low_x, low_y  voxels, of the grid's corner
  /// \param floor  voxels
  void mark(const occupancy::OccupancyMap& map, int low_x, int low_y, int floor, double headroom);
  void coarsen(std::size_t factor);
  void measure_clearance();

  double cell_size_;
  Eigen::Vector2d corner_;  ///< m, lower left
  std::size_t width_ = 0;   ///< cells along x
  std::size_t height_ = 0;  ///< cells along y
  std::vector<bool> open_;
  std::vector<bool> blocked_;  ///< by what stands; a cell may be neither
  std::vector<double> clearance_;
};

}  // namespace navvi_sim::scenario
