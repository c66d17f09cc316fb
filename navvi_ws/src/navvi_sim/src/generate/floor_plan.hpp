#pragma once

#include <Eigen/Geometry>
#include <navvi_types/scenario.hpp>
#include <vector>

#include "generate/layout_config.hpp"

namespace navvi_sim::generate {

/// A rectangle on the floor, m, in map.
using Area = Eigen::AlignedBox2d;

[[nodiscard]] inline Area area_of(double west, double south, double east, double north) {
  return {Eigen::Vector2d(west, south), Eigen::Vector2d(east, north)};
}

constexpr double kFlue = 0.3;  // m, between the two racks of a row
constexpr double kRowDepth = 2.3;
constexpr double kPassage = 1.2;  // m, left free beside things in an aisle

/// Where everything of a layout goes, before there is anything: lanes along y, numbered from the
/// west, between which the shelf rows stand; cross-aisles along x, numbered from the docks, between
/// which the blocks lie. The hall's middle is the origin.
class FloorPlan {
 public:
  /// \throws LayoutError for fields that contradict each other
  FloorPlan(const LayoutConfig& config, Random& random);

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int lanes() const { return rows_ + 1; }
  [[nodiscard]] int blocks() const { return blocks_; }
  [[nodiscard]] int crossings() const { return blocks_ + 1; }
  [[nodiscard]] int bays() const { return bays_; }  ///< of a rack

  [[nodiscard]] const Area& hall() const { return hall_; }
  /// From the dock wall to the first cross-aisle; without docks it has no depth.
  [[nodiscard]] const Area& staging() const { return staging_; }
  [[nodiscard]] Area lane(int lane) const;                  ///< from the staging area to the back
  [[nodiscard]] Area cross_aisle(int crossing) const;       ///< from wall to wall
  [[nodiscard]] Area aisle(int lane, int block) const;      ///< a lane beside a block
  [[nodiscard]] Area row(int row, int block) const;         ///< a shelf row in a block
  [[nodiscard]] Area passage(int row, int crossing) const;  ///< a cross-aisle between two lanes

  /// Whether one gets through from end to end.
  [[nodiscard]] bool aisle_open(int lane, int block) const { return aisles_[index(lane, block)]; }
  [[nodiscard]] bool passage_open(int row, int crossing) const {
    return passages_[passage_index(row, crossing)];
  }
  /// Whether a wall stands between the two racks of the row, with a door in each open passage.
  [[nodiscard]] bool walled(int row) const { return walled_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] bool docked(int lane) const { return docked_[static_cast<std::size_t>(lane)]; }
  /// Docks and aisles from the west, aisles block by block; cross-aisles from the docks; rooms from
  /// the west, where walls part them. Smaller ones first where they overlap.
  [[nodiscard]] std::vector<navvi_types::Place> places() const;
  [[nodiscard]] double door() const { return door_; }  ///< m, width of the doors in walls

 private:
  void divide_width(const LayoutConfig& config);
  void divide_length(const LayoutConfig& config);
  void place_walls_and_docks(const LayoutConfig& config);
  void close_ways(double share, Random& random);

  [[nodiscard]] std::size_t index(int lane, int block) const {
    return static_cast<std::size_t>(lane) * static_cast<std::size_t>(blocks_) +
           static_cast<std::size_t>(block);
  }
  [[nodiscard]] std::size_t passage_index(int row, int crossing) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(crossings()) +
           static_cast<std::size_t>(crossing);
  }
  [[nodiscard]] double row_start(int row) const;      ///< x
  [[nodiscard]] double block_start(int block) const;  ///< y

  int rows_ = 0;
  int blocks_ = 0;
  int bays_ = 0;
  double aisle_;
  double cross_aisle_;
  double door_;
  Area hall_;
  Area staging_;
  double first_row_ = 0.0;    ///< x, western edge
  double first_block_ = 0.0;  ///< y, southern edge
  std::vector<bool> aisles_;
  std::vector<bool> passages_;
  std::vector<bool> walled_;
  std::vector<bool> docked_;
};

}  // namespace navvi_sim::generate
