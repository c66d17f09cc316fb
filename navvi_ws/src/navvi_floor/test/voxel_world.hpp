#pragma once

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "octomap_tree.hpp"

namespace navvi_floor {

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
  [[nodiscard]] Voxels voxels() { return voxels_of(tree()); }
  /// As it is sent. \param binary  or with a value a node
  [[nodiscard]] std::vector<std::int8_t> bytes(bool binary = true) {
    std::ostringstream out;
    if (octomap::OcTree sent = tree(); binary)
      sent.writeBinaryData(out);
    else
      sent.writeData(out);
    const std::string text = out.str();
    return {text.begin(), text.end()};
  }
  using Block = std::array<double, 4>;  ///< x0, y0, x1, y1
  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }

 private:
  [[nodiscard]] float at(double from, long step) const {
    return static_cast<float>(from + (static_cast<double>(step) + 0.5) * tree_.getResolution());
  }

  octomap::OcTree tree_;
  std::vector<Block> blocks_;
};

}  // namespace navvi_floor
