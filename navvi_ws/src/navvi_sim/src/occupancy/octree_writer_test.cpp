// Random worlds beside octomap: every voxel is judged for itself, by geometry that this test
// computes for itself, and put into octomap one by one; what octomap then writes must be our bytes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "navvi_sim/occupancy/occupancy.hpp"
#include "octomap_tree.hpp"

namespace navvi_sim::occupancy {
namespace {

constexpr double kReach = 0.05;  // of a voxel's edge

using Points = std::vector<Eigen::Vector3d>;

Points corners_of_box(const Eigen::Vector3d& size, const Eigen::Isometry3d& pose) {
  Points corners;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2 & 1) - 0.5);
    corners.push_back(pose * sign.cwiseProduct(size));
  }
  return corners;
}

/// Whether two convex hulls touch, by the axes that may part them.
bool touch(const Points& a, const Points& b, const Points& axes) {
  return std::none_of(axes.begin(), axes.end(), [&](const Eigen::Vector3d& axis) {
    if (axis.norm() < 1e-9) return false;
    const auto along = [&](const Points& points) {
      double low = 1e9;
      double high = -1e9;
      for (const Eigen::Vector3d& point : points) {
        low = std::min(low, axis.dot(point));
        high = std::max(high, axis.dot(point));
      }
      return std::make_pair(low, high);
    };
    const auto [a_low, a_high] = along(a);
    const auto [b_low, b_high] = along(b);
    return a_high < b_low || b_high < a_low;
  });
}

/// The axes of a voxel and of a hull with these edges and normals, and across their edges.
Points axes_of(const Points& edges, const Points& normals) {
  Points axes = normals;
  for (int i = 0; i < 3; ++i) {
    axes.push_back(Eigen::Vector3d::Unit(i));
    for (const Eigen::Vector3d& edge : edges) axes.push_back(edge.cross(Eigen::Vector3d::Unit(i)));
  }
  return axes;
}

/// Whether one shape occupies the voxel around `centre`.
class Occupies {
 public:
  Occupies(const Eigen::Isometry3d& pose, const Eigen::Vector3d& centre, double voxel)
      : pose_(pose), centre_(centre), voxel_(voxel) {}

  bool operator()(const Box& box) const {
    const double reach = std::min(kReach * voxel_, box.size.minCoeff() / 4.0);
    const Points edges{pose_.linear().col(0), pose_.linear().col(1), pose_.linear().col(2)};
    return touch(corners_of_box(box.size, pose_), cube(reach), axes_of(edges, edges));
  }
  bool operator()(const Cylinder& cylinder) const {
    const double thickness = std::min(2.0 * cylinder.radius, cylinder.length);
    const double half = voxel_ / 2.0 - std::min(kReach * voxel_, thickness / 4.0);
    const Eigen::Vector3d at = pose_.inverse() * centre_;
    if (std::abs(pose_.linear()(2, 2)) < 1.0 - 1e-9) {  // turned: by the ball around the voxel
      const double ball = half * std::sqrt(3.0);
      return at.head<2>().norm() <= cylinder.radius + ball &&
             std::abs(at.z()) <= cylinder.length / 2.0 + ball;
    }
    const Eigen::Vector3d out =
        ((centre_ - pose_.translation()).cwiseAbs().array() - half).max(0.0).matrix();
    return out.head<2>().norm() <= cylinder.radius && out.z() <= cylinder.length / 2.0;
  }
  bool operator()(const Sphere& sphere) const {
    const double half = voxel_ / 2.0 - std::min(kReach * voxel_, sphere.radius / 2.0);
    const Eigen::Vector3d out =
        ((centre_ - pose_.translation()).cwiseAbs().array() - half).max(0.0).matrix();
    return out.norm() <= sphere.radius;
  }
  /// A closed mesh here is convex and holds its frame's origin.
  bool operator()(const std::shared_ptr<const Mesh>& mesh) const {
    const Eigen::Vector3d down(0.0, 0.0, -kReach * voxel_);
    const bool closed = mesh->triangles.size() > 1;
    bool inside = closed;
    for (const auto& triangle : mesh->triangles) {
      Points t;
      for (const std::uint32_t i : triangle)
        t.emplace_back(pose_ * mesh->vertices[i].cast<double>() + down);
      const Points edges{t[1] - t[0], t[2] - t[1], t[0] - t[2]};
      const Eigen::Vector3d normal = edges[0].cross(edges[1]);
      if (touch(t, cube(0.0), axes_of(edges, {normal}))) return true;
      const Eigen::Vector3d middle = pose_.translation() + down;
      inside = inside && normal.dot(centre_ - t[0]) * normal.dot(middle - t[0]) > 0.0;
    }
    return inside;
  }

 private:
  [[nodiscard]] Points cube(double shrink) const {
    return corners_of_box(Eigen::Vector3d::Constant(voxel_ - 2.0 * shrink),
                          Eigen::Isometry3d(Eigen::Translation3d(centre_)));
  }

  const Eigen::Isometry3d& pose_;
  const Eigen::Vector3d& centre_;
  double voxel_;
};

/// Draws worlds around a place; along axis i around the map's origin, where the tree's root is
/// split, if bit i of the seed is set.
class Drawing {
 public:
  Drawing(std::uint64_t seed, double voxel) : random_(seed), voxel_(voxel) {
    for (int i = 0; i < 3; ++i) {
      const double far = (seed >> i & 1) != 0 ? 4.0 : 900.0;
      middle_[i] = voxel_ * std::round(uniform(-far, far));
    }
  }

  static constexpr int kAround = 16;  // voxels, the farthest that anything reaches
  [[nodiscard]] const Eigen::Vector3d& middle() const { return middle_; }

  WorldDescription world() {
    WorldDescription world;
    const int things = 1 + static_cast<int>(random_() % 10);
    for (int i = 0; i < things; ++i) {
      Thing thing;
      thing.name = "thing";
      thing.thing_class = ThingClass::box;
      switch (random_() % 7) {
        case 0:
          add(thing, slab());
          break;
        case 1:
          add(thing, at_borders());
          break;
        case 2:
          add(thing, {Box{size()}, pose(random_() % 2 == 0)});
          break;
        case 3:
          add(thing, {Cylinder{size().x(), size().y()}, pose(random_() % 2 == 0)});
          break;
        case 4:
          add(thing, {Sphere{size().x()}, pose(false)});
          break;
        case 5:
          add(thing, {mesh(false), pose(true)});
          break;
        default:
          add(thing, {mesh(true), pose(true)});
      }
      world.things.push_back(thing);
    }
    return world;
  }

 private:
  static void add(Thing& thing, Shape shape) { thing.shapes.push_back(std::move(shape)); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Eigen::Vector3d size() {
    return voxel_ * Eigen::Vector3d(uniform(0.1, 6.0), uniform(0.1, 6.0), uniform(0.1, 6.0));
  }
  Eigen::Isometry3d pose(bool turned) {
    const Eigen::Vector3d off(uniform(-8.0, 8.0), uniform(-8.0, 8.0), uniform(-8.0, 8.0));
    Eigen::Isometry3d pose(Eigen::Translation3d(middle_ + voxel_ * off));
    if (turned)
      for (int axis = 0; axis < 3; ++axis)
        pose.rotate(Eigen::AngleAxisd(uniform(-3.0, 3.0), Eigen::Vector3d::Unit(axis)));
    return pose;
  }
  /// Wide and flat, as a floor; along x or y it reaches as far as anything.
  Shape slab() {
    Eigen::Vector3d extent(2.0 * kAround, 2.0 * kAround, uniform(0.3, 5.0));
    if (random_() % 2 == 0) extent[static_cast<int>(random_() % 2)] = uniform(1.0, 8.0);
    return {Box{voxel_ * extent}, Eigen::Isometry3d(Eigen::Translation3d(middle_))};
  }
  /// A box with all its sides on borders of voxels.
  Shape at_borders() {
    Eigen::Vector3d low, high;
    for (int i = 0; i < 3; ++i) {
      low[i] = std::round(uniform(-kAround, kAround - 1));
      high[i] = std::min<double>(low[i] + 1.0 + static_cast<double>(random_() % 12), kAround);
    }
    return {Box{voxel_ * (high - low)},
            Eigen::Isometry3d(Eigen::Translation3d(middle_ + voxel_ * (low + high) / 2.0))};
  }
  /// A tetrahedron, or one side of it.
  std::shared_ptr<const Mesh> mesh(bool closed) {
    auto mesh = std::make_shared<Mesh>();
    const float r = static_cast<float>(voxel_ * uniform(1.0, 4.0));
    mesh->vertices = {{r, r, r}, {r, -r, -r}, {-r, r, -r}, {-r, -r, r}};
    mesh->triangles = {{0, 1, 2}};
    if (closed) mesh->triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    return mesh;
  }

  std::mt19937_64 random_;
  double voxel_;
  Eigen::Vector3d middle_;
};

/// Judged, put in and pruned voxel by voxel.
octomap::OcTree inserted(const WorldDescription& world, const Drawing& drawing, double voxel) {
  octomap::OcTree tree(voxel);
  constexpr int kAround = Drawing::kAround + 1;
  for (int x = -kAround; x < kAround; ++x)
    for (int y = -kAround; y < kAround; ++y)
      for (int z = -kAround; z < kAround; ++z) {
        const Eigen::Vector3d centre =
            drawing.middle() + voxel * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
        const bool any =
            std::any_of(world.things.begin(), world.things.end(), [&](const Thing& thing) {
              const Shape& shape = thing.shapes.front();
              return std::visit(Occupies(shape.pose, centre, voxel), shape.geometry);
            });
        if (any)
          tree.setNodeValue(octomap::point3d(centre.cast<float>().x(), centre.cast<float>().y(),
                                             centre.cast<float>().z()),
                            tree.getClampingThresMaxLog(), true);
      }
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

TEST(OctreeWriter, writes_what_octomap_writes_of_random_worlds_voxel_by_voxel) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const double voxel = std::array{0.05, 0.1, 0.037}[seed % 3];
    Drawing drawing(seed, voxel);
    const WorldDescription world = drawing.world();
    const octomap::OcTree reference = inserted(world, drawing, voxel);
    const OccupancyMap map = occupancy_of(world, OccupancyConfig{voxel, 0.0});
    ASSERT_GT(map.stream().size(), 32U);
    ASSERT_TRUE(tree_of(map) == reference) << "seed " << seed;
    ASSERT_EQ(std::string(map.stream().begin(), map.stream().end()), stream_of(reference)) << seed;
  }
}

TEST(OctreeWriter, writes_nothing_of_a_world_without_things) {
  EXPECT_TRUE(occupancy_of({}, {}).stream().empty());
  EXPECT_EQ(tree_of({0.05, {}}).size(), 0U);
}

}  // namespace
}  // namespace navvi_sim::occupancy
