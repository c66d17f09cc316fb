#pragma once

#include <cstdint>
#include <vector>

#include "navvi_nav/cone.hpp"
#include "navvi_nav/mesh.hpp"
#include "navvi_nav/open_list.hpp"
#include "navvi_nav/views.hpp"

namespace navvi_nav {

/// The shortest path on a mesh, exact: Polyanya (Cui, Harabor, Grastien, "Compromise-free
/// Pathfinding on a Navigation Mesh", IJCAI 2017), with another rule for routes of equal length.
/// Keeps its memory from query to query.
class AnyAngle {
 public:
  /// \param path  gets the path, without points where it goes straight on; empty if there is none
  /// \returns true if there is a path
  bool find(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal, Path& path);
  [[nodiscard]] std::size_t nodes_expanded() const { return nodes_expanded_; }

 private:
  /// The shortest way known to a vertex.
  struct Reached {
    double cost = 0.0;
    int parent = -1;  ///< the root from which it was seen
    std::uint32_t query = 0;
  };

  void begin(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal);
  void leave_start();
  void expand(const Cone& node);
  void see_goal(const Cone& node);
  void slip_into(const Portal& portal, int root, double cost);
  void turn(const Cone& node, const Portal& portal, bool to_right, bool whole);
  [[nodiscard]] int origin_of(int root, Point ahead) const;
  [[nodiscard]] bool touches(int vertex, int polygon, Point ahead, bool on_right) const;
  bool reach(int vertex, int parent, double cost);
  void add(const Cone& node, const Point& portal_right, const Point& portal_left);
  [[nodiscard]] bool outdone(const Cone& node);
  void push(const Cone& node, double estimate);
  bool pop(Cone& node);
  [[nodiscard]] bool is_corner(int vertex) const {
    return mesh_->vertices[static_cast<std::size_t>(vertex)].corner;
  }
  [[nodiscard]] Point at(int vertex) const { return vertex == start_ ? from_ : mesh_->at(vertex); }
  void trace(int root, Path& path) const;

  const Mesh* mesh_ = nullptr;
  Point from_;
  Point to_;
  int start_ = 0;  ///< the root that is no vertex
  std::uint32_t query_ = 0;
  std::vector<Reached> reached_;
  Views views_;
  std::vector<Cone> nodes_;
  std::vector<std::uint32_t> unused_;
  OpenList<std::uint64_t, std::uint32_t> open_;  ///< indices into nodes_
  std::vector<int> start_polygons_;
  std::vector<int> goal_polygons_;
  std::size_t nodes_expanded_ = 0;
};

}  // namespace navvi_nav
