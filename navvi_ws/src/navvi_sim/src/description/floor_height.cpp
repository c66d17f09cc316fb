#include "description/floor_height.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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
constexpr double kRises = 0.1;         // m above the floor, of what stands on it
constexpr double kSlab = 0.25;         // of a storey's area, that a slab on it covers at least
constexpr double kMost = 0.5;          // likewise, that makes it the floor whatever stands on it

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

/// m, in map: the top of the slabs of one height that cover most of a storey, or much of it and
/// bear half of the things on it or more, such as asphalt on a ground plane; of several heights the
/// highest, and `floor` if there is none.
double top_of_slab(const std::vector<Thing>& things, double floor, double area) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Thing& thing : things) boxes.push_back(bounds_of({thing}));
  std::map<long, std::vector<std::size_t>> slabs;  // by their tops
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double top = boxes[i].max().z();
    if (!things[i].route && top > floor && top <= floor + kStands &&
        level_area(things[i], top - kBin, top) > 0.0)
      slabs[std::lround(top / kBin)].push_back(i);
  }
  double height = floor;
  for (const auto& [level, same] : slabs) {
    const double top = boxes[same.front()].max().z();
    double covered = 0.0;
    for (const std::size_t i : same)
      covered += level_area(things[i], boxes[i].max().z() - kBin, boxes[i].max().z());
    if (covered < kSlab * area) continue;
    int on_slab = 0, others = 0;
    for (const Eigen::AlignedBox3d& box : boxes) {
      if (box.max().z() <= top || box.min().z() > top + kStands) continue;
      ++others;
      const Eigen::Vector3d centre = box.center();
      on_slab += std::any_of(same.begin(), same.end(), [&](std::size_t i) {
        return (centre - boxes[i].min()).head<2>().minCoeff() >= 0.0 &&
               (boxes[i].max() - centre).head<2>().minCoeff() >= 0.0;
      });
    }
    if (covered >= kMost * area || (on_slab > 0 && 2 * on_slab >= others)) height = top;
  }
  return height;
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
      return top_of_slab(things, storeys[i].height, storeys[i].area);
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

Eigen::AlignedBox3d bounds_of(const Geometry& geometry, const Eigen::Isometry3d& pose) {
  Eigen::Vector3d half;
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&geometry)) {
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3f& vertex : (*mesh)->vertices)
      bounds.extend(pose * vertex.cast<double>());
    return bounds;
  }
  if (const auto* box = std::get_if<Box>(&geometry)) {
    half = pose.linear().cwiseAbs() * (0.5 * box->size);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    const Eigen::Vector3d axis = pose.linear().col(2);
    for (int i = 0; i < 3; ++i)
      half[i] = std::abs(axis[i]) * 0.5 * cylinder->length +
                cylinder->radius * std::sqrt(std::max(0.0, 1.0 - axis[i] * axis[i]));
  } else {
    half.setConstant(std::get<Sphere>(geometry).radius);
  }
  return {pose.translation() - half, pose.translation() + half};
}

Eigen::AlignedBox3d bounds_of(const std::vector<Thing>& things) {
  Eigen::AlignedBox3d bounds;
  for (const Thing& thing : things)
    for (const Shape& shape : thing.shapes)
      bounds.extend(bounds_of(shape.geometry, thing.pose * shape.pose));
  return bounds;
}

std::vector<Eigen::AlignedBox3d> standing_in(const WorldDescription& world) {
  std::vector<Eigen::AlignedBox3d> standing;
  for (const Thing& thing : world.things)
    if (const auto bounds = bounds_of({thing}); bounds.max().z() > world.floor_height + kRises)
      standing.push_back(bounds);
  return standing;
}

}  // namespace navvi_sim
