#include "description/floor_height.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "description/footprint.hpp"

namespace navvi_sim {
namespace {

constexpr double kLevel = 0.985;  // cosine of 10 degrees
constexpr double kBin = 0.01;     // m
constexpr double kStorey = 1.0;   // m, between levels of two storeys; no robot passes between
constexpr double kLowest = std::numeric_limits<double>::lowest();
constexpr double kStoreyShare = 0.25;  // of the largest level's area, that a storey has at least
constexpr double kSlabShare = 0.5;     // of the largest level below it, that a slab has at least
constexpr double kLeastFloor = 4.0;    // m^2: what is level and smaller stands on a floor
constexpr double kStands = 0.3;        // m, from a storey's level to the foot of what stands on it

/// Area of the level surfaces by height.
class Surfaces {
 public:
  void add(double height, double area) {
    Sum& sum = bins_[std::lround(height / kBin)];
    sum.area += area;
    sum.moment += area * height;
  }

  struct Level {
    double height;  ///< m
    double area;    ///< m^2
  };
  /// Of each storey the highest level with about its largest area, from the lowest storey up.
  [[nodiscard]] std::vector<Level> storeys() const {
    double largest = 0.0;
    for (const auto& [bin, sum] : bins_) largest = std::max(largest, sum.area);
    std::vector<Level> storeys;
    double most = 0.0;  // of the storey
    double below = 0.0;
    for (const auto& [bin, sum] : bins_) {
      if (sum.area <= 0.0 || sum.area < kStoreyShare * largest) continue;
      const Level level{sum.moment / sum.area, sum.area};
      if (storeys.empty() || level.height - below > kStorey) {
        storeys.push_back(level);
        most = 0.0;
      }
      below = level.height;
      most = std::max(most, level.area);
      if (level.area >= kSlabShare * most) storeys.back() = level;
    }
    return storeys;
  }
  /// m^2, of what lies from `low` to `high`
  [[nodiscard]] double area_between(double low, double high) const {
    double area = 0.0;
    for (const auto& [bin, sum] : bins_)
      if (sum.area > 0.0 && sum.moment >= low * sum.area && sum.moment <= high * sum.area)
        area += sum.area;
    return area;
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

void add_level(Surfaces& surfaces, const Thing& thing) {
  for (const Shape& shape : thing.shapes) {
    const Eigen::Isometry3d pose = thing.pose * shape.pose;
    if (const auto* box = std::get_if<Box>(&shape.geometry)) add_top(surfaces, *box, pose);
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry))
      add_level(surfaces, **mesh, pose);
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

std::vector<Surfaces::Level> storeys_of(const std::vector<Thing>& things) {
  Surfaces surfaces;
  for (const Thing& thing : things)
    if (thing.thing_class == ThingClass::floor) add_level(surfaces, thing);
  return surfaces.storeys();
}

}  // namespace

std::optional<double> main_floor_height(const std::vector<Thing>& things) {
  std::vector<double> feet;
  for (const Thing& thing : things)
    if (thing.thing_class != ThingClass::floor ||
        level_area(thing, kLowest, -kLowest) < kLeastFloor)
      feet.push_back(bounds_of({thing}).min().z());
  const std::vector<Surfaces::Level> storeys = storeys_of(things);
  std::vector<std::ptrdiff_t> standing;
  for (std::size_t i = 0; i < storeys.size(); ++i) {
    const bool is_last = i + 1 == storeys.size();
    standing.push_back(std::count_if(feet.begin(), feet.end(), [&](double foot) {
      return foot >= storeys[i].height - kStands &&
             (is_last || foot < storeys[i + 1].height - kStands);
    }));
  }
  for (std::size_t i = 0; i < storeys.size(); ++i)
    if (2 * standing[i] >= *std::max_element(standing.begin(), standing.end()))
      return storeys[i].height;
  return std::nullopt;
}

std::optional<double> storey_above(const std::vector<Thing>& things, double least) {
  for (const Surfaces::Level& storey : storeys_of(things))
    if (storey.height >= least) return storey.height;
  return std::nullopt;
}

double level_area(const Thing& thing, double low, double high) {
  Surfaces surfaces;
  add_level(surfaces, thing);
  return surfaces.area_between(low, high);
}

double top_of(const Thing& thing) { return bounds_of({thing}).max().z(); }

Eigen::AlignedBox3d bounds_of(const std::vector<Thing>& things) {
  Eigen::AlignedBox3d bounds;
  for (const Thing& thing : things) extend(bounds, thing);
  return bounds;
}

}  // namespace navvi_sim
