#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/mesh.hpp"
#include "search/search_node.hpp"

namespace navvi_nav::search {

/// The shortest path on a mesh, exact: Polyanya (Cui, Harabor, Grastien, "Compromise-free
/// Pathfinding on a Navigation Mesh", IJCAI 2017), with another rule for paths of equal length.
/// Keeps its memory from query to query.
class Polyanya {
 public:
  /// For another path than the shortest: one that turns less often or keeps out of slits.
  struct Price {
    double turn = 0.0;    ///< m, of each turn
    double narrow = 0.0;  ///< m, a portal at a corner that is shorter is not crossed
    double most = std::numeric_limits<double>::infinity();  ///< m, a path that costs more is none
    std::size_t nodes = ~std::size_t{0};  ///< most that are expanded before the search is given up
  };
  /// \param price  with that of a turn, the path is nearly the cheapest, not always quite
  /// \param path  gets the path, without points where it does not turn; empty if there is none
  /// \returns true if there is a path
  bool find(const mesh::Mesh& mesh, const mesh::Mesh::Place& start, const mesh::Mesh::Place& goal,
            const Price& price, Path& path);
  [[nodiscard]] std::size_t nodes_expanded() const { return nodes_expanded_; }

 private:
  /// The shortest path known to a vertex.
  struct Reached {
    double cost = 0.0;
    int parent = -1;  ///< the root before it
    std::uint32_t query = 0;
  };
  /// An end of a portal, and its side of the right and of the left border of a node.
  struct End {
    int vertex;
    Point ahead;  ///< from the node's root
    int right;
    int left;
  };

  void begin(const mesh::Mesh& mesh, const mesh::Mesh::Place& start, const mesh::Mesh::Place& goal);
  void expand_start();
  void expand(const SearchNode& node);
  void enter(const SearchNode& node, const mesh::Portal& portal, const End& c, const End& d);
  void see_goal(const SearchNode& node);
  void enter_collinear(const mesh::Portal& portal, int root, double cost);
  void turn(const SearchNode& node, const mesh::Portal& portal, bool to_right, bool whole);
  [[nodiscard]] int origin_of(int root, Point ahead) const;
  [[nodiscard]] bool has_wall(int vertex, int polygon, Point ahead, bool on_right) const;
  bool reach(int vertex, int parent, double cost);
  void add(const SearchNode& node, const Point& portal_right, const Point& portal_left);
  [[nodiscard]] bool is_dominated(const SearchNode& node);
  void push(const SearchNode& node, double estimate);
  bool pop(SearchNode& node);  ///< false if none is left
  [[nodiscard]] bool is_corner(int vertex) const {
    return mesh_->vertices[static_cast<std::size_t>(vertex)].corner;
  }
  [[nodiscard]] Point at(int vertex) const { return vertex == start_ ? from_ : mesh_->at(vertex); }
  void trace(int root, Path& path) const;

  Price price_;
  const mesh::Mesh* mesh_ = nullptr;
  Point from_;
  Point to_;
  int start_ = 0;  ///< number of the start as a root: one beyond the last vertex
  std::uint32_t query_ = 0;
  std::vector<Reached> reached_;
  DominanceTable dominance_;
  std::vector<SearchNode> nodes_;
  std::vector<std::uint32_t> unused_;
  OpenList<std::uint64_t, std::uint32_t> open_;  ///< indices into nodes_
  std::vector<int> start_polygons_;
  std::vector<int> goal_polygons_;
  std::size_t nodes_expanded_ = 0;
};

}  // namespace navvi_nav::search
