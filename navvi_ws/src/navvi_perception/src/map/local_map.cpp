#include "map/local_map.hpp"

#include <octomap/octomap.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <navvi_config/reader.hpp>
#include <sstream>
#include <unordered_set>

namespace navvi_perception::map {
namespace {

constexpr double kOccupiedAbove = 65.0;  // per cent, as map_server's occupied_thresh
constexpr double kFadeEach = 1.0;        // s
constexpr double kFollow = 4.0;          // m, that the robot drives before the bound follows
constexpr float kSurelyClear = -1.0F;    // log-odds; three rays at 0.4
constexpr double kMostCells = 1e8;       // of a prior map
constexpr double kOnBorder = 1e-6;       // voxels, against rounding
constexpr double kDoubtful = 0.5;        // m, before the end of a ray, where a map may be amiss

octomap::point3d to_octomap(const Eigen::Vector3d& point) {
  return octomap::point3d(static_cast<float>(point.x()), static_cast<float>(point.y()),
                          static_cast<float>(point.z()));
}

/// The voxels of a box, each taken once.
class Once {
 public:
  Once(const octomap::OcTreeKey& least, const octomap::OcTreeKey& most)
      : least_(least),
        size_{most[0] - least[0] + std::size_t{1}, most[1] - least[1] + std::size_t{1},
              most[2] - least[2] + std::size_t{1}},
        taken_(size_[0] * size_[1] * size_[2]) {}

  /// False if it was taken before, or is not in the box.
  [[nodiscard]] bool take(const octomap::OcTreeKey& key) {
    std::size_t at = 0;
    for (unsigned i = 0; i < 3; ++i) {
      const auto along = static_cast<std::size_t>(key[i] - least_[i]);  // huge where negative
      if (along >= size_[i]) return false;
      at = at * size_[i] + along;
    }
    const bool first = !taken_[at];
    taken_[at] = true;
    return first;
  }

 private:
  octomap::OcTreeKey least_;
  std::array<std::size_t, 3> size_;
  std::vector<bool> taken_;
};

/// OcTree::search, which begins where the last one ended: those of a ray are near each other.
class Path {
 public:
  /// nullptr if no voxel is kept there. \param tree  since the first find() none of its nodes went
  [[nodiscard]] octomap::OcTreeNode* find(const octomap::OcTree& tree,
                                          const octomap::OcTreeKey& key) {
    const int apart = (key[0] ^ last_[0]) | (key[1] ^ last_[1]) | (key[2] ^ last_[2]);
    while (depth_ > 0 && apart >> (kDepth - depth_) != 0) --depth_;
    last_ = key;
    nodes_[0] = tree.getRoot();
    for (; nodes_[0] && depth_ < kDepth; ++depth_) {
      const unsigned child = octomap::computeChildIdx(key, kDepth - 1 - depth_);
      if (!tree.nodeChildExists(nodes_[depth_], child)) return nullptr;
      nodes_[depth_ + 1] = tree.getNodeChild(nodes_[depth_], child);
    }
    return nodes_[depth_];
  }

 private:
  static constexpr int kDepth = 16;  // of an octomap::OcTree
  std::array<octomap::OcTreeNode*, kDepth + 1> nodes_{};
  int depth_ = 0;  ///< down to which nodes_ leads to last_
  octomap::OcTreeKey last_{0, 0, 0};
};

}  // namespace

void MapConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(resolution, "resolution", Range{0.02, 0.5}, "m", "edge of a voxel");
  visit(bound, "bound", Range{2.0, 50.0}, "m",
        "along x and y to each side of the robot; beyond it only the prior map is kept");
  visit(floor, "floor", Range{-100.0, 100.0}, "m", "z of the floor, which is flat, in map");
  visit(low, "low", Range{0.01, 0.5}, "m", "above the floor; what ends lower is floor");
}

sight::Prior prior_of(const std::string& file, const MapConfig& config) {
  const auto refuse = [&](const std::string& why) {
    return navvi_config::ConfigError("The prior map " + file + " " + why);
  };
  octomap::OcTree binary(config.resolution);
  std::unique_ptr<octomap::AbstractOcTree> full;
  const octomap::OcTree* tree = nullptr;
  if (const std::size_t dot = file.rfind('.');
      dot != std::string::npos && file.substr(dot) == ".bt")
    tree = binary.readBinary(file) ? &binary : nullptr;
  else
    tree = dynamic_cast<octomap::OcTree*>(
        (full.reset(octomap::AbstractOcTree::read(file)), full.get()));
  if (!tree || tree->size() == 0)
    throw refuse(
        "cannot be read; allowed are OctoMap's .bt and .ot with an OcTree that is not empty.");
  Eigen::Vector3d low, high;
  tree->getMetricMin(low.x(), low.y(), low.z());
  tree->getMetricMax(high.x(), high.y(), high.z());
  sight::Prior prior;
  prior.flat = false;
  const double side = prior.resolution = tree->getResolution();
  prior.origin = low.head<2>();
  const Eigen::Vector2d cells = (high - low).head<2>() / side;
  if (cells.prod() > kMostCells)
    throw refuse("has too many cells: at most 100 million are allowed, seen from above.");
  prior.width = static_cast<int>(std::lround(cells.x()));
  prior.height = static_cast<int>(std::lround(cells.y()));
  prior.cells.assign(static_cast<std::size_t>(prior.width) * static_cast<std::size_t>(prior.height),
                     -1);
  for (auto leaf = tree->begin_leafs(), end = tree->end_leafs(); leaf != end; ++leaf) {
    const double half = 0.5 * leaf.getSize();
    const double bottom = leaf.getZ() - half - config.floor,
                 top = leaf.getZ() + half - config.floor;
    if (top < -1.5 * side || bottom > config.high - kOnBorder) continue;
    const bool stands = tree->isNodeOccupied(*leaf) && top > config.low;
    const auto number = [&](double at, double origin) { return std::lround((at - origin) / side); };
    for (long y = number(leaf.getY() - half, low.y()); y < number(leaf.getY() + half, low.y()); ++y)
      for (long x = number(leaf.getX() - half, low.x()); x < number(leaf.getX() + half, low.x());
           ++x) {
        std::int8_t& cell = prior.cells[static_cast<std::size_t>(y * prior.width + x)];
        cell = std::max(cell, static_cast<std::int8_t>(stands ? 100 : 0));
      }
  }
  return prior;
}

struct LocalMap::Trees {
  explicit Trees(double resolution) : prior(resolution), seen(resolution) {}
  octomap::OcTree prior;  ///< pruned
  octomap::OcTree seen;   ///< leaves of full depth only
  Path path;              ///< in `seen`
  /// Of `seen`, and when changed() was last asked.
  std::unordered_set<std::uint64_t> occupied, told;

  static std::uint64_t packed(const octomap::OcTreeKey& key) {
    return std::uint64_t{key[0]} << 32 | std::uint64_t{key[1]} << 16 | std::uint64_t{key[2]};
  }
  static octomap::OcTreeKey unpacked(std::uint64_t key) {
    return {static_cast<octomap::key_type>(key >> 32), static_cast<octomap::key_type>(key >> 16),
            static_cast<octomap::key_type>(key)};
  }
  /// \param by  log-odds
  void update(const octomap::OcTreeKey& key, float by) {
    octomap::OcTreeNode* node = path.find(seen, key);
    const float before = node ? node->getLogOdds() : 0.0F;
    if (node && by < 0.0F && before <= seen.getClampingThresMinLog()) return;
    if (node)
      seen.updateNodeLogOdds(node, by);  // without a second way down the tree
    else
      node = seen.updateNode(key, by, true);
    if (seen.isNodeOccupied(node))
      occupied.insert(packed(key));
    else if (before >= seen.getOccupancyThresLog())
      occupied.erase(packed(key));
  }
};

LocalMap::LocalMap(const MapConfig& config, const sight::Prior& prior)
    : config_(config), trees_(std::make_unique<Trees>(config.resolution)) {
  trees_->seen.setProbHit(config.kHit);
  trees_->seen.setProbMiss(config.kMiss);
  know(prior);
}

LocalMap::~LocalMap() = default;

void LocalMap::know(const sight::Prior& prior) {
  flat_ = prior.flat;
  prior_told_ = false;
  prior_.clear();
  columns_ = rows_ = 0;
  trees_->prior.clear();
  if (prior.cells.empty()) return;
  const double side = config_.resolution;
  const Eigen::Rotation2Dd turn(prior.yaw);
  const Eigen::Vector2d size = prior.resolution * Eigen::Vector2d(prior.width, prior.height);
  Eigen::AlignedBox2d box(prior.origin);
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(size.x(), 0.0), size, Eigen::Vector2d(0.0, size.y())})
    box.extend(prior.origin + turn * corner);
  const double inside = kOnBorder * side;
  low_ = column_of(box.min() + Eigen::Vector2d(inside, inside));
  const Column high = column_of(box.max() - Eigen::Vector2d(inside, inside));
  columns_ = high.first - low_.first + 1;
  rows_ = high.second - low_.second + 1;
  prior_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const int top = static_cast<int>(std::ceil(config_.high / side));
  // The middle of a column may lie outside the grid though some of the column is in it.
  const double slack = 0.5 * side / prior.resolution;
  for (int y = low_.second; y <= high.second; ++y) {
    for (int x = low_.first; x <= high.first; ++x) {
      const Eigen::Vector2d middle((x + 0.5) * side, (y + 0.5) * side);
      const Eigen::Vector2d cell = turn.inverse() * (middle - prior.origin) / prior.resolution;
      const bool out = cell.x() < -slack || cell.y() < -slack || cell.x() > prior.width + slack ||
                       cell.y() > prior.height + slack;
      const auto number = [](double at, int count) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(std::floor(at)), 0, count - 1));
      };
      const int value =
          out ? -1
              : prior.cells[number(cell.y(), prior.height) * static_cast<std::size_t>(prior.width) +
                            number(cell.x(), prior.width)];
      prior_.push_back(value < 0 ? kUnknown : value > kOccupiedAbove ? kOccupied : kClear);
      if (value < 0) continue;
      const int up_to = prior_.back() == kOccupied ? top : 0;
      for (int z = -1; z < up_to; ++z)
        trees_->prior.updateNode(
            to_octomap({middle.x(), middle.y(), config_.floor + (z + 0.5) * side}), true, true);
    }
  }
  trees_->prior.updateInnerOccupancy();
  trees_->prior.prune();
  widen_prior();
}

void LocalMap::widen_prior() {
  const int reach = static_cast<int>(std::ceil(config_.kSlack / config_.resolution - kOnBorder));
  const auto at = [this](int x, int y) -> Prior& {
    return prior_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x)
      for (int dy = -reach; at(x, y) == kOccupied && dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
          const int near_x = std::clamp(x + dx, 0, columns_ - 1);
          const int near_y = std::clamp(y + dy, 0, rows_ - 1);
          if (at(near_x, near_y) != kOccupied) at(near_x, near_y) = kNear;
        }
}

void LocalMap::insert(const sight::Sight& sight) {
  // What OcTree::insertPointCloud does, whose hash sets would take most of the time.
  const Eigen::Vector3d reach(config_.bound, config_.bound, 0.0);
  Eigen::Vector3d low = sight.origin - reach, high = sight.origin + reach;
  low.z() = std::min(sight.origin.z(), config_.floor - 0.5 * config_.resolution);
  high.z() = std::max(sight.origin.z(), config_.floor + config_.high);
  octomap::OcTree& seen = trees_->seen;
  octomap::OcTreeKey key, least, most;
  if (!seen.coordToKeyChecked(to_octomap(low), least) ||
      !seen.coordToKeyChecked(to_octomap(high), most))
    return;
  Once once(least, most);
  std::vector<octomap::point3d> ends;
  octomap::KeySet hit;
  for (const auto* part : {&sight.hits, &sight.clear})
    for (const Eigen::Vector3d& end : *part) {
      const Eigen::Vector3d way = end - sight.origin;
      const double rise = (way.z() > 0.0 ? high : low).z() - sight.origin.z();
      const double share =
          std::min(config_.bound / way.norm(), way.z() == 0.0 ? 1.0 : rise / way.z());
      const octomap::point3d there = to_octomap(sight.origin + std::min(share, 1.0) * way);
      key = seen.coordToKey(there);
      if (share >= 1.0 && part == &sight.hits && matters(end) &&
          prior_at(column_of(end.head<2>())) < kNear)
        hit.insert(key);
      if (share < 1.0 || once.take(key)) ends.push_back(there);
    }
  octomap::KeyRay ray;
  for (const octomap::point3d& end : ends) {
    if (!seen.computeRayKeys(to_octomap(sight.origin), end, ray)) continue;
    for (const octomap::OcTreeKey& passed : ray)
      if (once.take(passed)) trees_->update(passed, seen.getProbMissLog());
  }
  for (const octomap::OcTreeKey& met : hit) trees_->update(met, seen.getProbHitLog());
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
  const auto fading = trees_->occupied;
  for (const std::uint64_t key : fading) trees_->update(Trees::unpacked(key), loss);
  if ((sight.robot.position - middle_).norm() < kFollow) return;
  // Written anew, as OcTree::deleteNode of the last leaf of a node stops at an assertion (1.9.7).
  middle_ = sight.robot.position;
  octomap::OcTree kept(config_.resolution);
  for (auto leaf = seen.begin_leafs(), end = seen.end_leafs(); leaf != end; ++leaf) {
    const Eigen::Vector2d away = Eigen::Vector2d(leaf.getX(), leaf.getY()) - middle_;
    if (away.cwiseAbs().maxCoeff() <= config_.bound)
      kept.setNodeValue(leaf.getKey(), leaf->getLogOdds(), true);
    else
      trees_->occupied.erase(Trees::packed(leaf.getKey()));
  }
  seen.swapContent(kept);
  trees_->path = {};
}

Column LocalMap::column_of(const Eigen::Vector2d& place) const {
  return {static_cast<int>(std::floor(place.x() / config_.resolution)),
          static_cast<int>(std::floor(place.y() / config_.resolution))};
}

LocalMap::Prior LocalMap::prior_at(const Column& column) const {
  const int x = column.first - low_.first;
  const int y = column.second - low_.second;
  if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return kUnknown;
  return prior_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(x)];
}

LocalMap::Known LocalMap::at(const Eigen::Vector3d& point, bool in_plane) const {
  const Prior prior = prior_at(column_of(point.head<2>()));
  octomap::OcTreeKey key;
  if (prior >= kNear) return Known::standing;
  if (!trees_->seen.coordToKeyChecked(to_octomap(point), key)) return Known::nothing;
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dz = -1; dz <= 1; ++dz)
        if (trees_->occupied.count(Trees::packed({static_cast<octomap::key_type>(key[0] + dx),
                                                  static_cast<octomap::key_type>(key[1] + dy),
                                                  static_cast<octomap::key_type>(key[2] + dz)})) >
            0)
          return Known::standing;
  const octomap::OcTreeNode* here = trees_->seen.search(key);
  const bool clear =
      ((in_plane || !flat_) && prior == kClear) || (here && here->getLogOdds() < kSurelyClear);
  return clear ? Known::clear : Known::nothing;
}

bool LocalMap::contradicts(const sight::Sight& sight) const {
  return std::any_of(sight.clear.begin(), sight.clear.end(), [&](const Eigen::Vector3d& end) {
    const Eigen::Vector2d from = sight.origin.head<2>();
    const Eigen::Vector2d way = end.head<2>() - from;
    const double length = way.norm();
    for (double at = 0.0; at < length - kDoubtful; at += 0.5 * config_.resolution)
      if (prior_at(column_of(from + at / length * way)) == kOccupied) return true;
    return false;
  });
}

std::vector<Column> LocalMap::standing(const Eigen::Vector2d& place, double radius) const {
  std::vector<Column> found;
  const Column low = column_of(place.array() - radius);
  const Column high = column_of(place.array() + radius);
  for (int y = low.second; y <= high.second; ++y)
    for (int x = low.first; x <= high.first; ++x)
      if (prior_at({x, y}) == kOccupied) found.emplace_back(x, y);
  for (const std::uint64_t key : trees_->occupied) {
    const octomap::point3d middle = trees_->seen.keyToCoord(Trees::unpacked(key));
    const Column column = column_of({middle.x(), middle.y()});
    if (column.first >= low.first && column.first <= high.first && column.second >= low.second &&
        column.second <= high.second)
      found.push_back(column);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<Eigen::Vector3d> LocalMap::seen() const {
  std::vector<Eigen::Vector3d> middles;
  for (const std::uint64_t key : trees_->occupied) {
    const octomap::point3d middle = trees_->seen.keyToCoord(Trees::unpacked(key));
    middles.emplace_back(middle.x(), middle.y(), middle.z());
  }
  return middles;
}

bool LocalMap::changed() {
  const bool same =
      std::exchange(prior_told_, true) && !prior_.empty() && trees_->told == trees_->occupied;
  trees_->told = trees_->occupied;
  return !same;
}

std::vector<std::int8_t> LocalMap::bytes() const {
  octomap::OcTree all(trees_->prior);
  for (const std::uint64_t key : trees_->occupied) all.updateNode(Trees::unpacked(key), true);
  const octomap::OcTree& seen = trees_->seen;
  for (auto leaf = seen.begin_leafs(), end = seen.end_leafs(); prior_.empty() && leaf != end;
       ++leaf)
    if (leaf.getZ() > config_.floor)
      all.updateNode(
          to_octomap({leaf.getX(), leaf.getY(), config_.floor - 0.5 * config_.resolution}), true);
  std::ostringstream out;
  if (all.getRoot()) all.writeBinaryData(out);
  const std::string text = out.str();
  return {text.begin(), text.end()};
}

}  // namespace navvi_perception::map
