#pragma once

#include <octomap/OcTree.h>

#include <cmath>
#include <random>

namespace navvi_nav {

/// A hall of 50 x 30 m with its floor at z = 0: 24 shelves of 10 x 1 m in six rows with aisles of
/// 3 m between, pedestals 0.1 m high, and boxes. All edges lie on voxels of 0.1 m.
class VoxelWarehouse {
 public:
  static constexpr double kLength = 50.0;  ///< m, x from 0
  static constexpr double kWidth = 30.0;   ///< m, y from 0

  explicit VoxelWarehouse(double resolution) : tree_(resolution) {
    fill(0, 0, -resolution, kLength, kWidth, 0);
    fill(0, 0, 0, kLength, 0.2, 1);
    fill(0, kWidth - 0.2, 0, kLength, kWidth, 1);
    fill(0, 0, 0, 0.2, kWidth, 1);
    fill(kLength - 0.2, 0, 0, kLength, kWidth, 1);
    for (const double x : {2.5, 14.0, 26.0, 37.5})
      for (int row = 0; row < 6; ++row) fill(x, 4 + 4 * row, 0, x + 10, 5 + 4 * row, 1);
    std::mt19937 random(7);
    const auto draw = [&random](unsigned count) {
      return 0.1 * static_cast<double>(random() % count);
    };
    for (int i = 0; i < 40; ++i) {
      const double x = 3.0 + draw(430);
      const double y = 2.0 + draw(255);
      const double edge = 0.4 + draw(5);
      fill(x, y, 0, x + edge, y + edge, i % 2 == 0 ? 0.1 : 0.8);
    }
    tree_.updateInnerOccupancy();
    tree_.prune();
  }

  [[nodiscard]] const octomap::OcTree& tree() const { return tree_; }

 private:
  void fill(double x0, double y0, double z0, double x1, double y1, double z1) {
    const double r = tree_.getResolution();
    const auto voxel = [r](double at) { return std::lround(at / r); };
    const auto middle = [r](long voxel) {
      return static_cast<float>((static_cast<double>(voxel) + 0.5) * r);
    };
    for (long x = voxel(x0); x < voxel(x1); ++x)
      for (long y = voxel(y0); y < voxel(y1); ++y)
        for (long z = voxel(z0); z < voxel(z1); ++z)
          tree_.updateNode(octomap::point3d(middle(x), middle(y), middle(z)), true, true);
  }

  octomap::OcTree tree_;
};

}  // namespace navvi_nav
