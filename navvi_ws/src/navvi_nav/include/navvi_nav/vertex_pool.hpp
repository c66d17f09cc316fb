#pragma once

#include <cstdint>
#include <vector>

#include "navvi_nav/mesh.hpp"

namespace navvi_nav {

/// Counts who uses which vertex, so that equal places share one and an unused one is used again.
class VertexPool {
 public:
  /// The vertex at a place, a new one if there is none. \returns index into `vertices`
  int take(std::vector<Vertex>& vertices, Point at);
  /// Undoes one take().
  void drop(std::vector<Vertex>& vertices, int vertex);
  /// Something makes the vertex a corner, until unmark().
  void mark(std::vector<Vertex>& vertices, int vertex);
  void unmark(std::vector<Vertex>& vertices, int vertex);

  [[nodiscard]] bool marked(int vertex) const {
    return entries_[static_cast<std::size_t>(vertex)].marks > 0;
  }

  /// Another vertex in the same place, that take() never gives.
  int twin(std::vector<Vertex>& vertices, int vertex);
  void drop_twin(std::vector<Vertex>& vertices, int twin);
  /// The vertex that take() gives for the place of this one.
  [[nodiscard]] int place_of(int vertex) const {
    const int twin_of = entries_[static_cast<std::size_t>(vertex)].twin_of;
    return twin_of >= 0 ? twin_of : vertex;
  }

  [[nodiscard]] std::size_t in_use() const { return in_use_; }
  /// Gives up vertices from `count` on, none of which may be in use.
  void shrink(std::vector<Vertex>& vertices, std::size_t count);

 private:
  struct Entry {
    int uses = 0;
    int marks = 0;
    int next = -1;  ///< in the same bucket
    int twin_of = -1;
  };
  int fresh(std::vector<Vertex>& vertices, Point at);
  [[nodiscard]] int& bucket(Point at);
  void grow(const std::vector<Vertex>& vertices);

  std::vector<Entry> entries_;
  std::vector<int> buckets_;
  std::vector<int> free_;
  std::size_t in_use_ = 0;
};

}  // namespace navvi_nav
