#include "clusters/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace navvi_perception::clusters {
namespace {

using Cell = StandingThings::Cell;

/// Groups of cells that are at most `reach` cells apart along x and y, each in order.
template <typename Value>
std::vector<std::vector<Cell>> groups_of(const std::map<Cell, Value>& cells, int reach) {
  std::vector<std::vector<Cell>> groups;
  std::set<Cell> done;
  for (const auto& [first, value] : cells) {
    if (!done.insert(first).second) continue;
    std::vector<Cell> group{first};
    for (std::size_t i = 0; i < group.size(); ++i)
      for (int dx = -reach; dx <= reach; ++dx)
        for (int dy = -reach; dy <= reach; ++dy) {
          const Cell near{group[i].first + dx, group[i].second + dy};
          if (cells.count(near) > 0 && done.insert(near).second) group.push_back(near);
        }
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

std::vector<Cluster> clusters_of(const std::vector<Eigen::Vector3d>& points, double gap,
                                 double radius, const Eigen::Vector2d& origin) {
  // Cells of half the gap: two points no farther apart than it are at most two cells apart.
  std::map<Cell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < points.size(); ++i)
    cells[{static_cast<int>(std::floor(2.0 * points[i].x() / gap)),
           static_cast<int>(std::floor(2.0 * points[i].y() / gap))}]
        .push_back(i);
  std::vector<Cluster> found;
  for (const std::vector<Cell>& group : groups_of(cells, 2)) {
    Cluster cluster;
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
    for (const Cell& cell : group)
      for (const std::size_t i : cells[cell]) {
        cluster.members.push_back(i);
        cluster.top =
            cluster.members.size() == 1 ? points[i].z() : std::max(cluster.top, points[i].z());
        low = low.cwiseMin(points[i].head<2>());
        high = high.cwiseMax(points[i].head<2>());
      }
    const double seen = 0.5 * (high - low).norm();
    cluster.length = (high - low).maxCoeff();
    cluster.radius = std::max(radius, seen);
    const Eigen::Vector2d middle = 0.5 * (low + high);
    const Eigen::Vector2d away = middle - origin;
    if (away.norm() > 1e-6)
      cluster.centre = middle + (cluster.radius - seen) * away.normalized();
    else
      cluster.centre = middle;
    found.push_back(std::move(cluster));
  }
  return found;
}

const std::vector<StandingThings::StandingThing>& StandingThings::update(
    const std::vector<Cell>& cells, int apart, std::uint32_t& next) {
  const auto block_of = [apart](int cell) { return cell >= 0 ? cell / apart : ~(~cell / apart); };
  std::map<Cell, std::vector<Cell>> blocks;
  for (const Cell& cell : cells)
    blocks[{block_of(cell.first), block_of(cell.second)}].push_back(cell);
  std::vector<std::vector<Cell>> groups = groups_of(blocks, 1);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::map<Cell, std::uint32_t> ids;
  std::set<std::uint32_t> taken;
  things_.clear();
  for (const std::vector<Cell>& group : groups) {
    std::map<std::uint32_t, std::size_t> votes;
    for (const Cell& block : group) {
      const auto before = ids_.find(block);
      if (before != ids_.end() && taken.count(before->second) == 0) ++votes[before->second];
    }
    const auto most =
        std::max_element(votes.begin(), votes.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    StandingThing thing{most == votes.end() ? next++ : most->first, {}};
    taken.insert(thing.id);
    for (const Cell& block : group) {
      ids[block] = thing.id;
      thing.cells.insert(thing.cells.end(), blocks[block].begin(), blocks[block].end());
    }
    things_.push_back(std::move(thing));
  }
  ids_ = std::move(ids);
  return things_;
}

}  // namespace navvi_perception::clusters
