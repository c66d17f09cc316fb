#include "screen/place.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_rviz::screen {
namespace {

constexpr double kGap = 8.0;  // px, between plates, and from a plate to its place

Rect rect_at(const Eigen::Vector2d& corner, const Eigen::Vector2d& size) {
  return {corner, corner + size};
}

Eigen::Vector2d into(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                     const Eigen::Vector2d& picture) {
  return corner.cwiseMin(picture - size).cwiseMax(Eigen::Vector2d::Zero());
}

}  // namespace

std::vector<Eigen::Vector2d> place(const std::vector<Plate>& plates, const Eigen::Vector2d& picture,
                                   const std::vector<Rect>& taken) {
  std::vector<Rect> used = taken;
  std::vector<Eigen::Vector2d> corners;
  for (const Plate& plate : plates) {
    const Eigen::Vector2d wish =
        plate.anchor - Eigen::Vector2d(0.5 * plate.size.x(), plate.size.y() + kGap);
    Eigen::Vector2d corner = into(wish, plate.size, picture);
    // Up and down from the wish in steps, until it is free.
    const double step = 0.5 * plate.size.y() + kGap;
    for (int i = 0; i <= 80; ++i) {
      const double down = (i % 2 == 0 ? -1.0 : 1.0) * step * ((i + 1) / 2);
      const Eigen::Vector2d trial = into(wish + Eigen::Vector2d(0.0, down), plate.size, picture);
      const Rect mine = rect_at(trial, plate.size);
      if (std::none_of(used.begin(), used.end(), [&](const Rect& other) {
            return mine.intersects(Rect(other.min().array() - kGap, other.max().array() + kGap));
          })) {
        corner = trial;
        break;
      }
    }
    corners.push_back(corner);
    used.push_back(rect_at(corner, plate.size));
  }
  return corners;
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

}  // namespace navvi_rviz::screen
