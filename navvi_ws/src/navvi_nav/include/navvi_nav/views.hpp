#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "navvi_nav/cone.hpp"

namespace navvi_nav {

/// Of each portal a root that sees the whole of it, as far as they have been kept: another one that
/// sees a part may have nothing to add.
class Views {
 public:
  struct View {
    std::uint32_t query = 0;
    int polygon = 0;
    int portal_right = 0;
    int portal_left = 0;
    int root = 0;
    double cost = 0.0;  ///< m, from the start
    Point from;

    /// True if the way over this root is at least as short to all of a part of the portal as the
    /// way over another. Where both ends are not farther for a root that is dearer to reach, no
    /// point between is: it is a branch of a hyperbola, convex, within which that root is better.
    /// For a cheaper root the difference has its only minimum where its line through the other root
    /// meets the portal. \param slack  m, of rounding
    [[nodiscard]] bool as_near(const Cone::Part& part, Point other, double other_cost,
                               double slack) const {
      if (cost + distance(from, part.right) > other_cost + distance(other, part.right) + slack ||
          cost + distance(from, part.left) > other_cost + distance(other, part.left) + slack)
        return false;
      if (cost >= other_cost) return true;
      const Point to_other = other - from;
      const double a = cross(part.right - from, to_other);
      const double b = cross(part.left - from, to_other);
      return (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0) || cost + norm(to_other) <= other_cost;
    }
  };

  /// Forgets all. \param polygons  of the mesh
  void begin(std::size_t polygons) {
    while ((views_.size() >> 1U) < polygons) {
      views_.assign(std::max(views_.size() * 2, std::size_t{256}), View{});
      shift_ = 32;
      for (std::size_t size = views_.size(); size > 1; size >>= 1U) --shift_;
    }
    if (++query_ == 0) {
      std::fill(views_.begin(), views_.end(), View{});
      query_ = 1;
    }
  }
  /// \param cone  that fills its portal
  void keep(const Cone& cone, Point root) {
    view_of(cone) = {query_,    cone.polygon, cone.portal_right, cone.portal_left, cone.root,
                     cone.cost, root};
  }
  /// Another root that sees the whole of the cone's portal; null: none is known.
  [[nodiscard]] const View* rival(const Cone& cone) {
    const View& view = view_of(cone);
    const bool same = view.query == query_ && view.polygon == cone.polygon &&
                      view.portal_right == cone.portal_right &&
                      view.portal_left == cone.portal_left;
    return same && view.root != cone.root ? &view : nullptr;
  }

 private:
  [[nodiscard]] View& view_of(const Cone& cone) {
    const auto key = static_cast<std::uint32_t>(cone.portal_right) * 0x9E3779B1U +
                     static_cast<std::uint32_t>(cone.polygon) * 0x85EBCA6BU;
    return views_[key >> shift_];
  }

  std::uint32_t query_ = 0;
  unsigned shift_ = 0;
  std::vector<View> views_;
};

}  // namespace navvi_nav
