#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "height_field.hpp"

namespace navvi_floor {

/// Columns of voxels on a few levels, a bit each: runs of columns alike, row by row.
class NearColumns {
 public:
  static constexpr int kMostLevels = 64;

  /// \param area  columns, in voxels from the map's origin
  NearColumns(const Voxels& voxels, const Levels& levels, const Area& area);

  [[nodiscard]] const Levels& levels() const { return levels_; }
  [[nodiscard]] const Area& columns() const { return area_; }
  /// Calls visit(count, bits) for each run of columns, in order; bit 0 is the lowest level.
  template <typename Visit>
  void for_runs(const Visit& visit) const {
    for (const Row& row : rows_)
      for (std::size_t run = row.begin; run < row.end; ++run)
        visit(runs_[run].count, runs_[run].bits);
  }

 private:
  struct Run {
    std::uint64_t bits;
    std::size_t count;
  };
  struct Row {
    std::size_t begin, end;  // of runs_, where equal rows share theirs
  };

  void add_row(const std::vector<std::uint64_t>& columns);

  Levels levels_;
  Area area_;
  std::vector<Run> runs_;
  std::vector<Row> rows_;
};

}  // namespace navvi_floor
