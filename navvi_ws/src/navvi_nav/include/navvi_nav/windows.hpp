#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "navvi_nav/sight.hpp"

namespace navvi_nav {

/// From which corners of a mesh each polygon is seen, and between what. All corners have to look
/// about for it once; then the corners that a place sees are found among its polygon's alone.
class Windows {
 public:
  /// \param most  windows, 16 bytes each, then measure() gives up: in vast halls they are too many
  explicit Windows(std::size_t most = 6000000) : most_(most) {}

  void measure(const Mesh& mesh);
  void forget() { known_ = false; }
  [[nodiscard]] bool known() const { return known_; }

  /// As Sight::look() from a place on the mesh that was measured. Some may come twice.
  const std::vector<Sight::Corner>& look(const Mesh& mesh, const Mesh::Place& place);
  /// The polygons that hold the place that was looked from last.
  [[nodiscard]] const std::vector<int>& around() const { return around_; }

 private:
  /// A corner that sees of a polygon what lies between two vertices, and round which a path from
  /// there may turn.
  struct Window {
    int corner = 0;
    int right = 0;  ///< Sight::kAll: it is a corner of the polygon, and sees all of it
    int left = 0;
    int turned = kAsk;  ///< as Sight::Walls::turn(), if that is the same for all that is seen
  };
  static constexpr int kAsk = 2;
  struct Corner {
    Sight::Walls walls;
    int polygon = -1;
  };
  void add(const Mesh& mesh, int corner, const Sight::Glimpse& glimpse);
  void sort(std::size_t polygons);

  std::size_t most_;
  bool known_ = false;
  std::vector<Window> windows_;       // in order of their polygons
  std::vector<int> polygons_;         // of the windows, while they are measured
  std::vector<std::uint32_t> first_;  // of each polygon, and one beyond the last
  std::vector<Corner> corners_;       // by vertex
  std::vector<int> around_;
  std::vector<Sight::Corner> seen_;
};

}  // namespace navvi_nav
