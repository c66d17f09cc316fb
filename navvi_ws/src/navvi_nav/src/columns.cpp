#include "navvi_nav/columns.hpp"

#include <algorithm>

namespace navvi_nav {
namespace {

/// Children on the low side of x, y and z; the others are a shift higher.
constexpr unsigned kLowSide[3] = {0x55U, 0x33U, 0x0fU};

}  // namespace

Columns::Columns(const Voxels& voxels) {
  measure(voxels);
  if (!error_.empty()) return;
  highest_.assign(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]), 0);
  spans_.reserve(highest_.size() + highest_.size() / 8 + 1);
  spans_.emplace_back();  // index 0 means none
  for (const Octet& octet : voxels.octets) add(octet);
}

void Columns::measure(const Voxels& voxels) {
  int low[3] = {kMapSide, kMapSide, kMapSide};
  int high[3] = {0, 0, 0};
  for (const Octet& octet : voxels.octets) {
    const int at[3] = {octet.x, octet.y, octet.z};
    const int side = 1 << octet.level;
    for (int k = 0; k < 3; ++k) {
      const bool in_low = (octet.mask & kLowSide[k]) != 0;
      const bool in_high = (octet.mask & ~kLowSide[k]) != 0;
      low[k] = std::min(low[k], at[k] + (in_low ? 0 : side));
      high[k] = std::max(high[k], at[k] + (in_high ? 2 * side : side));
    }
  }
  if (voxels.octets.empty()) {
    error_ = "the map has no occupied voxel";
    return;
  }
  for (int k = 0; k < 3; ++k) {
    low_[k] = low[k] - kMapCenter;
    size_[k] = high[k] - low[k];
  }
  if (size_[2] > kMaxLevels)
    error_ = "the map is " + std::to_string(size_[2]) + " voxels tall; " +
             std::to_string(kMaxLevels) + " are allowed";
  const double columns = static_cast<double>(size_[0]) * size_[1];
  if (columns > kMaxColumns)
    error_ = "the map spreads over " + std::to_string(static_cast<long long>(columns / 1e6)) +
             " million columns of voxels; 25 million are allowed";
}

void Columns::add(const Octet& octet) {
  const int side = 1 << octet.level;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const bool lower = ((octet.mask >> quarter) & 1) != 0;
    const bool upper = ((octet.mask >> (quarter + 4)) & 1) != 0;
    if (!lower && !upper) continue;
    const int x = octet.x - kMapCenter - low_[0] + ((quarter & 1) != 0 ? side : 0);
    const int y = octet.y - kMapCenter - low_[1] + ((quarter & 2) != 0 ? side : 0);
    const int z = octet.z - kMapCenter - low_[2];
    const int bottom = z + (lower ? 0 : side);
    const int top = z + (upper ? 2 * side : side);
    for (int row = y; row < y + side; ++row) {
      const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(size_[0]) +
                                static_cast<std::size_t>(x);
      for (std::size_t column = first; column < first + static_cast<std::size_t>(side); ++column)
        add(column, bottom, top);
    }
  }
}

/// Spans that touch become one. A stream runs upwards within a column, so that this is most often
/// one look at the highest span, but any order will do.
void Columns::add(std::size_t column, int bottom, int top) {
  std::uint32_t above = 0;
  std::uint32_t at = highest_[column];
  while (at != 0 && spans_[at].bottom > top) {
    above = at;
    at = spans_[at].below;
  }
  if (at == 0 || spans_[at].top < bottom) {
    const auto index = static_cast<std::uint32_t>(spans_.size());
    spans_.push_back({static_cast<std::uint16_t>(bottom), static_cast<std::uint16_t>(top), at});
    (above == 0 ? highest_[column] : spans_[above].below) = index;
    return;
  }
  Span& span = spans_[at];
  span.bottom = static_cast<std::uint16_t>(std::min<int>(span.bottom, bottom));
  span.top = static_cast<std::uint16_t>(std::max<int>(span.top, top));
  while (span.below != 0 && spans_[span.below].top >= span.bottom) {
    span.bottom = std::min(span.bottom, spans_[span.below].bottom);
    span.below = spans_[span.below].below;
  }
}

}  // namespace navvi_nav
