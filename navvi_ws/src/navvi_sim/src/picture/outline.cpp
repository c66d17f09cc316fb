#include "picture/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <navvi_types/headroom.hpp>
#include <utility>

#include "description/footprint.hpp"

namespace navvi_sim::picture {
namespace {

using navvi_types::kHeadroom;

constexpr int kRimPoints = 24;
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
      const double angle = 2.0 * kPi * i / kRimPoints;
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

using Line = std::vector<Eigen::Vector2d>;

/// A mesh's triangles from above, cut at a height.
class CutSurface {
 public:
  CutSurface(Outline& outline, double cut) : outline_(outline), cut_(cut) {
    outline_.bottom = std::numeric_limits<double>::infinity();
    outline_.top = -outline_.bottom;
  }

  void add(const std::array<Eigen::Vector3d, 3>& triangle) {
    Line ring, section;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& from = triangle[i];
      const Eigen::Vector3d& to = triangle[(i + 1) % 3];
      const bool is_below = from.z() <= cut_;
      outline_.bottom = std::min(outline_.bottom, from.z());
      outline_.top = std::max(outline_.top, std::min(from.z(), cut_));
      if (is_below) ring.emplace_back(from.head<2>());
      if (is_below == (to.z() <= cut_)) continue;
      ring.push_back(is_below ? crossing(from, to) : crossing(to, from));
      section.push_back(ring.back());
    }
    if (section.size() == 2 && section[0] != section[1]) sections_.push_back(std::move(section));
    double area = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& next = ring[(i + 1) % ring.size()];
      area += ring[i].x() * next.y() - next.x() * ring[i].y();
    }
    if (std::abs(area) < 1e-4) {
      outline_.lines.push_back(std::move(ring));
    } else {
      if (area < 0.0)
        std::reverse(ring.begin(), ring.end());  // so that neighbours fill one surface
      outline_.rings.push_back(std::move(ring));
    }
  }

  /// Chains the cuts to the outlines of what is solid there; those that do not close stay lines.
  void close() {
    std::multimap<std::pair<double, double>, std::size_t> ends;
    const auto key = [](const Eigen::Vector2d& at) { return std::make_pair(at.x(), at.y()); };
    for (std::size_t i = 0; i < sections_.size(); ++i)
      for (const Eigen::Vector2d& end : sections_[i]) ends.emplace(key(end), i);
    std::vector<bool> used(sections_.size(), false);
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      if (used[i]) continue;
      used[i] = true;
      Line chain = sections_[i];
      for (bool grows = true; grows && chain.back() != chain.front();) {
        grows = false;
        const auto [begin, end] = ends.equal_range(key(chain.back()));
        for (auto next = begin; next != end && !grows; ++next) {
          if (used[next->second]) continue;
          used[next->second] = grows = true;
          const Line& section = sections_[next->second];
          chain.push_back(section[0] == chain.back() ? section[1] : section[0]);
        }
      }
      (chain.back() == chain.front() ? outline_.solid : outline_.lines).push_back(std::move(chain));
    }
  }

 private:
  [[nodiscard]] Eigen::Vector2d crossing(const Eigen::Vector3d& low,
                                         const Eigen::Vector3d& high) const {
    const double share = (cut_ - low.z()) / (high.z() - low.z());
    return (low + share * (high - low)).head<2>();
  }

  Outline& outline_;
  double cut_;
  std::vector<Line> sections_;
};

/// What of a mesh the robot drives over, what stands in its way, and what hangs.
std::vector<Outline> mesh_outlines(const Mesh& mesh, const Eigen::Isometry3d& pose, double floor) {
  Outline low, body, high;
  CutSurface driven_over(low, floor + kHeadroom), standing(body, floor + kHeadroom);
  high.bottom = std::numeric_limits<double>::infinity();
  high.top = -high.bottom;
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
    if (heights.min().x() >= floor + kHeadroom) {
      for (const Eigen::Vector3d& corner : corners) hanging.emplace_back(corner.head<2>());
      high.bottom = std::min(high.bottom, heights.min().x());
      high.top = std::max(high.top, heights.max().x());
    } else {
      (heights.max().x() < floor + kDrivenOver ? driven_over : standing).add(corners);
    }
  }
  standing.close();
  if (!hanging.empty()) high.rings.push_back(convex_hull(std::move(hanging)));
  std::vector<Outline> parts;
  for (Outline* part : {&low, &body, &high})
    if (!part->rings.empty() || !part->lines.empty() || !part->solid.empty())
      parts.push_back(std::move(*part));
  return parts;
}

/// What rises from a floor is a wall.
ThingClass standing_look(const Thing& thing, const Shape& shape) {
  const ThingClass look = look_of(thing, shape);
  return look == ThingClass::floor ? ThingClass::wall : look;
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
        if (part.look != ThingClass::floor) part.look = standing_look(thing, shape);
    } else {
      parts.push_back(std::visit(Tracer(thing.pose, shape), shape.geometry));
      parts.back().hangs = parts.back().bottom >= floor + kHeadroom;
      parts.back().look =
          parts.back().top < floor + kDrivenOver ? ThingClass::floor : standing_look(thing, shape);
    }
    for (Outline& part : parts) {
      for (const auto* set : {&part.rings, &part.solid, &part.lines})
        for (const auto& ring : *set)
          for (const Eigen::Vector2d& p : ring)
            part.local.extend((to_thing * Eigen::Vector3d(p.x(), p.y(), 0.0)).head<2>());
      all.push_back(std::move(part));
    }
  }
  // The upper boards of a rack stand on the lower ones.
  for (Outline& high : all)
    if (high.hangs && std::any_of(all.begin(), all.end(), [&](const Outline& low) {
          return low.is_box && !low.hangs && low.look != ThingClass::floor &&
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
