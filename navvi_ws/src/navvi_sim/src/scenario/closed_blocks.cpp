#include "scenario/closed_blocks.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "description/floor_height.hpp"
#include "occupancy/closed_mesh.hpp"

namespace navvi_sim::scenario {
namespace {

constexpr double kStands = 0.1;               // m above the floor, at which a block is cut
constexpr std::size_t kMostJudged = 200'000;  // triangles of a mesh: more are some seconds of work

using Segment = std::array<Eigen::Vector2d, 2>;
using Cells = std::vector<std::size_t>;

/// The triangles of a mesh that belong to closed parts, in its own frame.
std::vector<occupancy::Triangle> closed_triangles(const Mesh& mesh) {
  std::vector<occupancy::Triangle> all, closed;
  if (mesh.triangles.size() > kMostJudged) return closed;
  for (const auto& indices : mesh.triangles) {
    occupancy::Triangle& triangle = all.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      triangle.corners[i] = mesh.vertices[indices[i]].cast<double>();
  }
  for (const occupancy::ClosedMesh& part : occupancy::closed_parts(all))
    closed.insert(closed.end(), part.triangles().begin(), part.triangles().end());
  return closed;
}

/// Where a level plane cuts a surface. Corners count as above it or below, so that the segments of
/// a closed surface are closed outlines.
std::vector<Segment> cut(const std::vector<occupancy::Triangle>& triangles,
                         const Eigen::Isometry3d& pose, double z) {
  std::vector<Segment> segments;
  for (const occupancy::Triangle& triangle : triangles) {
    Segment segment;
    std::size_t ends = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      // Of both triangles that share a side, the same point.
      std::array<Eigen::Vector3d, 2> side{triangle.corners[i], triangle.corners[(i + 1) % 3]};
      std::sort(side.begin(), side.end(), [](const auto& a, const auto& b) {
        return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
      });
      const Eigen::Vector3d a = pose * side[0], b = pose * side[1];
      if ((a.z() > z) != (b.z() > z))
        segment[ends++] = (a + (b - a) * ((z - a.z()) / (b.z() - a.z()))).head<2>();
    }
    if (ends == 2) segments.push_back(segment);
  }
  return segments;
}

/// The cells whose centres lie within closed outlines, by the even-odd rule.
Cells cells_within(const std::vector<Segment>& segments, const FloorGrid& grid) {
  Eigen::AlignedBox2d bounds;
  for (const Segment& segment : segments)
    for (const Eigen::Vector2d& end : segment) bounds.extend(end);
  std::vector<std::pair<std::size_t, std::size_t>> rows;
  if (!bounds.isEmpty())
    grid.for_each_row_in(bounds, [&](std::size_t begin, std::size_t end) {
      if (begin < end) rows.emplace_back(begin, end);
    });
  if (rows.empty()) return {};
  std::vector<std::vector<double>> crossings(rows.size());
  const double first = grid.centre(rows[0].first).y();
  for (const auto& [a, b] : segments) {
    const double low = (std::min(a.y(), b.y()) - first) / grid.cell_size();
    const double high = (std::max(a.y(), b.y()) - first) / grid.cell_size();
    const double last = static_cast<double>(rows.size()) - 1.0;
    for (double row = std::max(0.0, std::floor(low)); row <= std::min(last, std::ceil(high));
         ++row) {
      const auto index = static_cast<std::size_t>(row);
      const double y = grid.centre(rows[index].first).y();
      if ((a.y() > y) != (b.y() > y))
        crossings[index].push_back(a.x() + (b.x() - a.x()) * ((y - a.y()) / (b.y() - a.y())));
    }
  }
  Cells cells;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<double>& at = crossings[row];
    std::sort(at.begin(), at.end());
    std::size_t passed = 0;
    for (std::size_t cell = rows[row].first; cell < rows[row].second; ++cell) {
      while (passed < at.size() && at[passed] <= grid.centre(cell).x()) ++passed;
      if (passed % 2 == 1) cells.push_back(cell);
    }
  }
  return cells;
}

/// Whether any place in the box is as clear as wanted.
bool has_places(const FloorGrid& grid, const Eigen::AlignedBox3d& box, double clear) {
  bool any = false;
  grid.for_each_row_in({box.min().head<2>(), box.max().head<2>()},
                       [&](std::size_t cell, std::size_t end) {
                         while (!any && cell < end) any = grid.clearance(cell++) >= clear;
                       });
  return any;
}

}  // namespace

ClosedBlocks::ClosedBlocks(const WorldDescription& world, const FloorGrid& grid, double clear) {
  const double z = world.floor_height + kStands;
  std::map<const Mesh*, std::vector<occupancy::Triangle>> known;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Thing& thing : world.things) boxes.push_back(bounds_of({thing}));
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    const Thing& thing = world.things[i];
    if (thing.route || thing.thing_class == ThingClass::floor ||
        thing.thing_class == ThingClass::wall)
      continue;
    for (const Shape& shape : thing.shapes) {
      const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry);
      if (mesh == nullptr) continue;
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      const Eigen::AlignedBox3d bounds = bounds_of(shape.geometry, pose);
      if (bounds.min().z() > z || bounds.max().z() <= z || !has_places(grid, bounds, clear))
        continue;
      auto [triangles, is_new] = known.emplace(mesh->get(), std::vector<occupancy::Triangle>());
      if (is_new) triangles->second = closed_triangles(**mesh);
      Cells cells = cells_within(cut(triangles->second, pose, z), grid);
      std::sort(cells.begin(), cells.end());
      const auto stands_in_it = [&](std::size_t other) {
        const Thing& one = world.things[other];
        return other != i && one.thing_class != ThingClass::floor && boxes[other].max().z() > z &&
               std::binary_search(cells.begin(), cells.end(),
                                  grid.cell_at(boxes[other].center().head<2>()));
      };
      bool encloses = cells.empty();
      for (std::size_t other = 0; !encloses && other < boxes.size(); ++other)
        encloses = stands_in_it(other);
      if (encloses) continue;
      names_.push_back(thing.name);
      marks_.resize(grid.size(), 0);
      for (const std::size_t cell : cells) marks_[cell] = static_cast<std::uint32_t>(names_.size());
    }
  }
}

}  // namespace navvi_sim::scenario
