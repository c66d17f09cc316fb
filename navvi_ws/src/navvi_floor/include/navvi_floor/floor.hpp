#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "navvi_floor/geometry.hpp"

namespace navvi_floor {

/// A grid of cells, row by row, in bands of rows. Copies share their bands, so that a copy of a
/// large map costs no more than the bands it writes to.
template <typename Value>
class Bands {
 public:
  static constexpr int kRows = 64;  ///< of a band

  Bands() = default;
  Bands(int columns, int rows, Value value = {}) : Bands(columns, rows, &value, 0) {}
  /// \param values  row by row
  Bands(int columns, int rows, const Value* values) : Bands(columns, rows, values, 1) {}

  [[nodiscard]] bool empty() const { return bands_.empty(); }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] const Value* row(int y) const {
    return bands_[band_of(y)].get() + place_in_band(y);
  }
  [[nodiscard]] Value at(int x, int y) const { return row(y)[x]; }
  /// Whether the row is the same memory in both.
  [[nodiscard]] bool shares(int y, const Bands& other) const { return row(y) == other.row(y); }

  /// A row to write to. Its band is this grid's own from here on: threads may write to different
  /// cells of a band that is.
  [[nodiscard]] Value* own_row(int y) {
    std::shared_ptr<Value[]>& band = bands_[band_of(y)];
    if (band.use_count() > 1) {
      std::shared_ptr<Value[]> own(new Value[band_size()]);
      std::copy_n(band.get(), band_size(), own.get());
      band = std::move(own);
    }
    return band.get() + place_in_band(y);
  }

  [[nodiscard]] bool operator==(const Bands& other) const {
    if (columns_ != other.columns_ || rows_ != other.rows_) return false;
    for (int y = 0; y < rows_; ++y)
      if (!shares(y, other) && !std::equal(row(y), row(y) + columns_, other.row(y))) return false;
    return true;
  }

 private:
  /// \param step  from one value to the next
  Bands(int columns, int rows, const Value* values, std::size_t step)
      : columns_(columns), rows_(rows) {
    for (int y = 0; y < rows; y += kRows) {
      bands_.emplace_back(new Value[band_size()]);
      const std::size_t count =
          static_cast<std::size_t>(std::min(kRows, rows - y)) * static_cast<std::size_t>(columns);
      Value* const band = bands_.back().get();
      (void)(step == 0 ? std::fill_n(band, count, *values) : std::copy_n(values, count, band));
      values += step * count;
      std::fill(bands_.back().get() + count, bands_.back().get() + band_size(), Value{});
    }
  }
  static std::size_t band_of(int y) { return static_cast<unsigned>(y) / kRows; }
  [[nodiscard]] std::size_t place_in_band(int y) const {
    return static_cast<std::size_t>(static_cast<unsigned>(y) % kRows) *
           static_cast<std::size_t>(columns_);
  }
  [[nodiscard]] std::size_t band_size() const {
    return static_cast<std::size_t>(kRows) * static_cast<std::size_t>(columns_);
  }

  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::shared_ptr<Value[]>> bands_;
};

/// Steps to a cell, for places finer than cells; (0, 0) is at the origin of map.
inline constexpr int kStepsPerCellSide = 16;

/// A square of the floor; cell (0, 0) has its lower corner at the origin of map.
struct Cell {
  int x = 0;
  int y = 0;
};

/// Cells, or columns of voxels.
struct Area {
  Cell low;
  Cell high;  ///< one beyond

  [[nodiscard]] int columns() const { return high.x - low.x; }
  [[nodiscard]] int rows() const { return high.y - low.y; }
  [[nodiscard]] bool contains(Cell cell) const {
    return cell.x >= low.x && cell.y >= low.y && cell.x < high.x && cell.y < high.y;
  }
  [[nodiscard]] bool operator==(const Area& other) const {
    return low.x == other.low.x && low.y == other.low.y && high.x == other.high.x &&
           high.y == other.high.y;
  }
};
[[nodiscard]] inline Area grown(const Area& area, int by) {
  return {{area.low.x - by, area.low.y - by}, {area.high.x + by, area.high.y + by}};
}
/// What lies in both.
[[nodiscard]] inline Area clipped(const Area& area, const Area& to) {
  return {{std::max(area.low.x, to.low.x), std::max(area.low.y, to.low.y)},
          {std::min(area.high.x, to.high.x), std::min(area.high.y, to.high.y)}};
}

enum class Ground : std::uint8_t {
  none,      ///< the map shows no floor here
  floor,     ///< floor with head room for the robot
  obstacle,  ///< something stands on the floor or hangs too low
};

/// The ground of a map, cell by cell.
struct FloorGround {
  Cell origin;              ///< the lower cell
  double cell_size = 0.05;  ///< m
  double height = 0.0;      ///< m, z of the floor in map
  Bands<Ground> ground;
};

/// What is to be known of the distances from each cell to what blocks, m.
struct FloorDistances {
  double reach = 0.0;  ///< they are known up to here, but never farther than kMaxReach - 1 cells
  double margin =
      0.0;  ///< an open cell, grown, is at least so far away; at most kMaxReach - 2 cells
};

/// The floor of a map as a grid: what blocks it, and how far each cell is from that. Everything
/// that is not floor blocks. Distances run from square to square, so they are never more than the
/// true distance between any two points of the cells.
class Floor {
 public:
  static constexpr int kMaxReach = 180;  ///< cells: squares of distances fit 16 bits
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  Floor() = default;
  /// \param threads  that may share the work
  /// \param before  from where distances are taken over, in shared memory, as far as the ground
  /// around is the same
  Floor(FloorGround ground, const FloorDistances& distances, int threads = 1,
        const Floor* before = nullptr);

  [[nodiscard]] bool empty() const { return ground_.empty(); }
  [[nodiscard]] double cell_size() const { return cell_size_; }  ///< m
  [[nodiscard]] double height() const { return height_; }        ///< m, z of the floor in map
  [[nodiscard]] Cell origin() const { return origin_; }
  [[nodiscard]] Area area() const { return {origin_, {origin_.x + columns(), origin_.y + rows()}}; }
  [[nodiscard]] int columns() const { return ground_.columns(); }
  [[nodiscard]] int rows() const { return ground_.rows(); }
  [[nodiscard]] double reach() const { return reach_; }    ///< m
  [[nodiscard]] double margin() const { return margin_; }  ///< m, of open()

  [[nodiscard]] Cell cell_at(Point point) const {
    static constexpr double kFarthest = 1e8;
    const auto number = [this](double at) {
      const double cells = std::clamp(at / cell_size_, -kFarthest, kFarthest);
      const int whole = static_cast<int>(cells);
      return whole - (cells < whole ? 1 : 0);
    };
    return {number(point.x), number(point.y)};
  }
  [[nodiscard]] Ground ground(Cell cell) const;
  /// True if the whole cell, and grow() steps around it along each axis, keeps the margin from
  /// everything that blocks.
  [[nodiscard]] bool open(Cell cell) const {
    return contains(cell) && open_row(cell.y)[cell.x - origin_.x] != 0;
  }
  /// Whole cells would round the margin up along walls; this is how much they took too much.
  [[nodiscard]] int grow() const { return grow_; }
  /// The open cells of a row that exists, 1 or 0, columns() of them from origin() on.
  [[nodiscard]] const std::uint8_t* open_row(int y) const { return open_.row(y - origin_.y); }
  /// Squares of gap() in cells, of a row that exists, columns() of them from origin() on.
  [[nodiscard]] const std::uint16_t* gap2_row(int y) const { return gap2_.row(y - origin_.y); }
  [[nodiscard]] const Bands<Ground>& all_ground() const { return ground_; }
  /// False if the ground of the area is as in the floor before, if there was one that lay alike.
  [[nodiscard]] bool changed(const Area& area) const;
  /// m, at most the distance from any point of the cell to a blocked cell; capped at reach().
  [[nodiscard]] double gap(Cell cell) const {
    return std::min(reach_, std::sqrt(static_cast<double>(gap2(cell))) * cell_size_);
  }
  /// m, exact distance from the point to a blocked cell; capped at reach() and `most`: the smaller
  /// that is, the faster.
  [[nodiscard]] double clearance(Point point, double most = kFar) const;
  /// True if every point of the segment is at least `radius` (m, <= reach()) from blocked cells,
  /// to 1e-9 m. Exact.
  [[nodiscard]] bool segment_clear(Point a, Point b, double radius) const;
  /// Every cell whose square the segment touches, in order; unlimited by the grid.
  [[nodiscard]] std::vector<Cell> cells_along(Point a, Point b) const;

 private:
  [[nodiscard]] bool contains(Cell cell) const { return area().contains(cell); }
  [[nodiscard]] int gap2(Cell cell) const {
    return contains(cell) ? gap2_row(cell.y)[cell.x - origin_.x] : 0;
  }
  /// Cells along a row to the next one that may block.
  [[nodiscard]] int stride(Cell cell) const {
    return 1 + static_cast<int>(std::sqrt(static_cast<double>(gap2(cell))));
  }
  /// Cells, from one to what may bring it nearer than the margin.
  [[nodiscard]] int margin_reach() const {
    return static_cast<int>(std::ceil(margin_ / cell_size_)) + 1;
  }
  /// Cells, from one to what may change anything that is kept of it.
  [[nodiscard]] int influence() const { return std::max(reach_cells_, margin_reach()); }
  static constexpr int kNote = 16;
  [[nodiscard]] int notes_across() const { return (columns() + kNote - 1) / kNote; }
  void note_changes(const Floor& before);
  void measure(int threads, const Floor* before);
  void measure(const Area& square);
  [[nodiscard]] std::vector<std::uint8_t> steps_along_columns(const Area& area) const;

  Cell origin_;
  double cell_size_ = 0.05;
  double height_ = 0.0;
  double reach_ = 0.0;
  int reach_cells_ = 0;
  double margin_ = 0.0;
  int grow_ = 0;  // steps
  Bands<Ground> ground_;
  Bands<std::uint16_t> gap2_;  // cells squared, capped
  Bands<std::uint8_t> open_;
  std::vector<bool> changed_;  // squares of kNote cells, row by row; empty: all
};

/// The floor with the holes that moving things make in it, at one instant.
struct Space {
  const Floor* floor = nullptr;
  const std::vector<Cylinder>* cylinders = nullptr;

  /// m, as Floor::clearance, cylinders included.
  [[nodiscard]] double clearance(Point point, double most = Floor::kFar) const;
  /// As Floor::segment_clear, cylinders included.
  [[nodiscard]] bool segment_clear(Point a, Point b, double radius) const;
};

}  // namespace navvi_floor
