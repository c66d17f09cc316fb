#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

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
      for (std::size_t i = 0; i < count; ++i, values += step) bands_.back()[i] = *values;
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

}  // namespace navvi_floor
