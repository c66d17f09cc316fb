#include "mesh/vertex_pool.hpp"

#include <algorithm>
#include <cstring>

namespace navvi_nav::mesh {
namespace {

constexpr std::size_t kFirstBuckets = 256;

std::uint64_t bits(double value) {
  const double plain = value + 0.0;  // one zero
  std::uint64_t out = 0;
  std::memcpy(&out, &plain, sizeof out);
  return out;
}

std::uint64_t mix(std::uint64_t x) {
  x ^= x >> 31U;
  x *= 0x9E3779B97F4A7C15ULL;
  return x ^ (x >> 29U);
}

}  // namespace

int& VertexPool::bucket(Point at) {
  const std::uint64_t hash = mix(bits(at.x) + 3 * mix(bits(at.y)));
  return buckets_[hash & (buckets_.size() - 1)];
}

int VertexPool::take(std::vector<Vertex>& vertices, Point at) {
  if (in_use_ + 1 > buckets_.size()) grow(vertices);
  int& head = bucket(at);
  for (int vertex = head; vertex >= 0; vertex = entries_[slot(vertex)].next) {
    if (!(vertices[slot(vertex)].at == at)) continue;
    ++entries_[slot(vertex)].uses;
    return vertex;
  }
  const int vertex = fresh(vertices, at);
  entries_[slot(vertex)].next = head;
  head = vertex;
  return vertex;
}

int VertexPool::fresh(std::vector<Vertex>& vertices, Point at) {
  int vertex = static_cast<int>(vertices.size());
  if (free_.empty()) {
    vertices.emplace_back();
    entries_.emplace_back();
  } else {
    vertex = free_.back();
    free_.pop_back();
  }
  vertices[slot(vertex)] = {at, false};
  entries_[slot(vertex)] = {1, 0, -1, -1};
  ++in_use_;
  return vertex;
}

int VertexPool::duplicate(std::vector<Vertex>& vertices, int vertex) {
  const int out = fresh(vertices, vertices[slot(vertex)].at);
  entries_[slot(out)].duplicate_of = vertex;
  return out;
}

void VertexPool::drop_duplicate(std::vector<Vertex>& vertices, int duplicate) {
  vertices[slot(duplicate)].corner = false;
  entries_[slot(duplicate)] = {};
  free_.push_back(duplicate);
  --in_use_;
}

void VertexPool::drop(std::vector<Vertex>& vertices, int vertex) {
  if (--entries_[slot(vertex)].uses > 0) return;
  int* link = &bucket(vertices[slot(vertex)].at);
  while (*link != vertex) link = &entries_[slot(*link)].next;
  *link = entries_[slot(vertex)].next;
  free_.push_back(vertex);
  --in_use_;
}

void VertexPool::mark(std::vector<Vertex>& vertices, int vertex) {
  ++entries_[slot(vertex)].marks;
  vertices[slot(vertex)].corner = true;
}

void VertexPool::unmark(std::vector<Vertex>& vertices, int vertex) {
  vertices[slot(vertex)].corner = --entries_[slot(vertex)].marks > 0;
}

void VertexPool::grow(const std::vector<Vertex>& vertices) {
  buckets_.assign(buckets_.empty() ? kFirstBuckets : 2 * buckets_.size(), -1);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].uses == 0 || entries_[i].duplicate_of >= 0) continue;
    int& head = bucket(vertices[i].at);
    entries_[i].next = head;
    head = static_cast<int>(i);
  }
}

void VertexPool::shrink(std::vector<Vertex>& vertices, std::size_t count) {
  vertices.resize(count);
  entries_.resize(count);
  free_.erase(std::remove_if(free_.begin(), free_.end(),
                             [count](int vertex) { return slot(vertex) >= count; }),
              free_.end());
}

}  // namespace navvi_nav::mesh
