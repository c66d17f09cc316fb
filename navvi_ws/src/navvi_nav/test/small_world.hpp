#pragma once

#include <array>
#include <random>
#include <vector>

#include "octomap_tree.hpp"
#include "plan/nav_mesh.hpp"

namespace navvi_nav {

/// A hand-made map: boxes of voxels on a floor whose top is z = 0.
class SmallWorld {
 public:
  explicit SmallWorld(double resolution = 0.05) : tree_(resolution) {}

  /// Fills [x0, x1] x [y0, y1] x [z0, z1], m, all on voxel borders.
  SmallWorld& box(double x0, double y0, double z0, double x1, double y1, double z1) {
    const double r = tree_.getResolution();
    const auto cells = [r](double from, double to) { return std::lround((to - from) / r); };
    for (long x = 0; x < cells(x0, x1); ++x) {
      for (long y = 0; y < cells(y0, y1); ++y) {
        for (long z = 0; z < cells(z0, z1); ++z) {
          tree_.updateNode(octomap::point3d(at(x0, x), at(y0, y), at(z0, z)), true, true);
        }
      }
    }
    if (z1 > 0.0 && z0 < 0.7) blocks_.push_back({x0, y0, x1, y1});
    return *this;
  }
  SmallWorld& floor(double x0, double y0, double x1, double y1) {
    return box(x0, y0, -tree_.getResolution(), x1, y1, 0.0);
  }
  /// Floor with walls around, inside [0, width] x [0, depth].
  SmallWorld& room(double width, double depth) {
    floor(0, 0, width, depth);
    box(0, 0, 0, width, 0.1, 1.0);
    box(0, depth - 0.1, 0, width, depth, 1.0);
    box(0, 0, 0, 0.1, depth, 1.0);
    return box(width - 0.1, 0, 0, width, depth, 1.0);
  }

  [[nodiscard]] const octomap::OcTree& tree() {
    tree_.updateInnerOccupancy();
    tree_.prune();
    return tree_;
  }
  [[nodiscard]] map::Voxels voxels() { return voxels_of(tree()); }
  using Block = std::array<double, 4>;  ///< x0, y0, x1, y1
  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }

 private:
  [[nodiscard]] float at(double from, long step) const {
    return static_cast<float>(from + (static_cast<double>(step) + 0.5) * tree_.getResolution());
  }

  octomap::OcTree tree_;
  std::vector<Block> blocks_;
};

/// m, from a point to a block's outline; 0 inside
inline double distance_to(const SmallWorld::Block& block, Point p) {
  const double dx = std::max({block[0] - p.x, 0.0, p.x - block[2]});
  const double dy = std::max({block[1] - p.y, 0.0, p.y - block[3]});
  return std::hypot(dx, dy);
}

/// Points at most `step` m apart along the path.
inline std::vector<Point> points_along(const Path& path, double step) {
  std::vector<Point> out;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int parts = 1 + static_cast<int>(distance(path[i - 1], path[i]) / step);
    for (int k = 0; k <= parts; ++k)
      out.push_back(path[i - 1] + (static_cast<double>(k) / parts) * (path[i] - path[i - 1]));
  }
  return out;
}

/// A walled room of 20 x 14 m with boxes and cylinders anywhere.
struct RandomWorld {
  SmallWorld map;
  std::vector<Cylinder> cylinders;
  Point start;
  Point goal;

  explicit RandomWorld(unsigned seed) {
    std::mt19937 random(seed);
    const auto pick = [&random](int low, int high) {
      return static_cast<int>(random() % static_cast<unsigned>(high - low + 1)) + low;
    };
    map.room(20, 14);
    for (int i = 0; i < 14; ++i) {
      const double x = 0.05 * pick(20, 340);
      const double y = 0.05 * pick(20, 240);
      const double top = 0.05 * pick(1, 20);
      map.box(x, y, 0, x + 0.05 * pick(1, 50), y + 0.05 * pick(1, 30), top);
    }
    for (unsigned i = 0; i < 5; ++i)
      cylinders.push_back({i, {0.01 * pick(100, 1900), 0.01 * pick(100, 1300)}, 0.3, {}});
    start = {0.01 * pick(60, 1940), 0.01 * pick(60, 1340)};
    goal = {0.01 * pick(60, 1940), 0.01 * pick(60, 1340)};
  }
};

}  // namespace navvi_nav
