#include "scene/rack_drawing.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_sim::scene {
namespace {

constexpr double kBeam = 0.08;   // m, of uprights and rims
constexpr double kBoard = 0.05;  // m, thickness
constexpr Color kUpright{0.25F, 0.50F, 0.85F};

/// Adds cubes along the longer side of a box, whichever it is.
class RackBuilder {
 public:
  explicit RackBuilder(const Eigen::Vector3d& size) : along_x_(size.x() >= size.y()) {}

  /// \param low, high  m: along, across, up
  void add(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const Color& color) {
    parts_.push_back({Eigen::AlignedBox3d(turned(low), turned(high)), color});
  }
  [[nodiscard]] const std::vector<ColoredCube>& parts() const { return parts_; }

 private:
  [[nodiscard]] Eigen::Vector3d turned(const Eigen::Vector3d& v) const {
    return along_x_ ? v : Eigen::Vector3d(v.y(), v.x(), v.z());
  }

  bool along_x_;
  std::vector<ColoredCube> parts_;
};

/// The four beams around a board.
std::vector<ColoredCube> rim(const Eigen::Vector3d& size) {
  const Eigen::Vector3d half = 0.5 * size;
  const Color color = color_of(ThingClass::shelf);
  RackBuilder builder(size);
  const double length = std::max(half.x(), half.y()), depth = std::min(half.x(), half.y());
  for (const double side : {-depth, depth - kBeam})
    builder.add({-length, side, -half.z()}, {length, side + kBeam, half.z()}, color);
  for (const double end : {-length, length - kBeam})
    builder.add({end, kBeam - depth, -half.z()}, {end + kBeam, depth - kBeam, half.z()}, color);
  return builder.parts();
}

/// An open rack in place of a cube: uprights in pairs and boards, the highest one a rim.
std::vector<ColoredCube> rack(const Eigen::Vector3d& size) {
  constexpr double kBay = 2.0, kLevel = 0.7;  // m, about
  const Eigen::Vector3d half = 0.5 * size;
  const double length = std::max(half.x(), half.y()), depth = std::min(half.x(), half.y());
  RackBuilder builder(size);
  const int bays = std::max(1, static_cast<int>(std::lround(2.0 * length / kBay)));
  for (int i = 0; i <= bays; ++i) {
    const double at = -length + (2.0 * length - kBeam) * i / bays;
    for (const double side : {-depth, depth - kBeam})
      builder.add({at, side, -half.z()}, {at + kBeam, side + kBeam, half.z()}, kUpright);
  }
  const int levels = std::max(1, static_cast<int>(std::lround(size.z() / kLevel)));
  for (int i = 0; i < levels; ++i) {
    const double z = -half.z() + (size.z() - kBoard) * i / levels;
    builder.add({-length, -depth, z}, {length, depth, z + kBoard}, color_of(ThingClass::shelf));
  }
  std::vector<ColoredCube> parts = builder.parts();
  for (ColoredCube part : rim({size.x(), size.y(), kBoard})) {
    part.cube.translate(Eigen::Vector3d(0.0, 0.0, half.z() - 0.5 * kBoard));
    parts.push_back(part);
  }
  return parts;
}

/// How a box of a shelf is drawn, before long cubes are cut.
std::vector<ColoredCube> whole_parts(const Eigen::Vector3d& size, bool highest) {
  const double across = size.head<2>().minCoeff();
  const bool is_post = size.z() > 4.0 * size.head<2>().maxCoeff();
  if (size.z() > 1.0 && !is_post && across > 0.3) return rack(size);
  if (highest && size.z() < 0.2 && across > 4.0 * kBeam) return rim(size);
  const Eigen::AlignedBox3d whole(-0.5 * size, 0.5 * size);
  if (!is_post) return {{whole, color_of(ThingClass::shelf)}};
  // A little out of what it holds, so that the faces of the two are not in one plane.
  const Eigen::Vector3d out(0.005, 0.005, -0.005);
  return {{Eigen::AlignedBox3d(whole.min() - out, whole.max() + out), kUpright}};
}

/// The cube in equal pieces along its longer side, each short enough.
std::vector<Eigen::AlignedBox3d> planks(const Eigen::AlignedBox3d& cube) {
  const int axis = cube.sizes().x() >= cube.sizes().y() ? 0 : 1;
  const int count = std::max(1, static_cast<int>(std::ceil(cube.sizes()[axis] / kLongestCube)));
  std::vector<Eigen::AlignedBox3d> pieces(static_cast<std::size_t>(count), cube);
  for (int i = 0; i < count; ++i) {
    Eigen::AlignedBox3d& piece = pieces[static_cast<std::size_t>(i)];
    piece.min()[axis] = cube.min()[axis] + cube.sizes()[axis] * i / count;
    piece.max()[axis] = cube.min()[axis] + cube.sizes()[axis] * (i + 1) / count;
  }
  return pieces;
}

}  // namespace

std::vector<ColoredCube> shelf_parts(const Eigen::Vector3d& size, bool highest) {
  std::vector<ColoredCube> parts;
  for (const ColoredCube& part : whole_parts(size, highest))
    for (const Eigen::AlignedBox3d& plank : planks(part.cube)) parts.push_back({plank, part.color});
  return parts;
}

}  // namespace navvi_sim::scene
