#include "physics/proximity.hpp"

#include <algorithm>
#include <optional>

namespace navvi_sim::physics {
namespace {

/// Finds the point of a body that is nearest to the hull.
class NearestPoint {
 public:
  NearestPoint(const Hull& hull, double radius) : hull_(hull), radius_(radius) {}

  /// \param pose  of the part, in map
  void consider(const Part& part, const Eigen::Isometry3d& pose) {
    if (!hull_.meets(part.bounds.min().z(), part.bounds.max().z())) return;
    if (const auto* box = std::get_if<Box>(&part.geometry))
      take(gap_to(hull_, *box, pose));
    else if (const auto* cylinder = std::get_if<Cylinder>(&part.geometry))
      take(gap_to(hull_, *cylinder, pose));
    else if (const auto* sphere = std::get_if<Sphere>(&part.geometry))
      take(gap_to(hull_, *sphere, pose));
    else
      consider_mesh(*std::get<std::shared_ptr<const Mesh>>(part.geometry), *part.triangles, pose);
  }

  /// The best gap so far, or the search radius.
  [[nodiscard]] double gap() const { return found_ ? found_->gap : radius_; }
  [[nodiscard]] const std::optional<Gap>& found() const { return found_; }

 private:
  void take(const Gap& gap) {
    if (!(gap.gap > this->gap())) found_ = gap;
  }

  void consider_mesh(const Mesh& mesh, const AabbTree& triangles, const Eigen::Isometry3d& pose) {
    const Eigen::Isometry3d to_local = pose.inverse();
    const bool upright = pose.linear()(2, 2) > 1.0 - 1e-12;
    const Eigen::Vector3d middle =
        to_local * Eigen::Vector3d(hull_.centre.x(), hull_.centre.y(), hull_.bottom);
    const double height = hull_.top - hull_.bottom;
    const Hull local{middle.head<2>(), hull_.radius, middle.z(), middle.z() + height};
    // A ball around the hull serves where the mesh is tilted.
    const Eigen::Vector3d centre = to_local * Eigen::Vector3d(hull_.centre.x(), hull_.centre.y(),
                                                              0.5 * (hull_.bottom + hull_.top));
    const double around = Eigen::Vector2d(hull_.radius, 0.5 * height).norm();
    triangles.search(
        [&](const Eigen::AlignedBox3d& box) {
          return upright ? local.bound(box) : std::max(0.0, box.exteriorDistance(centre) - around);
        },
        [&] { return std::max(0.0, gap()); },
        [&](std::uint32_t index) {
          std::array<Eigen::Vector3d, 3> corners;
          Eigen::AlignedBox3d bounds;
          for (std::size_t i = 0; i < 3; ++i) {
            corners[i] = pose * mesh.vertices[mesh.triangles[index][i]].cast<double>();
            bounds.extend(corners[i]);
          }
          if (hull_.bound(bounds) <= std::max(0.0, gap())) take(gap_to(hull_, corners));
        });
  }

  const Hull& hull_;
  double radius_;
  std::optional<Gap> found_;
};

}  // namespace

std::vector<ThingGap> things_near(const Hull& hull, double radius, const Bodies& bodies,
                                  const std::vector<MoverState>& movers) {
  std::vector<ThingGap> near;
  const auto add = [&](const Body& body, const NearestPoint& nearest) {
    if (const auto found = nearest.found()) near.push_back({*found, body.thing});
  };
  bodies.tree().search([&](const Eigen::AlignedBox3d& box) { return hull.bound(box); },
                       [&] { return radius; },
                       [&](std::uint32_t index) {
                         const Body& body = bodies.all()[bodies.standing()[index]];
                         if (hull.bound(body.bounds) > radius) return;
                         NearestPoint nearest(hull, radius);
                         for (const Part& part : body.parts)
                           if (hull.bound(part.bounds) <= std::max(0.0, nearest.gap()))
                             nearest.consider(part, part.pose);
                         add(body, nearest);
                       });
  for (const MoverState& mover : movers) {
    const double reach = radius + hull.radius + mover.thing.radius;
    const Eigen::Vector2d away = mover.pose.translation().head<2>() - hull.centre;
    if (away.squaredNorm() > reach * reach) continue;
    const Body* body = bodies.of(mover.thing.id);
    if (!body) continue;
    NearestPoint nearest(hull, radius);
    for (const Part& part : body->parts) nearest.consider(part, mover.pose * part.pose);
    add(*body, nearest);
  }
  std::sort(near.begin(), near.end(), [](const ThingGap& a, const ThingGap& b) {
    return a.gap != b.gap ? a.gap < b.gap : a.thing < b.thing;
  });
  return near;
}

}  // namespace navvi_sim::physics
