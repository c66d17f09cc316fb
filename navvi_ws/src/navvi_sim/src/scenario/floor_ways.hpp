#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <navvi_floor/floor.hpp>
#include <navvi_floor/octomap_reader.hpp>
#include <navvi_floor/survey.hpp>
#include <vector>

namespace navvi_sim::scenario {

/// How a map is surveyed for a robot that stays on the level of its floor. \param floor  m, z
/// \param headroom  m
[[nodiscard]] navvi_floor::SurveyConfig level_survey(double floor, double headroom);

/// The floor that navigation drives on, as it reads it from the OctoMap: one of more than 2
/// million columns of voxels in cells several voxels wide. \param floor  m, z
/// \param headroom  m \param reach  m, up to which distances are known
/// \throws WorldError if the map has no floor there, or is too large
[[nodiscard]] navvi_floor::Floor floor_of(const navvi_floor::Voxels& voxels, double floor,
                                          double headroom, double reach);

/// Shortest ways over the cells of a floor, which are numbered row by row.
class FloorWays {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  using Cells = std::vector<std::uint32_t>;

  explicit FloorWays(navvi_floor::Floor floor);

  [[nodiscard]] const navvi_floor::Floor& floor() const { return floor_; }
  [[nodiscard]] std::size_t size() const { return gap2_.size(); }
  [[nodiscard]] std::size_t width() const { return width_; }  ///< cells of a row
  /// For each cell, whether something stands there; a cell may be neither floor nor blocked.
  [[nodiscard]] std::vector<std::uint8_t> blocked() const;
  [[nodiscard]] Eigen::Vector2d centre(std::size_t cell) const;  ///< m, in map
  /// The cell that holds a point of map, or kNone outside of the floor's grid.
  [[nodiscard]] std::size_t cell_at(const Eigen::Vector2d& point) const;
  /// m, at most what a cell's centre is away from where no robot can stand; 0 for such a cell
  [[nodiscard]] double clearance(std::size_t cell) const {
    if (gap2_[cell] == 0) return 0.0;
    return (std::sqrt(static_cast<double>(gap2_[cell] - 1)) + 0.5) * floor_.cell_size();
  }
  /// The cells with a clearance of `least` m or more, in order.
  [[nodiscard]] Cells cells_clear_by(double least) const;

  /// Calls `visit` with the first cell of each row whose centre lies in `box`, and the one after
  /// the last.
  template <typename Visit>
  void for_each_row_in(const Eigen::AlignedBox2d& box, Visit visit) const {
    const auto from = [&](double low, int first) {
      return std::max(0, static_cast<int>(std::ceil(low / floor_.cell_size() - 0.5)) - first);
    };
    const auto to = [&](double high, int first, int count) {
      return std::min(count,
                      static_cast<int>(std::floor(high / floor_.cell_size() - 0.5)) + 1 - first);
    };
    const navvi_floor::Cell low = floor_.origin();
    const int begin = from(box.min().x(), low.x), end = to(box.max().x(), low.x, floor_.columns());
    const int top = to(box.max().y(), low.y, floor_.rows());
    for (int y = from(box.min().y(), low.y); y < top && begin < end; ++y)
      visit(number(begin, y), number(end, y));
  }

  /// Ways over cells with a clearance of `least` or more (and `start` itself), in steps to the 8
  /// neighbours.
  struct Ways {
    std::vector<float> length;  ///< m, from the start; +-infinite where no way leads
  };
  [[nodiscard]] Ways ways_from(std::size_t start, double least) const;
  /// The cell before `cell` on the way: of several, the one nearest to the start, and then the
  /// first of the grid; kNone for the start.
  [[nodiscard]] std::size_t before(const Ways& ways, std::size_t cell) const;
  /// Numbers the parts of the floor that hang together by such ways, from 1; 0 for all other cells.
  [[nodiscard]] std::vector<std::uint32_t> parts(double least) const;

 private:
  /// Calls `visit` with each of the 8 neighbours of a cell that is not in the rim, in their order,
  /// and the length of the step there, m.
  template <typename Visit>
  void for_each_neighbour(std::size_t cell, Visit visit) const;
  /// \param x, y  from the floor's lower corner; -1 and its size are the rim
  [[nodiscard]] std::size_t number(int x, int y) const {
    return static_cast<std::size_t>(y + 1) * width_ + static_cast<std::size_t>(x + 1);
  }
  /// The least of gap2_ of a clearance of `least`.
  [[nodiscard]] int gap2_of(double least) const;

  navvi_floor::Floor floor_;
  std::size_t width_;                ///< cells along x, with a rim of one that nothing leads over
  std::vector<std::uint16_t> gap2_;  ///< 0: no robot can stand there; else 1 + Floor::gap2_row
};

}  // namespace navvi_sim::scenario
