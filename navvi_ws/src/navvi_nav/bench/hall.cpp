#include "hall.hpp"

#include <cmath>
#include <random>

namespace navvi_nav::bench {
namespace {

constexpr double kShelf[2] = {10.0, 1.0};  // m
constexpr double kAisle = 3.0;             // m
constexpr double kTall = 0.4;              // m, all that the robot must see of a shelf
constexpr double kWall = 0.2;              // m

/// Occupied from (x0, y0, z0) to (x1, y1, z1), m.
void fill(octomap::OcTree& tree, double x0, double y0, double z0, double x1, double y1, double z1) {
  const double r = tree.getResolution();
  const auto voxel = [r](double at) { return std::lround(at / r); };
  const auto middle = [r](long voxel) {
    return static_cast<float>((static_cast<double>(voxel) + 0.5) * r);
  };
  for (long x = voxel(x0); x < voxel(x1); ++x)
    for (long y = voxel(y0); y < voxel(y1); ++y)
      for (long z = voxel(z0); z < voxel(z1); ++z)
        tree.updateNode(octomap::point3d(middle(x), middle(y), middle(z)), true, true);
}

}  // namespace

std::string Hall::name() const {
  return std::to_string(std::lround(length)) + " x " + std::to_string(std::lround(width)) + " m" +
         (clutter > 0.0 ? " cluttered" : "");
}

octomap::OcTree Hall::map() const {
  octomap::OcTree tree(resolution);
  fill(tree, 0, 0, -resolution, length, width, 0);
  fill(tree, 0, 0, 0, length, kWall, kTall);
  fill(tree, 0, width - kWall, 0, length, width, kTall);
  fill(tree, 0, 0, 0, kWall, width, kTall);
  fill(tree, length - kWall, 0, 0, length, width, kTall);
  for (double x = kAisle; x + kShelf[0] + kAisle <= length; x += kShelf[0] + kAisle)
    for (double y = kAisle; y + kShelf[1] + kAisle <= width; y += kShelf[1] + kAisle)
      fill(tree, x, y, 0, x + kShelf[0], y + kShelf[1], kTall);
  std::mt19937 random(seed);
  const auto draw = [&random](double below) {
    return 0.1 * static_cast<double>(random() % static_cast<unsigned>(below / 0.1));
  };
  const int boxes = clutter > 0.0 ? static_cast<int>(length * width / clutter) : 0;
  for (int i = 0; i < boxes; ++i) {
    const double x = 1.0 + draw(length - 3.0);
    const double y = 1.0 + draw(width - 3.0);
    const double edge = 0.3 + draw(0.6);
    fill(tree, x, y, 0, x + edge, y + edge, i % 2 == 0 ? 0.1 : kTall);
  }
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

}  // namespace navvi_nav::bench
