#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace navvi_nav::mesh {

/// Counts the uses of each vertex, so that equal places share one and an unused one is used again.
class VertexPool {
 public:
  /// The vertex at a place, a new one if there is none. \returns index into `vertices`
  int take(std::vector<Vertex>& vertices, Point at);
  /// Undoes one take().
  void drop(std::vector<Vertex>& vertices, int vertex);
  /// The vertex is a corner until each mark() is undone by an unmark().
  void mark(std::vector<Vertex>& vertices, int vertex);
  void unmark(std::vector<Vertex>& vertices, int vertex);

  [[nodiscard]] bool marked(int vertex) const {
    return entries_[static_cast<std::size_t>(vertex)].marks > 0;
  }

  /// Another vertex in the same place, which take() never returns.
  int duplicate(std::vector<Vertex>& vertices, int vertex);
  void drop_duplicate(std::vector<Vertex>& vertices, int duplicate);
  /// The vertex that take() returns for the place of this one.
  [[nodiscard]] int place_of(int vertex) const {
    const int duplicate_of = entries_[static_cast<std::size_t>(vertex)].duplicate_of;
    return duplicate_of >= 0 ? duplicate_of : vertex;
  }

  [[nodiscard]] std::size_t in_use() const { return in_use_; }
  /// Removes the vertices from `count` on, none of which may be in use.
  void shrink(std::vector<Vertex>& vertices, std::size_t count);

 private:
  struct Entry {
    int uses = 0;
    int marks = 0;
    int next = -1;  ///< in the same bucket
    int duplicate_of = -1;
  };
  int fresh(std::vector<Vertex>& vertices, Point at);
  [[nodiscard]] int& bucket(Point at);
  void grow(const std::vector<Vertex>& vertices);

  std::vector<Entry> entries_;
  std::vector<int> buckets_;
  std::vector<int> free_;
  std::size_t in_use_ = 0;
};

}  // namespace navvi_nav::mesh
