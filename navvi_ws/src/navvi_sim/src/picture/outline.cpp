#include "picture/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "description/footprint.hpp"

namespace navvi_sim::picture {
namespace {

constexpr int kRimPoints = 24;
constexpr double kCut = 1.2;          // m above the floor, the headroom of scenarios
constexpr double kDrivenOver = 0.05;  // m above the floor

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
  Outline operator()(const std::shared_ptr<const Mesh>&) const { return {}; }  // see mesh_outlines

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

/// The part of a triangle below the cut.
std::vector<Eigen::Vector3d> below(const std::array<Eigen::Vector3d, 3>& triangle, double cut) {
  std::vector<Eigen::Vector3d> part;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& from = triangle[i];
    const Eigen::Vector3d& to = triangle[(i + 1) % 3];
    if (from.z() <= cut) part.push_back(from);
    if ((from.z() <= cut) != (to.z() <= cut))
      part.push_back(from + (cut - from.z()) / (to.z() - from.z()) * (to - from));
  }
  return part;
}

/// Adds what is seen of a polygon in space.
void add_ring(Outline& outline, const std::vector<Eigen::Vector3d>& corners, double cut) {
  std::vector<Eigen::Vector2d> ring, section;
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& at = corners[i];
    const Eigen::Vector3d& next = corners[(i + 1) % corners.size()];
    outline.bottom = std::min(outline.bottom, at.z());
    outline.top = std::max(outline.top, at.z());
    ring.emplace_back(at.head<2>());
    if (at.z() >= cut - 1e-9) section.emplace_back(at.head<2>());
    area += at.x() * next.y() - at.y() * next.x();
  }
  if (std::abs(area) < 1e-4) {
    outline.lines.push_back(std::move(ring));
    return;
  }
  if (section.size() == 2) outline.lines.push_back(std::move(section));
  if (area < 0.0) std::reverse(ring.begin(), ring.end());  // so that neighbours fill one surface
  outline.rings.push_back(std::move(ring));
}

/// What of a mesh the robot drives over, what stands in its way, and what hangs.
std::vector<Outline> mesh_outlines(const Mesh& mesh, const Eigen::Isometry3d& pose, double floor) {
  Outline low, body, high;
  for (Outline* part : {&low, &body, &high}) {
    part->bottom = std::numeric_limits<double>::infinity();
    part->top = -part->bottom;
  }
  low.look = ThingClass::floor;
  high.hangs = true;
  std::vector<Eigen::Vector2d> hanging;
  for (const auto& indices : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::AlignedBox1d heights;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = pose * mesh.vertices[indices[i]].cast<double>();
      heights.extend(corners[i].tail<1>());
    }
    if (heights.min().x() >= floor + kCut) {
      for (const Eigen::Vector3d& corner : corners) hanging.emplace_back(corner.head<2>());
      high.bottom = std::min(high.bottom, heights.min().x());
      high.top = std::max(high.top, heights.max().x());
    } else {
      add_ring(heights.max().x() < floor + kDrivenOver ? low : body, below(corners, floor + kCut),
               floor + kCut);
    }
  }
  if (!hanging.empty()) high.rings.push_back(convex_hull(std::move(hanging)));
  std::vector<Outline> parts;
  for (Outline* part : {&low, &body, &high})
    if (!part->rings.empty() || !part->lines.empty()) parts.push_back(std::move(*part));
  return parts;
}

double area_of(const Eigen::AlignedBox2d& box) { return box.isEmpty() ? 0.0 : box.volume(); }

}  // namespace

std::vector<Outline> outlines_of(const Thing& thing, double floor) {
  std::vector<Outline> all;
  const Eigen::Isometry3d to_thing = thing.pose.inverse();
  for (const Shape& shape : thing.shapes) {
    std::vector<Outline> parts;
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry)) {
      parts = mesh_outlines(**mesh, thing.pose * shape.pose, floor);
      for (Outline& part : parts)
        if (part.look != ThingClass::floor) part.look = look_of(thing, shape);
    } else {
      parts.push_back(std::visit(Tracer(thing.pose, shape), shape.geometry));
      parts.back().hangs = parts.back().bottom >= floor + kCut;
      parts.back().look =
          parts.back().top < floor + kDrivenOver ? ThingClass::floor : look_of(thing, shape);
    }
    for (Outline& part : parts) {
      for (const auto* set : {&part.rings, &part.lines})
        for (const auto& ring : *set)
          for (const Eigen::Vector2d& p : ring)
            part.local.extend((to_thing * Eigen::Vector3d(p.x(), p.y(), 0.0)).head<2>());
      all.push_back(std::move(part));
    }
  }
  // The upper boards of a rack stand on the lower ones.
  for (Outline& high : all)
    if (high.hangs && std::any_of(all.begin(), all.end(), [&](const Outline& low) {
          return !low.hangs && low.look != ThingClass::floor &&
                 2.0 * area_of(low.local.intersection(high.local)) >= area_of(high.local);
        }))
      high.hangs = false;
  std::vector<Outline> seen;
  for (const Outline& low : all)
    if (std::none_of(all.begin(), all.end(), [&](const Outline& high) {
          return high.is_box && !high.hangs && high.bottom >= low.top - 1e-6 &&
                 high.local.contains(low.local);
        }))
      seen.push_back(low);
  return seen;
}

}  // namespace navvi_sim::picture
