#include "navvi_sim/occupancy/occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "description/floor_height.hpp"
#include "occupancy/octree_writer.hpp"

namespace navvi_sim::occupancy {
namespace {

constexpr double kReach = 0.05;  // share of a voxel's edge that a shape must reach into
constexpr std::size_t kMaxBytes = 64U * 1024U * 1024U;  // as many as navigation takes
constexpr std::size_t kMostFilled = 2'000;              // triangles of a mesh
constexpr double kWidestFilled = 4.0;  // m, the lesser side: what is wider may be a building

bool is_aligned(const Eigen::Isometry3d& pose) {
  return (pose.linear().cwiseAbs().rowwise().maxCoeff().array() > 1.0 - 1e-9).all();
}

/// Where the robot drives, on a border of voxels.
struct Ground {
  double height;     ///< m
  double underside;  ///< m, of the robot, above that

  /// m, by which what reaches up to `top` rises to be level with the ground: what the robot drives
  /// over. 0 for everything else.
  [[nodiscard]] double rise(double top) const {
    const double to_ground = height - top;
    return std::abs(to_ground) < underside - 1e-9 ? to_ground : 0.0;
  }
};

/// Adds a shape of any kind to the occupied shapes.
class ShapeInserter {
 public:
  /// \param enclosing  the inside of a closed mesh is where one drives
  /// \param solid      it is not, whatever the thing
  ShapeInserter(OccupiedShapes& shapes, const Eigen::Isometry3d& pose, double resolution,
                const Ground& ground, bool enclosing, bool solid)
      : shapes_(shapes),
        pose_(pose),
        resolution_(resolution),
        ground_(ground),
        enclosing_(enclosing),
        solid_(solid) {}

  void operator()(const Box& box) const {
    const double reach = reach_of(box.size.minCoeff());
    if (is_aligned(pose_))
      shapes_.boxes.push_back(voxel_box(box, reach));
    else if (pose_.linear()(2, 2) == 1.0)
      add_upright(TurnedBox(box.size, pose_), reach, pose_.linear().cwiseAbs() * box.size / 2.0);
    else
      shapes_.solids.push_back({TurnedBox(box.size, pose_), reach});
  }
  void operator()(const Cylinder& cylinder) const {
    const double reach = reach_of(std::min(2.0 * cylinder.radius, cylinder.length));
    const SolidCylinder solid(cylinder, pose_);
    if (solid.upright())
      add_upright(solid, reach, {cylinder.radius, cylinder.radius, cylinder.length / 2.0});
    else
      shapes_.solids.push_back({solid, reach});
  }
  void operator()(const Sphere& sphere) const {
    shapes_.solids.push_back(
        {SolidSphere(sphere, pose_.translation()), reach_of(2.0 * sphere.radius)});
  }
  void operator()(const std::shared_ptr<const Mesh>& mesh) const {
    // A surface has no inside to reach into: it counts a little below where it is instead.
    const Eigen::Vector3d down = -kReach * resolution_ * Eigen::Vector3d::UnitZ();
    const auto rise_of = [&](double top) { return ground_.rise(top - down.z()); };
    std::vector<Triangle> triangles;
    for (const auto& indices : mesh->triangles) {
      Triangle triangle;
      for (std::size_t i = 0; i < 3; ++i)
        triangle.corners[i] = pose_ * mesh->vertices[indices[i]].cast<double>() + down;
      triangles.push_back(triangle);
    }
    if (solid_ || (!enclosing_ && triangles.size() <= kMostFilled))
      for (ClosedMesh& part : closed_parts(triangles))
        if ((solid_ || part.bounds().sizes().head<2>().minCoeff() <= kWidestFilled) &&
            rise_of(part.bounds().max().z()) == 0.0)
          shapes_.closed.push_back(std::move(part));
    for (Triangle& triangle : triangles) {
      const auto& [a, b, c] = triangle.corners;
      const double rise = rise_of(std::max({a.z(), b.z(), c.z()}));
      for (Eigen::Vector3d& corner : triangle.corners) corner.z() += rise;
      shapes_.triangles.push_back(triangle);
    }
  }

 private:
  /// m, that a solid must reach into a voxel.
  /// \param thickness  m, its least extent
  [[nodiscard]] double reach_of(double thickness) const {
    return std::min(kReach * resolution_, thickness / 4.0);
  }

  /// All columns of a solid that stands upright have the same layers of it: a box a row. It always
  /// has its middle voxel, as `reach` is a quarter of the thickness at most.
  /// \param half  m, of its extent
  template <typename Upright>
  void add_upright(const Upright& solid, double reach, const Eigen::Vector3d& half) const {
    const double edge = resolution_;
    const auto middle_of = [edge](int voxel) {  // as OctreeWriter comes to it, to the last bit
      return ((voxel & ~1) + 1) * edge + ((voxel & 1) != 0 ? edge / 2.0 : -edge / 2.0);
    };
    const auto has = [&](int x, int y, int z) {
      return solid.overlap({{middle_of(x), middle_of(y), middle_of(z)}, edge / 2.0 - reach}) !=
             Overlap::none;
    };
    const auto voxel_at = [edge](const Eigen::Vector3d& at) -> Eigen::Array3i {
      return (at / edge).array().floor().cast<int>();
    };
    const Eigen::Array3i middle = voxel_at(pose_.translation());
    const Eigen::Array3i from = voxel_at(pose_.translation() - half) - 1;
    const Eigen::Array3i to = voxel_at(pose_.translation() + half) + 2;
    constexpr int kCenter = OccupancyMap::kCenter;
    int bottom = middle.z(), top = middle.z() + 1;
    while (has(middle.x(), middle.y(), bottom - 1)) --bottom;
    while (has(middle.x(), middle.y(), top)) ++top;
    for (int y = from.y(); y < to.y(); ++y) {
      int left = from.x(), right = to.x();
      while (left < right && !has(left, y, middle.z())) ++left;
      while (left < right && !has(right - 1, y, middle.z())) --right;
      if (left < right)
        shapes_.boxes.push_back({{{left + kCenter, y + kCenter, bottom + kCenter},
                                  {right + kCenter, y + 1 + kCenter, top + kCenter}}});
    }
  }

  /// The voxels that a box along the axes reaches into.
  [[nodiscard]] VoxelBox voxel_box(const Box& box, double reach) const {
    const Eigen::Vector3d half =
        pose_.linear().array().round().matrix().cwiseAbs() * box.size / 2.0;
    const Eigen::Vector3d low = pose_.translation() - half;
    const Eigen::Vector3d high = pose_.translation() + half;
    VoxelBox voxels{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      voxels.low[i] = OccupancyMap::kCenter - 1 +
                      static_cast<int>(std::ceil((low[axis] + reach) / resolution_));
      voxels.high[i] = OccupancyMap::kCenter + 1 +
                       static_cast<int>(std::floor((high[axis] - reach) / resolution_));
    }
    return voxels;
  }

  OccupiedShapes& shapes_;
  Eigen::Isometry3d pose_;
  double resolution_;
  Ground ground_;
  bool enclosing_;
  bool solid_;
};

void check_reach(const Thing& thing, const Eigen::AlignedBox3d& bounds, double resolution) {
  const double reach = OccupancyMap::kCenter * resolution;
  const double extent = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).maxCoeff();
  if (!(extent < reach))
    throw WorldError("thing '" + thing.name + "' reaches " + std::to_string(extent) +
                     " m from the origin; allowed is less than " + std::to_string(reach) +
                     " m at the OctoMap's resolution of " + std::to_string(resolution) + " m");
}

OccupiedShapes shapes_of(const WorldDescription& world, const OccupancyConfig& config) {
  const double border = std::round(world.floor_height / config.resolution) * config.resolution;
  const Ground ground{border, config.underside};
  OccupiedShapes shapes;
  for (const Thing& thing : world.things) {
    if (thing.route) continue;
    const bool enclosing =
        thing.thing_class == ThingClass::floor || thing.thing_class == ThingClass::wall;
    for (const Shape& shape : thing.shapes) {
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      const Eigen::AlignedBox3d bounds = bounds_of(shape.geometry, pose);
      if (bounds.isEmpty()) continue;
      check_reach(thing, bounds, config.resolution);
      const double shift = border - world.floor_height;
      const Eigen::Translation3d lift(0.0, 0.0, shift + ground.rise(bounds.max().z() + shift));
      std::visit(
          ShapeInserter(shapes, lift * pose, config.resolution, ground, enclosing, shape.solid),
          shape.geometry);
    }
  }
  return shapes;
}

}  // namespace

void OccupancyConfig::describe(navvi_config::Visitor& visit) {
  visit(resolution, "resolution", navvi_config::Range{0.01, 1.0}, "m",
        "edge of a voxel of the OctoMap");
}

OccupancyMap occupancy_of(const WorldDescription& world, const OccupancyConfig& config) {
  return {config.resolution, write_octree(shapes_of(world, config), config.resolution, kMaxBytes)};
}

navvi_floor::Voxels voxels_of(const OccupancyMap& map) {
  if (map.stream().empty()) return {"", map.resolution(), {}};
  return navvi_floor::read_voxels(
      {map.stream().data(), map.stream().size(), true, "OcTree", map.resolution()});
}

navvi_floor::Voxels voxels_of(const WorldDescription& world, const OccupancyConfig& config) {
  OccupiedShapes shapes = shapes_of(world, config);
  const std::vector<VoxelBox> boxes = std::exchange(shapes.boxes, {});
  navvi_floor::Voxels out =
      voxels_of({config.resolution, write_octree(shapes, config.resolution, kMaxBytes)});
  out.boxes.assign(boxes.begin(), boxes.end());
  return out;
}

}  // namespace navvi_sim::occupancy
