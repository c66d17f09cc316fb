#include "map/local_map.hpp"

#include <octomap/octomap.h>

#include <cmath>
#include <sstream>

namespace navvi_perception::map {
namespace {

constexpr double kOccupiedAbove = 65.0;  // per cent, as map_server's occupied_thresh
constexpr double kFadeEach = 1.0;        // s
constexpr double kFollow = 1.0;          // m, that the robot drives before the bound follows
constexpr float kSurelyClear = -1.0F;    // log-odds; three rays at 0.4
constexpr double kOnBorder = 1e-6;       // voxels, against rounding

octomap::point3d to_octomap(const Eigen::Vector3d& point) {
  return octomap::point3d(static_cast<float>(point.x()), static_cast<float>(point.y()),
                          static_cast<float>(point.z()));
}

}  // namespace

void MapConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(resolution, "resolution", Range{0.02, 0.5}, "m", "edge of a voxel");
  visit(bound, "bound", Range{2.0, 50.0}, "m",
        "along x and y to each side of the robot; beyond it only the prior map is kept");
  visit(floor, "floor", Range{-100.0, 100.0}, "m", "z of the floor, which is flat, in map");
  visit(low, "low", Range{0.01, 0.5}, "m", "above the floor; what ends lower is floor");
  visit(high, "high", Range{0.2, 5.0}, "m",
        "above the floor; what begins higher is over the robot's head");
  visit(hit, "hit", Range{0.51, 0.99}, "", "probability that what a ray meets is there");
  visit(miss, "miss", Range{0.01, 0.49}, "", "probability that what a ray passes is there");
  visit(forget, "forget", Range{1.0, 1e6}, "s",
        "in which a sure voxel is forgotten that is not seen again");
}

struct LocalMap::Trees {
  explicit Trees(double resolution) : prior(resolution), seen(resolution) {}
  octomap::OcTree prior;  ///< pruned
  octomap::OcTree seen;   ///< leaves of full depth only
};

LocalMap::LocalMap(const MapConfig& config, const sight::Prior& prior)
    : config_(config), trees_(std::make_unique<Trees>(config.resolution)) {
  trees_->seen.setProbHit(config.hit);
  trees_->seen.setProbMiss(config.miss);
  if (prior.cells.empty()) return;
  const double side = config_.resolution;
  const Eigen::Vector2d end =
      prior.origin + prior.resolution * Eigen::Vector2d(prior.width, prior.height);
  const double inside = kOnBorder * side;
  low_ = column_of(prior.origin + Eigen::Vector2d(inside, inside));
  const Column high = column_of(end - Eigen::Vector2d(inside, inside));
  columns_ = high.first - low_.first + 1;
  rows_ = high.second - low_.second + 1;
  prior_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const int top = static_cast<int>(std::ceil(config_.high / side));
  for (int y = low_.second; y <= high.second; ++y) {
    for (int x = low_.first; x <= high.first; ++x) {
      const Eigen::Vector2d middle((x + 0.5) * side, (y + 0.5) * side);
      const Eigen::Vector2d cell = (middle - prior.origin) / prior.resolution;
      const auto number = [](double at, int count) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(std::floor(at)), 0, count - 1));
      };
      const int value =
          prior.cells[number(cell.y(), prior.height) * static_cast<std::size_t>(prior.width) +
                      number(cell.x(), prior.width)];
      prior_.push_back(value < 0 ? std::int8_t{-1} : std::int8_t{value > kOccupiedAbove});
      if (value < 0) continue;
      const int up_to = prior_.back() == 1 ? top : 0;
      for (int z = -1; z < up_to; ++z)
        trees_->prior.updateNode(
            to_octomap({middle.x(), middle.y(), config_.floor + (z + 0.5) * side}), true, true);
    }
  }
  trees_->prior.updateInnerOccupancy();
  trees_->prior.prune();
}

LocalMap::~LocalMap() = default;

void LocalMap::insert(const sight::Sight& sight) {
  octomap::Pointcloud cloud;
  for (const auto* ends : {&sight.hits, &sight.clear})
    for (const Eigen::Vector3d& end : *ends) cloud.push_back(to_octomap(end));
  const octomap::point3d origin = to_octomap(sight.origin);
  octomap::KeySet free, occupied;
  trees_->seen.computeUpdate(cloud, origin, free, occupied, config_.bound);
  octomap::KeySet hit;
  for (const Eigen::Vector3d& end : sight.hits) {
    octomap::OcTreeKey key;
    if (matters(end) && trees_->seen.coordToKeyChecked(to_octomap(end), key) &&
        occupied.count(key) > 0)
      hit.insert(key);
  }
  for (const octomap::OcTreeKey& key : free)
    if (hit.count(key) == 0) trees_->seen.updateNode(key, false, true);
  for (const octomap::OcTreeKey& key : hit) trees_->seen.updateNode(key, true, true);
  if (static_cast<double>(sight.stamp - faded_) * 1e-9 >= kFadeEach || sight.stamp < faded_)
    fade(sight);
}

/// Once a second.
void LocalMap::fade(const sight::Sight& sight) {
  octomap::OcTree& seen = trees_->seen;
  const double since = static_cast<double>(sight.stamp - faded_) * 1e-9;
  faded_ = sight.stamp;
  const auto loss = static_cast<float>(-seen.getClampingThresMaxLog() *
                                       std::clamp(since, 0.0, 2.0 * kFadeEach) / config_.forget);
  std::vector<octomap::OcTreeKey> fading;
  for (auto leaf = seen.begin_leafs(), end = seen.end_leafs(); leaf != end; ++leaf)
    if (leaf->getLogOdds() > 0.0F) fading.push_back(leaf.getKey());
  for (const octomap::OcTreeKey& key : fading) seen.updateNode(key, loss, true);
  if ((sight.robot.position - middle_).norm() < kFollow) return;
  // Written anew, as OcTree::deleteNode of the last leaf of a node stops at an assertion (1.9.7).
  middle_ = sight.robot.position;
  octomap::OcTree kept(config_.resolution);
  for (auto leaf = seen.begin_leafs(), end = seen.end_leafs(); leaf != end; ++leaf)
    if ((Eigen::Vector2d(leaf.getX(), leaf.getY()) - middle_).cwiseAbs().maxCoeff() <=
        config_.bound)
      kept.setNodeValue(leaf.getKey(), leaf->getLogOdds(), true);
  seen.swapContent(kept);
}

Column LocalMap::column_of(const Eigen::Vector2d& place) const {
  return {static_cast<int>(std::floor(place.x() / config_.resolution)),
          static_cast<int>(std::floor(place.y() / config_.resolution))};
}

int LocalMap::prior_at(const Column& column) const {
  const int x = column.first - low_.first;
  const int y = column.second - low_.second;
  if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return -1;
  return prior_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(x)];
}

LocalMap::Known LocalMap::at(const Eigen::Vector3d& point) const {
  const octomap::OcTree& seen = trees_->seen;
  const Column column = column_of(point.head<2>());
  octomap::OcTreeKey key;
  if (!seen.coordToKeyChecked(to_octomap(point), key)) return Known::nothing;
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy) {
      if (prior_at({column.first + dx, column.second + dy}) == 1) return Known::standing;
      for (int dz = -1; dz <= 1; ++dz) {
        const octomap::OcTreeKey near(static_cast<octomap::key_type>(key[0] + dx),
                                      static_cast<octomap::key_type>(key[1] + dy),
                                      static_cast<octomap::key_type>(key[2] + dz));
        const octomap::OcTreeNode* node = seen.search(near);
        if (node && seen.isNodeOccupied(node)) return Known::standing;
      }
    }
  const octomap::OcTreeNode* here = seen.search(key);
  const bool clear = prior_at(column) == 0 || (here && here->getLogOdds() < kSurelyClear);
  return clear ? Known::clear : Known::nothing;
}

std::vector<Column> LocalMap::standing(const Eigen::Vector2d& place, double radius) const {
  std::vector<Column> found;
  const Column low = column_of(place.array() - radius);
  const Column high = column_of(place.array() + radius);
  for (int y = low.second; y <= high.second; ++y)
    for (int x = low.first; x <= high.first; ++x)
      if (prior_at({x, y}) == 1) found.emplace_back(x, y);
  const octomap::OcTree& seen = trees_->seen;
  const auto corner = [&](double side) {
    return to_octomap({place.x() + side * radius, place.y() + side * radius,
                       config_.floor + (side < 0.0 ? 0.0 : config_.high)});
  };
  const octomap::point3d lowest = corner(-1.0), highest = corner(1.0);
  for (auto leaf = seen.begin_leafs_bbx(lowest, highest), end = seen.end_leafs_bbx(); leaf != end;
       ++leaf)
    if (seen.isNodeOccupied(*leaf)) found.push_back(column_of({leaf.getX(), leaf.getY()}));
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<std::int8_t> LocalMap::bytes() const {
  octomap::OcTree all(trees_->prior);
  const octomap::OcTree& seen = trees_->seen;
  for (auto leaf = seen.begin_leafs(), end = seen.end_leafs(); leaf != end; ++leaf) {
    const octomap::point3d at = leaf.getCoordinate();
    if (seen.isNodeOccupied(*leaf)) all.updateNode(at, true, true);
    if (at.z() > config_.floor && prior_at(column_of({at.x(), at.y()})) < 0)
      all.updateNode(to_octomap({at.x(), at.y(), config_.floor - 0.5 * config_.resolution}), true,
                     true);
  }
  all.updateInnerOccupancy();
  all.prune();
  std::ostringstream out;
  if (all.getRoot()) all.writeBinaryData(out);
  const std::string text = out.str();
  return {text.begin(), text.end()};
}

}  // namespace navvi_perception::map
