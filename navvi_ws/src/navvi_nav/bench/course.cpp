#include "course.hpp"

#include <random>
#include <sstream>

#include "octomap_tree.hpp"

namespace navvi_nav::bench {

using map::Floor;
using mesh::GridPolygon;
using mesh::Polygon;

namespace {

std::vector<std::int8_t> bytes_of(const octomap::OcTree& tree) {
  std::ostringstream stream;
  tree.writeBinaryData(stream);
  const std::string text = stream.str();
  return {text.begin(), text.end()};
}

Hall with_seed(Hall hall, std::uint32_t seed) {
  hall.seed = seed;
  return hall;
}

std::vector<GridPolygon> grid(const plain::Detour& detour) {
  std::vector<GridPolygon> out;
  for (const auto& corners : detour.polygons()) out.push_back({corners});
  return out;
}

}  // namespace

Course::Course(Hall hall, std::uint32_t seed)
    : name(hall.name()),
      seed(seed),
      tree(with_seed(hall, seed).map()),
      bytes(bytes_of(tree)),
      ours(config),
      carved(config),
      columns(tree),
      detour(columns, config.mesh.robot_radius, config.mesh.robot_height),
      detour_query(detour.mesh()),
      tile_cache(columns, config.mesh.robot_radius, config.mesh.robot_height, kTile),
      tile_cache_query(tile_cache.mesh()),
      detours_mesh(mesh::join(grid(detour), tree.getResolution())) {
  ours.set_map(voxels_of(tree));
  carved.set_map(voxels_of(tree));
  std::mt19937 random(seed);
  for (int i = 0; i < kQueries; ++i) {
    const Point start = somewhere(random);
    Point goal = somewhere(random);
    while (component(goal) != component(start)) goal = somewhere(random);
    queries.push_back({start, goal});
  }
}

std::vector<Cylinder> Course::discs(int count) const {
  std::mt19937 random(seed + 1);
  std::vector<Cylinder> out;
  for (std::uint32_t id = 0; id < static_cast<std::uint32_t>(count); ++id)
    out.push_back({id, somewhere(random), 0.5, {}});
  return out;
}

double Course::floor_area() const {
  const mesh::Mesh& mesh = ours.nav_mesh().mesh();
  double twice = 0.0;
  for (const Polygon& polygon : mesh.polygons) {
    for (std::size_t k = 2; k < polygon.corners.size(); ++k) {
      const Point origin = mesh.at(polygon.corners[0]);
      twice +=
          cross(mesh.at(polygon.corners[k - 1]) - origin, mesh.at(polygon.corners[k]) - origin);
    }
  }
  return 0.5 * twice;
}

Point Course::somewhere(std::mt19937& random) const {
  const Floor& floor = *ours.nav_mesh().shared_floor();
  const Point low = floor.center_of(floor.origin());
  std::uniform_real_distribution<double> x(low.x, low.x + floor.columns() * floor.cell_size());
  std::uniform_real_distribution<double> y(low.y, low.y + floor.rows() * floor.cell_size());
  Point point{x(random), y(random)};
  while (floor.clearance(point) < kRoom) point = {x(random), y(random)};
  return point;
}

int Course::component(Point point) const {
  return *ours.nav_mesh().floor_components(point, kRoom).begin();
}

}  // namespace navvi_nav::bench
