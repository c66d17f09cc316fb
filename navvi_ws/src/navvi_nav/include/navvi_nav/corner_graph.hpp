#pragma once

#include <cstdint>
#include <vector>

#include "navvi_nav/landmarks.hpp"
#include "navvi_nav/open_list.hpp"
#include "navvi_nav/tangents.hpp"
#include "navvi_nav/windows.hpp"

namespace navvi_nav {

/// The shortest path as A* on the visibility graph of a mesh's corners (tangents only). What a
/// corner sees is found when a search first comes there and kept until the mesh changes; once
/// searches have cost as much as landmarks and windows would, both are measured: these bound the
/// ways, those tell what is seen from a query's ends.
class CornerGraph {
 public:
  /// \param worth  nodes expanded on a mesh, for each of its vertices, after which landmarks pay
  explicit CornerGraph(std::size_t worth = 2) : worth_(worth) {}

  /// \param path  gets the path; empty if there is none \returns true if there is a path
  bool find(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal, Path& path);
  /// Landmarks of the mesh, aimed at the goal, or null while searches on it have not cost enough to
  /// pay for them. \param cost  nodes that another search has expanded
  const Landmarks* aim(const Mesh& mesh, const Mesh::Place& goal, std::size_t cost);
  /// True if what searches on this mesh have cost paid for what makes the next ones cheap.
  [[nodiscard]] bool knows(const Mesh& mesh) const {
    return windows_.known() && mesh.version == version_;
  }
  [[nodiscard]] std::size_t nodes_expanded() const { return nodes_expanded_; }

 private:
  /// What one query knows of a corner.
  struct Stop {
    Point at;            ///< m
    double cost = 0.0;   ///< m, from the start
    double rest = -1.0;  ///< m, at least, to the goal; < 0: not asked for yet
    double last = 0.0;   ///< m, to the goal if it can be seen from here
    int parent = -1;
    std::uint32_t query = 0;
    std::int8_t turn = 0;  ///< as Sight::Corner
    bool open = false;
    bool sees_goal = false;
  };

  void survey(const Mesh::Place& start);
  const std::vector<Sight::Corner>& look_from_goal(const Mesh::Place& goal,
                                                   const Mesh::Place* start);
  void look_about(const Mesh::Place& start, const Mesh::Place& goal);
  void expand(int vertex, Point start);
  Stop& stop(int vertex);
  void reach(int vertex, int turn, int parent, double cost);

  std::size_t worth_;
  const Mesh* mesh_ = nullptr;
  Point goal_;
  std::uint32_t query_ = 0;
  Sight sight_;
  Tangents tangents_;
  std::vector<Stop> stops_;
  OpenList<double, int> open_;  ///< vertices, by m from the start to the goal
  double best_ = 0.0;           ///< m, of the ways to the goal found so far
  int last_ = -1;               ///< their last corner, -1: the start
  std::size_t nodes_expanded_ = 0;
  Landmarks landmarks_;
  Windows windows_;
  std::uint64_t version_ = 0;      ///< of the mesh in the last query
  std::size_t expanded_here_ = 0;  ///< in all queries on that mesh
};

}  // namespace navvi_nav
