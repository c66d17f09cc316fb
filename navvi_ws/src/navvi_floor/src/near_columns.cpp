#include "near_columns.hpp"

#include <algorithm>

namespace navvi_floor {
namespace {

/// Columns that have the same voxels of one box.
struct Slab {
  Area area;
  std::uint64_t bits;
};

std::vector<Slab> slabs_of(const Voxels& voxels, const Levels& levels) {
  std::vector<Slab> out;
  const auto add = [&](const VoxelBox& box) {
    const int bottom = std::max(box.low[2] - kMapCenter, levels.low) - levels.low;
    const int top = std::min(box.high[2] - kMapCenter, levels.high) - levels.low;
    if (bottom < top)
      out.push_back({{{box.low[0] - kMapCenter, box.low[1] - kMapCenter},
                      {box.high[0] - kMapCenter, box.high[1] - kMapCenter}},
                     ~std::uint64_t{0} >> (NearColumns::kMostLevels - (top - bottom)) << bottom});
  };
  for (const Octet& octet : voxels.octets) for_boxes(octet, add);
  for (const VoxelBox& box : voxels.boxes) add(box);
  std::sort(out.begin(), out.end(),
            [](const Slab& a, const Slab& b) { return a.area.low.y < b.area.low.y; });
  return out;
}

}  // namespace

NearColumns::NearColumns(const Voxels& voxels, const Levels& levels, const Area& area)
    : levels_(levels), area_(area) {
  const std::vector<Slab> slabs = slabs_of(voxels, levels);
  std::vector<Slab> here;
  std::vector<std::uint64_t> columns(static_cast<std::size_t>(area.columns()));
  auto next = slabs.begin();
  for (int y = area.low.y; y < area.high.y; ++y) {
    const auto ended = std::remove_if(here.begin(), here.end(),
                                      [y](const Slab& slab) { return slab.area.high.y <= y; });
    bool same = y > area.low.y && ended == here.end();
    here.erase(ended, here.end());
    for (; next != slabs.end() && next->area.low.y <= y; ++next, same = false)
      here.push_back(*next);
    if (same) {
      rows_.push_back(rows_.back());
      continue;
    }
    std::fill(columns.begin(), columns.end(), 0);
    for (const Slab& slab : here)
      for (int x = slab.area.low.x - area.low.x; x < slab.area.high.x - area.low.x; ++x)
        columns[static_cast<std::size_t>(x)] |= slab.bits;
    add_row(columns);
  }
}

void NearColumns::add_row(const std::vector<std::uint64_t>& columns) {
  const std::size_t begin = runs_.size();
  for (std::size_t from = 0, to = 0; from < columns.size(); from = to) {
    while (to < columns.size() && columns[to] == columns[from]) ++to;
    runs_.push_back({columns[from], to - from});
  }
  rows_.push_back({begin, runs_.size()});
}

}  // namespace navvi_floor
