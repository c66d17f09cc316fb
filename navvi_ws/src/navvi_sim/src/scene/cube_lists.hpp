#pragma once

#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "scene/painter.hpp"

namespace navvi_sim::scene {

/// Boxes along the axes of map, one CUBE_LIST for all of one size and colour: 24 bytes a box, and
/// RViz outlines their edges.
class CubeLists {
 public:
  /// \param cube  m, in map; not empty
  void add(const std::string& ns, const Color& color, const Eigen::AlignedBox3d& cube);

  /// The lists, most cubes first. Where there are very many cubes, the largest lists are cut into
  /// tiles, so that RViz can leave out what is not in view. What does not fit into `most` of them
  /// is drawn as triangles, one list a namespace. \param next_id  of each namespace; counted on
  [[nodiscard]] std::vector<visualization_msgs::Marker> markers(
      std::size_t most, std::map<std::string, int>& next_id) const;

 private:
  struct List {
    std::string ns;
    Color color;
    Eigen::Vector3d size;
    std::vector<Eigen::Vector3d> centres;
  };
  /// Namespace, colour in 1/1000, size in mm.
  using Key = std::pair<std::string, std::array<long, 6>>;

  [[nodiscard]] std::vector<List> tiled() const;

  std::map<Key, List> lists_;
};

}  // namespace navvi_sim::scene
