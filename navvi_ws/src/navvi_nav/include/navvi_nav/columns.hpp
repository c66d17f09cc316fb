#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "navvi_nav/octomap_reader.hpp"

namespace navvi_nav {

/// A run of occupied voxels in a column, in levels above the map's lowest occupied voxel.
struct Span {
  std::uint16_t bottom = 0;
  std::uint16_t top = 0;    ///< one beyond its last level
  std::uint32_t below = 0;  ///< the next span down; 0: none
};

/// A map's occupied voxels as columns of spans: what Recast calls a height field, but written whole
/// leaves at a time and with one entry a run.
class Columns {
 public:
  static constexpr double kMaxColumns = 25.0e6;
  static constexpr int kMaxLevels = 60000;

  explicit Columns(const Voxels& voxels);

  [[nodiscard]] const std::string& error() const { return error_; }  ///< a sentence, or empty
  [[nodiscard]] int low_x() const { return low_[0]; }    ///< voxels from the map's origin
  [[nodiscard]] int low_y() const { return low_[1]; }    ///< voxels from the map's origin
  [[nodiscard]] int low_z() const { return low_[2]; }    ///< voxels from the map's origin: level 0
  [[nodiscard]] int width() const { return size_[0]; }   ///< columns along x
  [[nodiscard]] int height() const { return size_[1]; }  ///< columns along y

  /// The columns lie row by row. \returns the highest span; 0: none
  [[nodiscard]] std::uint32_t highest(std::size_t column) const { return highest_[column]; }
  [[nodiscard]] const Span& span(std::uint32_t index) const { return spans_[index]; }

 private:
  void measure(const Voxels& voxels);
  void add(std::size_t column, int bottom, int top);
  void add(const Octet& octet);

  std::string error_;
  int low_[3] = {0, 0, 0};
  int size_[3] = {0, 0, 0};
  std::vector<std::uint32_t> highest_;
  std::vector<Span> spans_;
};

}  // namespace navvi_nav
