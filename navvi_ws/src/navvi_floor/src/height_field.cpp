#include "height_field.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <sstream>
#include <tuple>

#include "navvi_floor/parallel.hpp"
#include "navvi_floor/resample.hpp"

namespace navvi_floor {
namespace {

/// Children on the low side of x, y and z; the others are a shift higher.
constexpr unsigned kLowSide[3] = {0x55U, 0x33U, 0x0fU};
constexpr int kBits[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};  // that are set

/// Of its columns, one each.
double runs_of(const VoxelBox& box) {
  return static_cast<double>(box.high[0] - box.low[0]) * (box.high[1] - box.low[1]);
}

/// m, to the next 0.01 m.
std::string rounded_up(double edge) {
  std::ostringstream text;
  text << std::ceil(100.0 * edge) / 100.0;
  return text.str();
}

}  // namespace

HeightField::HeightField(const Voxels& voxels, int threads, const std::optional<Area>& wanted,
                         const std::optional<Levels>& levels)
    : levels_(levels) {
  measure(voxels, wanted);
  if (!error_.empty()) return;
  const auto width = static_cast<std::size_t>(size_[0]);
  highest_.resize(width * static_cast<std::size_t>(size_[1]));
  rows_.resize(static_cast<std::size_t>(size_[1]));
  // Narrow bands need little room for spans that are to be joined; each looks at all octets.
  constexpr std::size_t kBandColumns = 4U << 20U;
  constexpr std::size_t kRunsACount = 1U << 16U;
  const int bands =
      std::min(std::max({1, threads, static_cast<int>(highest_.size() / kBandColumns)}), size_[1]);
  lower_.resize(static_cast<std::size_t>(bands));
  std::size_t most = kFreeRuns + kRunsANode * voxels.octets.size();
  for (const VoxelBox& box : voxels.boxes) most += static_cast<std::size_t>(runs_of(box));
  std::atomic<std::size_t> stacked{0};
  in_parallel(bands, threads, [&](int band) {
    if (stacked > most) return;
    std::vector<Lower>& lower = lower_[static_cast<std::size_t>(band)];
    const auto row_at = [&](int end) {
      return static_cast<int>(static_cast<std::int64_t>(size_[1]) * end / bands);
    };
    std::size_t counted = 0;
    const auto count = [&] {
      stacked += lower.size() - counted;
      counted = lower.size();
    };
    for (const Octet& octet : voxels.octets) {
      if (lower.size() - counted > kRunsACount) {
        count();
        if (stacked > most) return;
      }
      add(octet, row_at(band), row_at(band + 1), lower);
    }
    for (const VoxelBox& box : voxels.boxes) add(box, row_at(band), row_at(band + 1), lower);
    count();
    settle(lower);
    lower.push_back({static_cast<std::uint32_t>(highest_.size()), {}});
    lower.shrink_to_fit();
    const Lower* at = lower.data();
    for (int row = row_at(band); row < row_at(band + 1); ++row) {
      const std::size_t end = (static_cast<std::size_t>(row) + 1) * width;
      const Lower* const begin = at;
      while (at->column < end) ++at;
      rows_[static_cast<std::size_t>(row)] = {begin, at};
    }
  });
  if (stacked > most)
    error_ = "the map stacks more runs of voxels in its columns than the " +
             millions(static_cast<double>(most)) + " that are allowed with " +
             std::to_string(voxels.octets.size()) + " nodes that hold leaves";
}

const HeightField::Lower* HeightField::below(std::size_t column) const {
  const Row& row = rows_[column / static_cast<std::size_t>(size_[0])];
  return std::lower_bound(row.begin, row.end, column, [](const Lower& lower, std::size_t wanted) {
    return lower.column < wanted;
  });
}

void HeightField::measure(const Voxels& voxels, const std::optional<Area>& wanted) {
  int low[3] = {kMapSide, kMapSide, kMapSide};
  int high[3] = {0, 0, 0};
  double runs = 0.0;
  for (const Octet& octet : voxels.octets) {
    const int at[3] = {octet.x, octet.y, octet.z};
    const int side = 1 << octet.level;
    const unsigned quarters = (octet.mask | octet.mask >> 4) & 0x0fU;
    runs += static_cast<double>(kBits[quarters]) * side * side;
    for (int k = 0; k < 3; ++k) {
      const bool in_low = (octet.mask & kLowSide[k]) != 0;
      const bool in_high = (octet.mask & ~kLowSide[k]) != 0;
      low[k] = std::min(low[k], at[k] + (in_low ? 0 : side));
      high[k] = std::max(high[k], at[k] + (in_high ? 2 * side : side));
    }
  }
  for (const VoxelBox& box : voxels.boxes) {
    runs += runs_of(box);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], box.low[k]);
      high[k] = std::max(high[k], box.high[k]);
    }
  }
  if (voxels.octets.empty() && voxels.boxes.empty() && !wanted) {
    error_ = "the map has no occupied voxel";
    return;
  }
  for (int k = 0; k < 3; ++k) {
    extent_.low[k] = low_[k] = low[k] - kMapCenter;
    extent_.high[k] = high[k] - kMapCenter;
    size_[k] = std::max(0, high[k] - low[k]);
  }
  if (size_[2] > kMaxLevels)
    error_ = "the map is " + std::to_string(size_[2]) + " voxels tall; " +
             std::to_string(kMaxLevels) + " are allowed";
  const double columns = static_cast<double>(size_[0]) * size_[1];
  if (columns > kMaxCells)
    error_ = "the map spreads over " + millions(columns) + " columns of voxels; " +
             millions(kMaxCells) + " are allowed, as with voxels of " +
             rounded_up(voxels.resolution * std::sqrt(columns / kMaxCells)) +
             " m (octomap/resolution of the simulator)";
  else if (runs > kMaxRuns)
    error_ = "the map has " + millions(runs) + " runs of voxels in its columns; " +
             millions(kMaxRuns) + " are allowed";
  if (!wanted) return;
  low_[0] = wanted->low.x, low_[1] = wanted->low.y;
  size_[0] = wanted->columns(), size_[1] = wanted->rows();
}

/// \param first_row, last_row  rows of columns to fill, the last excluded
void HeightField::add(const Octet& octet, int first_row, int last_row, std::vector<Lower>& lower) {
  const int side = 1 << octet.level;
  const int first = octet.y - kMapCenter - low_[1];
  if (first >= last_row || first + 2 * side <= first_row) return;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const bool in_low = ((octet.mask >> quarter) & 1) != 0;
    const bool in_high = ((octet.mask >> (quarter + 4)) & 1) != 0;
    if (!in_low && !in_high) continue;
    const int x = octet.x + ((quarter & 1) != 0 ? side : 0);
    const int y = octet.y + ((quarter & 2) != 0 ? side : 0);
    const int bottom = octet.z + (in_low ? 0 : side), top = octet.z + (in_high ? 2 : 1) * side;
    add({{x, y, bottom}, {x + side, y + side, top}}, first_row, last_row, lower);
  }
}

void HeightField::add(const VoxelBox& box, int first_row, int last_row,
                      std::vector<Lower>& lower) {
  if (levels_ && (box.high[2] <= levels_->low + kMapCenter ||
                  box.low[2] >= levels_->high + kMapCenter))
    return;
  const auto level = [&](int z) { return static_cast<std::uint16_t>(z - kMapCenter - low_[2]); };
  const Packed span{level(box.low[2]), level(box.high[2])};
  const int x = kMapCenter + low_[0], y = kMapCenter + low_[1];
  const int from = std::max(box.low[0] - x, 0), to = std::min(box.high[0] - x, size_[0]);
  const int last = std::min(box.high[1] - y, last_row);
  for (int row = std::max(box.low[1] - y, first_row); row < last; ++row) {
    for (int at = row * size_[0] + from; at < row * size_[0] + to; ++at) {
      const auto column = static_cast<std::uint32_t>(at);
      if (highest_[column].top == 0)
        highest_[column] = span;
      else
        add(column, span, lower);
    }
  }
}

/// To a column that has a span. A stream runs upwards within a column, so that most spans grow one;
/// any order will do: settle() sorts the spans that are apart here.
void HeightField::add(std::uint32_t column, Packed span, std::vector<Lower>& lower) {
  Packed& high = highest_[column];
  const std::uint16_t more = high.bottom & kMore;
  const auto bottom = static_cast<std::uint16_t>(high.bottom & ~kMore);
  if (span.bottom <= high.top && span.top >= bottom) {
    high.bottom = std::min(bottom, span.bottom) | more;
    high.top = std::max(high.top, span.top);
  } else {
    const bool above = span.bottom > high.top;
    lower.push_back({column, above ? Packed{bottom, high.top} : span});
    if (above) high = span;
    high.bottom |= kMore;
  }
}

/// Sorts by column, by so many bits at a time (LSD radix sort).
void HeightField::sort_by_column(std::vector<Lower>& lower) const {
  constexpr unsigned kBitsEach = 11;
  constexpr std::uint32_t kDigit = (1U << kBitsEach) - 1;
  std::vector<Lower> sorted(lower.size());
  for (unsigned shift = 0; highest_.size() >> shift > 0; shift += kBitsEach) {
    std::array<std::uint32_t, kDigit + 2> next{};  // where the next one of each digit goes
    for (const Lower& one : lower) ++next[(one.column >> shift & kDigit) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const Lower& one : lower) sorted[next[one.column >> shift & kDigit]++] = one;
    lower.swap(sorted);
  }
}

/// Sorts the spans below the highest ones and joins spans that touch.
void HeightField::settle(std::vector<Lower>& lower) {
  sort_by_column(lower);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < lower.size();) {
    const std::uint32_t column = lower[i].column;
    Packed* above = &highest_[column];
    above->bottom &= static_cast<std::uint16_t>(~kMore);
    const std::size_t first = kept;
    std::size_t end = i + 1;
    while (end < lower.size() && lower[end].column == column) ++end;
    std::sort(&lower[i], lower.data() + end, [](const Lower& a, const Lower& b) {
      return std::tie(b.span.top, b.span.bottom) < std::tie(a.span.top, a.span.bottom);
    });
    for (; i < end; ++i) {
      const Packed span = lower[i].span;
      if (span.top >= above->bottom) {
        above->bottom = std::min(above->bottom, span.bottom);
      } else {
        lower[kept] = {column, span};
        above = &lower[kept++].span;
      }
    }
    if (kept > first) highest_[column].bottom |= kMore;
  }
  lower.resize(kept);
}

}  // namespace navvi_floor
