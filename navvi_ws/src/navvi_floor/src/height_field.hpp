#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "navvi_floor/floor.hpp"
#include "navvi_floor/octomap_reader.hpp"

namespace navvi_floor {

/// A run of occupied voxels in a column, in levels above the map's lowest occupied voxel.
struct Span {
  int bottom = 0;
  int top = 0;  ///< one beyond its last level
};

/// Voxels from the map's origin, along z.
struct Levels {
  int low = 0;
  int high = 0;  ///< one beyond
};

/// A map's occupied voxels as columns of spans, as in Recast's height field, but written whole
/// leaves at a time and with one entry a run. Most columns are one run, so the highest span of each
/// is in a grid, and the few below in a list.
class HeightField {
 public:
  static constexpr int kMaxLevels = 30000;
  /// What a column's leaves come to, before those that touch are joined. The densest layout of
  /// 300 x 300 m at 0.05 m has 142 million, which join to 77.
  static constexpr double kMaxRuns = 200.0e6;
  /// A run that is not the first of its column costs 8 bytes and some sorting, and a few bytes of a
  /// map can ask for thousands: large leaves above each other. So there may be this many in any
  /// map, and so many more for each inner node that holds a leaf. Layouts have 4 a node at 0.05 m
  /// and 12 at 0.02 m, where solid things have larger leaves.
  static constexpr std::size_t kFreeRuns = 4'000'000;
  static constexpr std::size_t kRunsANode = 32;

  /// \param threads  that may share the work
  /// \param wanted  columns, in voxels from the map's origin; by default all that voxels take up
  /// \param levels  what lies beyond them may be left out
  explicit HeightField(const Voxels& voxels, int threads = 1,
                       const std::optional<Area>& wanted = std::nullopt,
                       const std::optional<Levels>& levels = std::nullopt);
  HeightField(const HeightField&) = delete;
  HeightField& operator=(const HeightField&) = delete;

  [[nodiscard]] const std::string& error() const { return error_; }  ///< a sentence, or empty
  /// What occupied voxels take up along x, y and z, whichever columns were taken: voxels from the
  /// map's origin.
  struct Extent {
    int low[3] = {0, 0, 0};
    int high[3] = {0, 0, 0};  ///< one beyond
  };
  [[nodiscard]] const Extent& extent() const { return extent_; }
  [[nodiscard]] Area columns() const {  ///< voxels from the map's origin
    return {{low_[0], low_[1]}, {low_[0] + size_[0], low_[1] + size_[1]}};
  }
  [[nodiscard]] int low_z() const { return low_[2]; }    ///< voxels from the map's origin: level 0
  [[nodiscard]] int width() const { return size_[0]; }   ///< columns along x
  [[nodiscard]] int height() const { return size_[1]; }  ///< columns along y
  [[nodiscard]] int levels() const { return size_[2]; }

  /// Calls visit(span) for each span of a column, the highest first, while it returns true. No two
  /// spans of a column touch. Columns lie row by row.
  template <typename Visit>
  void downwards(std::size_t column, const Visit& visit) const {
    downwards(column, visit, [this](std::size_t at) { return below(at); });
  }
  /// Likewise for all columns of a row: calls visit(column, downwards), and that a visit(span).
  template <typename Visit>
  void for_row(int row, const Visit& visit) const {
    const Lower* lower = rows_[static_cast<std::size_t>(row)].begin;
    const auto width = static_cast<std::size_t>(size_[0]);
    const std::size_t first = static_cast<std::size_t>(row) * width;
    for (std::size_t column = first; column < first + width; ++column)
      visit(column, [&](const auto& visit_span) {
        downwards(column, visit_span, [&](std::size_t at) {
          while (lower->column < at) ++lower;
          return lower;
        });
      });
  }

 private:
  static constexpr std::uint16_t kMore = 0x8000;  // in a bottom: the list has more of this column

  struct Packed {
    std::uint16_t bottom = 0;
    std::uint16_t top = 0;  // 0: no span
  };
  struct Lower {
    std::uint32_t column = 0;
    Packed span;
  };

  template <typename Visit, typename Below>
  void downwards(std::size_t column, const Visit& visit, const Below& below) const {
    const Packed& high = highest_[column];
    if (high.top == 0 || !visit(unpacked(high)) || (high.bottom & kMore) == 0) return;
    for (const Lower* lower = below(column);
         lower->column == column && visit(unpacked(lower->span));)
      ++lower;
  }
  static Span unpacked(Packed span) { return {span.bottom & ~kMore, span.top}; }
  [[nodiscard]] const Lower* below(std::size_t column) const;
  void measure(const Voxels& voxels, const std::optional<Area>& wanted);
  void add(const Octet& octet, int first_row, int last_row, std::vector<Lower>& lower);
  void add(const VoxelBox& box, int first_row, int last_row, std::vector<Lower>& lower);
  void add(std::uint32_t column, Packed span, std::vector<Lower>& lower);
  void sort_by_column(std::vector<Lower>& lower) const;
  void settle(std::vector<Lower>& lower);

  std::string error_;
  Extent extent_;
  int low_[3] = {0, 0, 0};
  int size_[3] = {0, 0, 0};
  std::optional<Levels> levels_;  // that were taken, if not all
  std::vector<Packed> highest_;
  /// Of each band of rows, by column, then downwards; ends with one of no column.
  std::vector<std::vector<Lower>> lower_;
  struct Row {
    const Lower* begin = nullptr;
    const Lower* end = nullptr;
  };
  std::vector<Row> rows_;  // of lower_
};

}  // namespace navvi_floor
