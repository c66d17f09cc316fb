#include "screen/place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_rviz::screen {
namespace {

constexpr double kGap = 8.0;  // px, between plates, and from a plate to its place
constexpr double kPatience = 1.5;

Rect rect_at(const Eigen::Vector2d& corner, const Eigen::Vector2d& size) {
  return {corner, corner + size};
}

Eigen::Vector2d into(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                     const Eigen::Vector2d& picture) {
  return corner.cwiseMin(picture - size).cwiseMax(Eigen::Vector2d::Zero());
}

bool is_free(const Rect& mine, const std::vector<Rect>& used) {
  return std::none_of(used.begin(), used.end(), [&](const Rect& other) {
    return mine.intersects(Rect(other.min().array() - kGap, other.max().array() + kGap));
  });
}

Eigen::Vector2d over(const Plate& plate) {
  return plate.anchor - Eigen::Vector2d(0.5 * plate.size.x(), plate.size.y() + kGap);
}

/// The corner nearest to the one over the plate's place where it covers nothing of `used`.
std::optional<Eigen::Vector2d> nearest(const Plate& plate, const Eigen::Vector2d& picture,
                                       const std::vector<Rect>& used) {
  const Eigen::Vector2d wish = over(plate);
  std::optional<Eigen::Vector2d> found;
  double best = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Eigen::Vector2d& way) {
    if (way.norm() >= best) return;
    const Eigen::Vector2d trial = into(wish + way, plate.size, picture);
    if (!is_free(rect_at(trial, plate.size), used)) return;
    best = way.norm();
    found = trial;
  };
  consider(Eigen::Vector2d::Zero());
  const Eigen::Vector2d step = 0.25 * plate.size + Eigen::Vector2d(kGap, kGap);
  const Eigen::Vector2i most = (picture.cwiseQuotient(step).array() + 1.0).cast<int>();
  for (int across = -most.x(); across <= most.x() && best > 0.0; ++across)
    for (int down = -most.y(); down <= most.y(); ++down)
      consider(step.cwiseProduct(Eigen::Vector2d(across, down)));
  if (!plate.before || !found || best == 0.0) return found;
  const Eigen::Vector2d stay = into(plate.anchor + *plate.before, plate.size, picture);
  const bool near = (stay - wish).norm() <= kPatience * best;
  return near && is_free(rect_at(stay, plate.size), used) ? stay : found;
}

}  // namespace

std::optional<Eigen::Vector2d> place(const Plate& plate, const Eigen::Vector2d& picture,
                                     const Taken& taken) {
  std::vector<Rect> all = taken.always;
  all.insert(all.end(), taken.rather.begin(), taken.rather.end());
  const std::optional<Eigen::Vector2d> corner = nearest(plate, picture, all);
  return corner ? corner : nearest(plate, picture, taken.always);
}

std::optional<EdgeArrow> edge_arrow(const Eigen::Vector3d& seen,
                                    const std::optional<Eigen::Vector2d>& inside,
                                    const Eigen::Vector2d& picture, double margin) {
  if (inside && (inside->array() > 0.0).all() && (inside->array() < picture.array()).all())
    return std::nullopt;
  // What lies straight behind is behind the lower edge.
  Eigen::Vector2d way(seen.x(), seen.y());
  if (seen.z() > 0.0) way.y() = -std::abs(way.y()) - 0.2 * seen.z();
  if (way.norm() < 1e-6) way = {0.0, -1.0};
  const Eigen::Vector2d half = 0.5 * picture - Eigen::Vector2d::Constant(margin);
  const double reach = std::min(half.x() / std::max(1e-9, std::abs(way.x())),
                                half.y() / std::max(1e-9, std::abs(way.y())));
  const Eigen::Vector2d at = 0.5 * picture + reach * Eigen::Vector2d(way.x(), -way.y());
  return EdgeArrow{at, std::atan2(way.y(), way.x())};
}

std::optional<Eigen::Vector3d> way_ahead(const std::vector<Eigen::Vector3d>& path,
                                         const Eigen::Vector2d& robot, double ahead) {
  if (path.empty()) return std::nullopt;
  // On each leg the place that is nearest; its share of the leg.
  std::size_t leg = 0;
  double share = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Eigen::Vector2d from = path[i].head<2>(), way = path[i + 1].head<2>() - from;
    const double part =
        std::clamp((robot - from).dot(way) / std::max(1e-9, way.squaredNorm()), 0.0, 1.0);
    const double away = (from + part * way - robot).norm();
    if (away >= nearest) continue;
    nearest = away;
    leg = i;
    share = part;
  }
  for (; leg + 1 < path.size(); ++leg, share = 0.0) {
    const Eigen::Vector3d way = path[leg + 1] - path[leg];
    const double left = (1.0 - share) * way.norm();
    if (left > ahead) return path[leg] + (share + ahead / way.norm()) * way;
    ahead -= left;
  }
  return path.back();
}

}  // namespace navvi_rviz::screen
