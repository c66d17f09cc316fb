#include "picture/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace navvi_sim::picture {
namespace {

constexpr int kRimPoints = 24;

class Tracer {
 public:
  Tracer(const Eigen::Isometry3d& thing, const Shape& shape) : pose_(thing * shape.pose) {}

  Outline operator()(const Box& box) const {
    const Eigen::Vector3d half = box.size / 2.0;
    // Upright boxes, which nearly all are, show their top; others a hull would be needed for, and
    // their bounds do.
    const bool upright = std::abs(pose_.linear()(2, 2)) > 0.999;
    Outline outline;
    outline.is_box = upright;
    if (upright) {
      outline.rings.emplace_back();
      for (const auto& [x, y] :
           std::array<std::pair<int, int>, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}})
        outline.rings.back().push_back(
            (pose_ * Eigen::Vector3d(x * half.x(), y * half.y(), 0.0)).head<2>());
    } else {
      const Eigen::Vector3d reach = pose_.linear().cwiseAbs() * half;
      outline.rings.push_back(rectangle(pose_.translation().head<2>(), reach.head<2>()));
    }
    return reaching((pose_.linear().cwiseAbs() * half).z(), std::move(outline));
  }
  Outline operator()(const Cylinder& cylinder) const {
    const Eigen::Vector3d axis = pose_.linear().col(2).cwiseAbs();
    const double z = axis.z() * cylinder.length / 2.0 +
                     cylinder.radius * std::sqrt(std::max(0.0, 1.0 - axis.z() * axis.z()));
    Outline outline;
    if (axis.z() > 0.999) {
      outline.rings.push_back(circle(cylinder.radius));
    } else {
      const Eigen::Vector2d reach =
          axis.head<2>() * cylinder.length / 2.0 + Eigen::Vector2d::Constant(cylinder.radius);
      outline.rings.push_back(rectangle(pose_.translation().head<2>(), reach));
    }
    return reaching(z, std::move(outline));
  }
  Outline operator()(const Sphere& sphere) const {
    Outline outline;
    outline.rings.push_back(circle(sphere.radius));
    return reaching(sphere.radius, std::move(outline));
  }
  Outline operator()(const std::shared_ptr<const Mesh>& mesh) const {
    Outline outline;
    outline.bottom = std::numeric_limits<double>::infinity();
    outline.top = -outline.bottom;
    for (const auto& triangle : mesh->triangles) {
      std::vector<Eigen::Vector2d> ring;
      for (const std::uint32_t index : triangle) {
        const Eigen::Vector3d corner = pose_ * mesh->vertices[index].cast<double>();
        outline.bottom = std::min(outline.bottom, corner.z());
        outline.top = std::max(outline.top, corner.z());
        ring.emplace_back(corner.head<2>());
      }
      const Eigen::Vector2d a = ring[1] - ring[0];
      const Eigen::Vector2d b = ring[2] - ring[0];
      const double area = a.x() * b.y() - a.y() * b.x();
      if (std::abs(area) < 1e-4) continue;
      if (area < 0.0) std::swap(ring[1], ring[2]);  // so that neighbours fill one surface
      outline.rings.push_back(std::move(ring));
    }
    return outline;
  }

 private:
  static std::vector<Eigen::Vector2d> rectangle(const Eigen::Vector2d& centre,
                                                const Eigen::Vector2d& half) {
    return {centre - half, centre + Eigen::Vector2d(half.x(), -half.y()), centre + half,
            centre + Eigen::Vector2d(-half.x(), half.y())};
  }
  [[nodiscard]] std::vector<Eigen::Vector2d> circle(double radius) const {
    std::vector<Eigen::Vector2d> ring;
    for (int i = 0; i < kRimPoints; ++i) {
      const double angle = 2.0 * M_PI * i / kRimPoints;
      ring.emplace_back(pose_.translation().head<2>() +
                        radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    return ring;
  }
  [[nodiscard]] Outline reaching(double z, Outline outline) const {
    outline.bottom = pose_.translation().z() - z;
    outline.top = pose_.translation().z() + z;
    return outline;
  }

  Eigen::Isometry3d pose_;
};

}  // namespace

std::vector<Outline> outlines_of(const Thing& thing) {
  std::vector<Outline> all;
  const Eigen::Isometry3d to_thing = thing.pose.inverse();
  for (const Shape& shape : thing.shapes) {
    Outline outline = std::visit(Tracer(thing.pose, shape), shape.geometry);
    outline.look = look_of(thing, shape);
    for (const auto& ring : outline.rings)
      for (const Eigen::Vector2d& p : ring)
        outline.local.extend((to_thing * Eigen::Vector3d(p.x(), p.y(), 0.0)).head<2>());
    all.push_back(std::move(outline));
  }
  std::vector<Outline> seen;
  for (const Outline& low : all)
    if (std::none_of(all.begin(), all.end(), [&](const Outline& high) {
          return high.is_box && high.bottom >= low.top - 1e-6 && high.local.contains(low.local);
        }))
      seen.push_back(low);
  return seen;
}

}  // namespace navvi_sim::picture
