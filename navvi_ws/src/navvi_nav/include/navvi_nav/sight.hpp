#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "navvi_nav/mesh.hpp"

namespace navvi_nav {

/// 1 where `b` lies left of the ray `a`, -1 right of it, 0 on its line. \param a_extent, b_extent
/// sums of the absolute coordinates
[[nodiscard]] inline int side_of(Point a, double a_extent, Point b, double b_extent) {
  constexpr double kOnLine = 1e-12;  // m, how far a point may lie from a line that runs through it
  const double value = cross(a, b);
  const double slack = kOnLine * (a_extent + b_extent);
  return (value > slack ? 1 : 0) - (value < -slack ? 1 : 0);
}

/// The polygons that hold a place: more than one if it lies on a link or a vertex.
void surround(const Mesh& mesh, const Mesh::Place& place, std::vector<int>& polygons);

/// What can be seen of a mesh from one point: the corners round which a shortest path from there
/// may turn next. Keeps its memory.
class Sight {
 public:
  struct Corner {
    Point ahead;        ///< from the point to the corner
    double away = 0.0;  ///< m
    int vertex = 0;
    int polygon = 0;  ///< one that the vertex is a corner of
    /// To which side a path may turn there: 1 left, -1 right, 0 not told.
    std::int8_t turn = 0;
    /// To which side a path may have turned in the corner from which is looked.
    std::int8_t turned = 0;
  };

  static constexpr int kAll = -1;
  /// What is seen of a polygon from a corner: what lies between two vertices, or kAll of it.
  struct Glimpse {
    int polygon = 0;
    int right = kAll;
    int left = kAll;
  };
  /// The two walls that end at a corner.
  struct Walls {
    bool known = false;  ///< false: there are others than two
    Point in;
    Point out;
    /// On which side of a way `ahead` each lies: 1 left, -1 right, 0 in line with it.
    [[nodiscard]] std::pair<int, int> sides(Point ahead) const;
    /// To which side a path may have turned here that goes on `ahead`, as Corner::turned; none if
    /// it can not be a shortest one.
    [[nodiscard]] std::optional<int> turn(Point ahead) const;
  };

  /// From a place. Then `target`, if it can be seen, is told of by target_seen().
  const std::vector<Corner>& look(const Mesh& mesh, const Mesh::Place& place,
                                  const Mesh::Place* target = nullptr);
  /// From a corner; only where a shortest path may go on that has turned there.
  const std::vector<Corner>& look(const Mesh& mesh, int vertex, int polygon);
  [[nodiscard]] bool target_seen() const { return target_seen_; }
  /// The polygons that hold what was looked from last.
  [[nodiscard]] const std::vector<int>& around() const { return around_; }
  /// From a corner. \param glimpses  all that it sees is added here \returns the corner's
  Walls survey(const Mesh& mesh, int vertex, int polygon, std::vector<Glimpse>& glimpses);
  /// True if some of the polygon may have been seen in the last look.
  [[nodiscard]] bool swept(int polygon) const {
    return swept_[static_cast<std::size_t>(polygon)] == number_;
  }
  /// True if a place can be seen from another: what lies along the straight line is looked at only.
  [[nodiscard]] bool sees(const Mesh& mesh, const Mesh::Place& place, const Mesh::Place& target);

 private:
  /// What is seen through a link.
  struct Cone {
    Point right;
    Point left;
    int polygon;
    int link_right;
    int link_left;
    bool right_end;  ///< the border runs through the link's end
    bool left_end;
    bool right_met;  ///< the border runs through a corner that was met: what lies behind it in line
    bool left_met;   ///< is found from there
    int right_at;    ///< vertices through which the borders run
    int left_at;
  };
  void start_number(const Mesh& mesh);
  void sweep();
  void pass(Cone cone);
  void look_along(const Link& link, Point c, Point d);
  bool meet(int vertex, int polygon, Point ahead, std::int8_t turn);

  const Mesh* mesh_ = nullptr;
  Point from_;
  Point target_;
  bool target_seen_ = false;
  bool skips_ = false;
  Walls walls_;  ///< of the corner from which is looked
  std::vector<Glimpse>* glimpses_ = nullptr;
  std::uint32_t number_ = 0;
  std::vector<std::uint32_t> met_;    // numbers of looks, by vertex
  std::vector<std::uint32_t> swept_;  // likewise, by polygon
  std::vector<int> around_;
  std::vector<int> around_target_;
  std::vector<Cone> cones_;
  std::vector<int> waiting_;  // polygons
  std::vector<Corner> corners_;
};

}  // namespace navvi_nav
