#pragma once

#include <limits>
#include <navvi_config/field.hpp>
#include <navvi_floor/floor.hpp>
#include <optional>
#include <vector>

#include "mesh/mesh.hpp"

namespace navvi_nav::smooth {

/// What a guide path costs a person, in metres of free way: the one measure by which paths are
/// chosen, moved and kept.
struct GuideCostConfig {
  /// m, length a path may gain to save a turn by 90 degrees; half of it for a slight turn, 1.5 for
  /// one back
  static constexpr double kTurnPrice = 2.0;
  double preferred_clearance = 0.6;  ///< m, beyond the robot's radius
  /// how much dearer a metre without any preferred clearance is
  static constexpr double kClearanceWeight = 3.0;
  /// m, clearance beyond the robot's radius below which the price rises steeply
  static constexpr double kTight = 0.2;
  /// how much dearer a metre without any clearance is besides
  static constexpr double kTightWeight = 20.0;

  void describe(navvi_config::Visitor& visit);
};

/// The polygon that `b` lies in, if the whole segment lies on the mesh, to 1e-6 m.
/// \param polygon  that `a` lies in
[[nodiscard]] std::optional<int> covers(const mesh::Mesh& mesh, int polygon, Point a, Point b);

inline constexpr double kNever = std::numeric_limits<double>::infinity();  // m, dearer than all

/// The cost of paths on one mesh, which must not change meanwhile. Work is bounded by metres, not
/// by a clock: equal input gives equal output.
class GuideCost {
 public:
  /// \param space  what clearance is measured in \param radius  of the robot, m
  GuideCost(const GuideCostConfig& config, const mesh::Mesh& mesh, const map::Space& space,
            double radius);

  /// m: the length, each metre dearer the less clearance it keeps; infinite for a leg that leaves
  /// the mesh, or costs more than `most` (m).
  [[nodiscard]] double leg(Point a, Point b, double most = kNever) const;
  /// m: growing with the angle, slower beyond a bend: two turns are dearer than one.
  [[nodiscard]] double turn(Point before, Point at, Point after) const;
  /// m: of a leg between two corners that is too short to announce the second in time.
  [[nodiscard]] double haste(Point a, Point b) const;
  /// m: all of these.
  [[nodiscard]] double of(const Path& path) const;
  /// True if the path costs less than so many metres, as far as may be measured.
  [[nodiscard]] bool less(const Path& path, double than) const;
  /// m: what of this is for less clearance than kTight.
  [[nodiscard]] double tight(const Path& path) const;
  /// The corners from which the path, its first leg left out, leads over the mesh to its end.
  [[nodiscard]] Path known_end(const Path& path) const;
  /// Shares of the leg at which less than the preferred clearance begins, is least, and ends; none
  /// if there is more all along.
  [[nodiscard]] std::vector<double> near_places(Point a, Point b) const;
  /// So much may be measured from now on, or less() is false. \param metres  of legs
  void allow(double metres) const { left_ = metres; }
  [[nodiscard]] double left() const { return left_; }
  [[nodiscard]] bool spent() const { return left_ <= 0.0; }

  [[nodiscard]] const GuideCostConfig& config() const { return config_; }
  [[nodiscard]] double preferred() const { return config_.preferred_clearance; }
  /// m, between the point and what is nearest; at least, and to half a cell.
  [[nodiscard]] double gap(Point at) const;

 private:
  struct Leg {
    Point a, b;
    double cost = 0.0;
  };
  struct Placed {
    Point point;
    std::optional<int> polygon;  ///< none: off the mesh
  };
  [[nodiscard]] Placed& placed(Point point) const;
  [[nodiscard]] std::optional<int> polygon_at(Point point) const;
  /// m: of turns and haste.
  [[nodiscard]] double at_corners(const Path& path) const;
  /// Calls visit(spare) with the clearance beyond the radius of places along the leg, until it
  /// returns false.
  template <typename Visit>
  void along(Point a, Point b, const Visit& visit) const;
  [[nodiscard]] double measure(Point a, Point b, double most) const;
  /// Of a metre with so much clearance beyond the radius.
  [[nodiscard]] double tight_price(double spare) const {
    return config_.kTightWeight * std::max(0.0, 1.0 - spare / config_.kTight);
  }

  GuideCostConfig config_;
  const mesh::Mesh& mesh_;
  map::Space space_;
  double radius_;
  int wide_;                         // cells squared, from which on nothing fixed is near
  std::vector<Cylinder> cylinders_;  // by x
  double widest_ = 0.0;              // m, radius of a cylinder
  mutable double left_ = 0.0;        // m
  // Hash tables in which a later entry replaces an earlier one.
  mutable std::vector<Leg> legs_;
  mutable std::vector<Placed> placed_;
  mutable std::vector<Cylinder> near_;
};

}  // namespace navvi_nav::smooth
