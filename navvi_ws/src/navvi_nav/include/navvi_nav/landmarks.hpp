#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "navvi_nav/tangents.hpp"

namespace navvi_nav {

/// Lower bounds of the way from a corner of a mesh to a goal, from the ways between both and a few
/// landmarks: no way is shorter than its ends' ways to one place differ (Goldberg and Harrelson,
/// "Computing the Shortest Path: A* Search Meets Graph Theory", SODA 2005). In a hall of shelves
/// the straight line is far too short a bound.
class Landmarks {
 public:
  /// Measures the ways from landmarks far apart to all corners that a way from `somewhere` leads
  /// to. \param tangents  that watch the mesh
  void measure(const Mesh& mesh, const Mesh::Place& somewhere, Tangents& tangents);
  void forget() { known_ = false; }
  [[nodiscard]] bool known() const { return known_; }

  /// Sets where at_least() leads. \param around  the polygons that hold that place
  /// \param seen  the corners that are seen from there
  void aim(const std::vector<int>& around, const std::vector<Sight::Corner>& seen) {
    goal_ = ways_from(around, seen);
  }
  /// m
  [[nodiscard]] double at_least(int vertex) const {
    const Ways& ways = ways_[static_cast<std::size_t>(vertex)];
    std::array<float, 4> most{};  // side by side, for the processor's vectors
    for (std::size_t k = 0; k < kCount; k += most.size()) {
      for (std::size_t i = 0; i < most.size(); ++i)
        most[i] = std::max(most[i], std::abs(ways[k + i] - goal_[k + i]));
    }
    return static_cast<double>(*std::max_element(most.begin(), most.end())) - kRounding;
  }

 private:
  static constexpr std::size_t kCount = 16;
  static constexpr double kRounding = 1e-3;  // m, more than single precision loses on a kilometre
  using Ways = std::array<float, kCount>;    // m, to each landmark
  struct Far {
    Mesh::Place place;
    double way = -1.0;
  };
  Far turn_everywhere(const Mesh& mesh, std::size_t landmark, Tangents& tangents);
  void forget_pinches(const Mesh& mesh);
  [[nodiscard]] Ways ways_from(const std::vector<int>& around,
                               const std::vector<Sight::Corner>& seen) const;

  bool known_ = false;
  std::array<Mesh::Place, kCount> places_;
  std::vector<Ways> turning_;  // of each vertex, if the way turns there and goes on; or infinity
  std::vector<Ways> ways_;     // of each vertex, if the way ends there; or NaN
  std::vector<std::array<bool, kCount>> sees_;  // by polygon: landmarks that see some of it
  Ways goal_{};
  Sight sight_;
};

}  // namespace navvi_nav
