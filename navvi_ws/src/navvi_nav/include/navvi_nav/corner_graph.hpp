#pragma once

#include <cstdint>
#include <vector>

#include "navvi_nav/landmarks.hpp"

namespace navvi_nav {

/// The shortest path as A* on the visibility graph of a mesh's corners (tangents only). What a
/// corner sees is found when a search first comes there and kept until the mesh changes; once
/// searches have cost as much as landmarks would, landmarks are measured and bound them.
class CornerGraph {
 public:
  /// \param worth  nodes expanded on a mesh, for each of its vertices, after which landmarks pay
  explicit CornerGraph(std::size_t worth = 2) : worth_(worth) {}

  /// \param path  gets the path; empty if there is none \returns true if there is a path
  bool find(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal, Path& path);
  [[nodiscard]] std::size_t nodes_expanded() const { return nodes_expanded_; }

 private:
  struct Edges {
    std::uint64_t version = 0;  ///< of the mesh
    std::vector<Sight::Corner> to;
  };
  /// What one query knows of a corner.
  struct Stop {
    double cost = 0.0;  ///< m, from the start
    double rest = 0.0;  ///< m, at least, to the goal
    double last = 0.0;  ///< m, to the goal if it can be seen from here
    int parent = -1;
    int polygon = 0;
    std::uint32_t query = 0;
    std::int8_t turn = 0;  ///< as Sight::Corner
    bool open = false;
    bool sees_goal = false;
  };
  struct Entry {
    double estimate;
    int vertex;
  };

  void keep_landmarks(const Mesh::Place& start);
  void expand(int vertex, const Stop& here, Point start);
  Stop& stop(int vertex);
  void reach(const Sight::Corner& corner, int parent, double cost);
  void push(double estimate, int vertex);
  Entry pop();
  const std::vector<Sight::Corner>& seen_from(int vertex, int polygon);

  std::size_t worth_;
  const Mesh* mesh_ = nullptr;
  Point goal_;
  std::uint32_t query_ = 0;
  Sight sight_;
  std::vector<Edges> edges_;
  std::vector<Stop> stops_;
  std::vector<Entry> heap_;
  double best_ = 0.0;  ///< m, of the ways to the goal found so far
  int last_ = -1;      ///< their last corner, -1: the start
  std::size_t nodes_expanded_ = 0;
  Landmarks landmarks_;
  std::uint64_t version_ = 0;      ///< of the mesh in the last query
  std::size_t expanded_here_ = 0;  ///< in all queries on that mesh
};

}  // namespace navvi_nav
