#pragma once

#include <cstdint>
#include <vector>

#include "navvi_nav/sight.hpp"

namespace navvi_nav {

/// Which corners of a mesh a corner sees, where a shortest path may turn in both: found when first
/// asked for and kept until the mesh changes. All in one piece and small: in a large mesh it is
/// this memory that a search waits for.
class Tangents {
 public:
  class Edge {
   public:
    explicit Edge(const Sight::Corner& seen) : code_(4 * seen.vertex + seen.turn + 1) {}
    [[nodiscard]] int vertex() const { return code_ >> 2; }
    [[nodiscard]] int turn() const { return (code_ & 3) - 1; }  ///< as Sight::Corner

   private:
    int code_;
  };
  class Range {
   public:
    Range(const Edge* begin, const Edge* end) : begin_(begin), end_(end) {}
    [[nodiscard]] const Edge* begin() const { return begin_; }
    [[nodiscard]] const Edge* end() const { return end_; }

   private:
    const Edge* begin_;
    const Edge* end_;
  };

  /// \param mesh  of the calls that follow
  void watch(const Mesh& mesh);
  /// Before a vertex is looked from, if it was seen from a place that is no corner.
  void meet(const Sight::Corner& seen);
  /// Where a path may go on that has turned at the vertex to this side: 1 left, -1 right, 0 any.
  /// Valid until the next call.
  [[nodiscard]] Range from(int vertex, int turn) {
    const Corner& corner = corners_[static_cast<std::size_t>(vertex)];
    if (corner.looked != round_) look(vertex);
    const Edge* edges = edges_.data();
    return {edges + (turn < 0 ? corner.either : corner.left),
            edges + (turn > 0 ? corner.right : corner.end)};
  }
  /// A polygon of which a vertex is a corner that was met.
  [[nodiscard]] int polygon_of(int vertex) const {
    return corners_[static_cast<std::size_t>(vertex)].polygon;
  }

 private:
  struct Corner {
    std::uint32_t met = 0;  ///< rounds
    std::uint32_t looked = 0;
    int polygon = 0;
    std::uint32_t left = 0;    ///< first edge of a path that turned left here
    std::uint32_t either = 0;  ///< first of one that turned left or right
    std::uint32_t right = 0;
    std::uint32_t end = 0;
  };
  void look(int vertex);

  const Mesh* mesh_ = nullptr;
  std::uint64_t version_ = 0;    // of the mesh
  std::uint32_t round_ = 0;      // counts versions
  std::vector<Corner> corners_;  // by vertex
  std::vector<Edge> edges_;
  Sight sight_;
};

}  // namespace navvi_nav
