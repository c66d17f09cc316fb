#include "description/floor_height.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "description/footprint.hpp"

namespace navvi_sim {
namespace {

constexpr double kLevel = 0.985;  // cosine of 10 degrees
constexpr double kBin = 0.01;     // m

/// Area by height.
class Surfaces {
 public:
  void add(double height, double area) {
    Sum& sum = bins_[std::lround(height / kBin)];
    sum.area += area;
    sum.moment += area * height;
  }
  [[nodiscard]] std::optional<double> main_height() const {
    double most = 0.0;
    for (const auto& [bin, sum] : bins_) most = std::max(most, sum.area);
    for (auto it = bins_.rbegin(); it != bins_.rend(); ++it)
      if (most > 0.0 && it->second.area >= 0.9 * most) return it->second.moment / it->second.area;
    return std::nullopt;
  }

 private:
  struct Sum {
    double area = 0.0;
    double moment = 0.0;
  };
  std::map<long, Sum> bins_;
};

void add_top(Surfaces& surfaces, const Box& box, const Eigen::Isometry3d& pose) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d normal = pose.linear().col(axis);
    if (std::abs(normal.z()) < kLevel) continue;
    surfaces.add(pose.translation().z() + std::abs(normal.z()) * box.size[axis] / 2.0,
                 box.size[(axis + 1) % 3] * box.size[(axis + 2) % 3]);
  }
}

void add_level(Surfaces& surfaces, const Mesh& mesh, const Eigen::Isometry3d& pose) {
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d a = pose * mesh.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d b = pose * mesh.vertices[triangle[1]].cast<double>();
    const Eigen::Vector3d c = pose * mesh.vertices[triangle[2]].cast<double>();
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    // Either side: not every mesh is wound the right way round.
    if (std::abs(normal.z()) >= kLevel * normal.norm() && normal.norm() > 0.0)
      surfaces.add((a.z() + b.z() + c.z()) / 3.0, normal.norm() / 2.0);
  }
}

/// Corners of a box around a geometry, or a mesh's vertices.
std::vector<Eigen::Vector3d> corners_of(const Geometry& geometry) {
  if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    const double width = 2.0 * cylinder->radius;
    return hull_points(Box{{width, width, cylinder->length}});
  }
  if (const auto* sphere = std::get_if<Sphere>(&geometry))
    return hull_points(Box{Eigen::Vector3d::Constant(2.0 * sphere->radius)});
  return hull_points(geometry);
}

void extend(Eigen::AlignedBox3d& bounds, const Thing& thing) {
  for (const Shape& shape : thing.shapes)
    for (const Eigen::Vector3d& corner : corners_of(shape.geometry))
      bounds.extend(thing.pose * (shape.pose * corner));
}

}  // namespace

std::optional<double> main_floor_height(const std::vector<Thing>& things) {
  Surfaces surfaces;
  for (const Thing& thing : things) {
    if (thing.thing_class != ThingClass::floor) continue;
    for (const Shape& shape : thing.shapes) {
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      if (const auto* box = std::get_if<Box>(&shape.geometry)) add_top(surfaces, *box, pose);
      if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry))
        add_level(surfaces, **mesh, pose);
    }
  }
  return surfaces.main_height();
}

double top_of(const Thing& thing) { return bounds_of({thing}).max().z(); }

Eigen::AlignedBox3d bounds_of(const std::vector<Thing>& things) {
  Eigen::AlignedBox3d bounds;
  for (const Thing& thing : things) extend(bounds, thing);
  return bounds;
}

}  // namespace navvi_sim
