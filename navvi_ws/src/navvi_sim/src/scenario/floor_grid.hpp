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

  using Cells = std::vector<std::uint32_t>;

  static constexpr std::size_t kFineCells = 2'000'000;

  /// \param floor_height  m; taken to the nearest border of voxels
  /// \param robot_height  m, headroom
  /// \param reach  m, 180 cells at most: larger clearances are not told apart
  /// Where the map has more than kFineCells voxels of ground, a cell is several voxels wide, and
  /// open only where all of them are.
  FloorGrid(const occupancy::OccupancyMap& map, double floor_height, double robot_height,
            double reach);

  [[nodiscard]] std::size_t size() const { return gap2_.size(); }
  [[nodiscard]] double cell_size() const { return cell_size_; }  ///< m
  [[nodiscard]] Eigen::Vector2d centre(std::size_t cell) const;  ///< m, in map
  /// The cell that holds a point of map, or kNone outside of the grid.
  [[nodiscard]] std::size_t cell_at(const Eigen::Vector2d& point) const;
  /// m, from the cell's centre to the nearest edge of a cell that is blocked or has no floor; 0 for
  /// such a cell, and `reach` or more where there is none nearer than that.
  [[nodiscard]] double clearance(std::size_t cell) const { return clearance_of(gap2_[cell]); }
  /// The cells with a clearance of `least` m or more, in order. \param least  up to `reach`
  [[nodiscard]] Cells cells_clear_by(double least) const;

  /// Of the 8 directions, in how many something stands: for each cell. In a room it is in all but
  /// those that lead out through a door.
  [[nodiscard]] std::vector<std::uint8_t> walls_around() const;

  /// Calls `visit` with the first cell of each row whose centre lies in `box`, and the one after
  /// the last.
  template <typename Visit>
  void for_each_row_in(const Eigen::AlignedBox2d& box, Visit visit) const {
    const auto from = [&](double low, double corner) {
      return static_cast<std::size_t>(std::max(0.0, std::ceil((low - corner) / cell_size_ - 0.5))) +
             1;
    };
    const auto to = [&](double high, double corner, std::size_t count) {
      const double last = std::floor((high - corner) / cell_size_ - 0.5) + 1.0;
      return static_cast<std::size_t>(std::clamp(last, 0.0, static_cast<double>(count - 2))) + 1;
    };
    const std::size_t begin_x = from(box.min().x(), corner_.x());
    const std::size_t end_x = to(box.max().x(), corner_.x(), width_);
    const std::size_t end_y = to(box.max().y(), corner_.y(), height_);
    for (std::size_t y = from(box.min().y(), corner_.y()); y < end_y && begin_x < end_x; ++y)
      visit(y * width_ + begin_x, y * width_ + end_x);
  }

  /// Shortest ways over cells with a clearance of `least` or more (and `start` itself), in steps
  /// to the 8 neighbours.
  struct Ways {
    std::vector<float> length;  ///< m, from the start; +-infinite where no way leads
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
  /// Calls `visit` with each of the 8 neighbours of a cell that is not in the rim, in their order,
  /// and the length of the step there, m.
  template <typename Visit>
  void for_each_neighbour(std::size_t cell, Visit visit) const;

  /// \param low_x, low_y  voxels, of the grid's corner
  /// \param floor  voxels \param factor  voxels, of a cell's side
  /// \return for each cell, whether there is floor with headroom
  [[nodiscard]] std::vector<std::uint8_t> mark(const occupancy::OccupancyMap& map, int low_x,
                                               int low_y, int floor, double headroom,
                                               unsigned factor);
  void measure_clearance(const std::vector<std::uint8_t>& open, double reach);
  /// m \param gap2  cells squared, between the centres of a cell and of one that is closed
  [[nodiscard]] double clearance_of(int gap2) const {
    return std::max(0.0, (std::sqrt(static_cast<double>(gap2)) - std::sqrt(0.5)) * cell_size_);
  }
  /// The least of gap2_, but 0, of a clearance of `least`.
  [[nodiscard]] int gap2_of(double least) const;

  double cell_size_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();  ///< m, lower left, without the rim
  // Around the grid is a rim of one cell that is closed and not blocked: there is no floor.
  std::size_t width_ = 2;              ///< cells along x
  std::size_t height_ = 2;             ///< cells along y
  std::vector<std::uint8_t> blocked_;  ///< by what stands; a cell may be neither
  std::vector<std::uint16_t> gap2_;    ///< as of clearance_of
};

}  // namespace navvi_sim::scenario
