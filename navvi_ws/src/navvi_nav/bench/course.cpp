#include "course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "octomap_tree.hpp"

namespace navvi_nav::bench {
namespace {

constexpr double kShelf[2] = {10.0, 1.0};  // m
constexpr double kAisle = 3.0;             // m
constexpr double kTall = 0.4;              // m, all that the robot must see of a shelf
constexpr double kWall = 0.2;              // m
constexpr double kBox = 0.4;               // m, how high

/// Occupied from (x0, y0, z0) to (x1, y1, z1), m.
void fill(octomap::OcTree& tree, double x0, double y0, double z0, double x1, double y1, double z1) {
  const double r = tree.getResolution();
  const auto voxel = [r](double at) { return std::lround(at / r); };
  const auto middle = [r](long voxel) {
    return static_cast<float>((static_cast<double>(voxel) + 0.5) * r);
  };
  for (long x = voxel(x0); x < voxel(x1); ++x)
    for (long y = voxel(y0); y < voxel(y1); ++y)
      for (long z = voxel(z0); z < voxel(z1); ++z)
        tree.updateNode(octomap::point3d(middle(x), middle(y), middle(z)), true, true);
}

std::vector<std::int8_t> bytes_of(const octomap::OcTree& tree) {
  std::ostringstream stream;
  tree.writeBinaryData(stream);
  const std::string text = stream.str();
  return {text.begin(), text.end()};
}

}  // namespace

std::string Hall::name() const {
  return std::to_string(std::lround(length)) + " x " + std::to_string(std::lround(width)) + " m" +
         (clutter > 0.0 ? " cluttered" : "");
}

octomap::OcTree Hall::map() const {
  octomap::OcTree tree(resolution);
  fill(tree, 0, 0, -resolution, length, width, 0);
  fill(tree, 0, 0, 0, length, kWall, kTall);
  fill(tree, 0, width - kWall, 0, length, width, kTall);
  fill(tree, 0, 0, 0, kWall, width, kTall);
  fill(tree, length - kWall, 0, 0, length, width, kTall);
  for (double x = kAisle; x + kShelf[0] + kAisle <= length; x += kShelf[0] + kAisle)
    for (double y = kAisle; y + kShelf[1] + kAisle <= width; y += kShelf[1] + kAisle)
      fill(tree, x, y, 0, x + kShelf[0], y + kShelf[1], kTall);
  std::mt19937 random(seed);
  const auto draw = [&random](double below) {
    return 0.1 * static_cast<double>(random() % static_cast<unsigned>(below / 0.1));
  };
  const int boxes = clutter > 0.0 ? static_cast<int>(length * width / clutter) : 0;
  for (int i = 0; i < boxes; ++i) {
    const double x = 1.0 + draw(length - 3.0);
    const double y = 1.0 + draw(width - 3.0);
    const double edge = 0.3 + draw(0.6);
    fill(tree, x, y, 0, x + edge, y + edge, i % 2 == 0 ? 0.1 : kTall);
  }
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

using map::Floor;
using mesh::Polygon;

double now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Course::Course(const Hall& hall)
    : name(hall.name()),
      seed(hall.seed),
      tree(hall.map()),
      bytes(bytes_of(tree)),
      carved(config),
      columns(tree) {
  carved.set_map(map::voxels_of(tree));
  std::mt19937 random(seed);
  for (int i = 0; i < kQueries; ++i) {
    const Point start = somewhere(random);
    Point goal = somewhere(random);
    while (component(goal) != component(start)) goal = somewhere(random);
    queries.push_back({start, goal});
  }
  across = queries;
  std::sort(across.begin(), across.end(), [](const Query& a, const Query& b) {
    return norm(a.goal - a.start) > norm(b.goal - b.start);
  });
  across.resize(kQueries / 10);
  choose_tile();
  octomap::OcTree with_box(tree);
  const double step = tree.getResolution();
  for (double x = -0.5; x < 0.5; x += step)
    for (double y = -0.5; y < 0.5; y += step)
      for (double z = 0.5 * step; z < kBox; z += step)
        with_box.updateNode(queries[0].start.x + x, queries[0].start.y + y, z, true);
  changed_bytes = bytes_of(with_box);
}

void Course::choose_tile() {
  constexpr int kDiscs = 50;
  constexpr int kMoves = 20;
  double least = std::numeric_limits<double>::infinity();
  for (const int size : {16, 24, 32, 48, 64}) {
    try {
      auto cache = std::make_unique<plain::TileCache>(columns, config.mesh.robot_radius,
                                                      config.mesh.robot_height, size);
      auto query = std::make_unique<plain::Query>(cache->mesh());
      std::vector<Cylinder> moved = discs(kDiscs);
      cache->place(moved);
      const double begin = now();
      for (std::size_t i = 0; i < kMoves; ++i) {
        for (Cylinder& disc : moved) disc.center.x += i % 2 == 0 ? 0.3 : -0.3;
        cache->place(moved);
        if (query->locate(queries[i].start, queries[i].goal)) (void)query->search();
      }
      const double took = tiles_tried[size] = 1e3 * (now() - begin) / kMoves;
      cache->place({});
      if (took >= least) continue;
      least = took;
      tile = size;
      tile_cache_query = std::move(query);
      tile_cache = std::move(cache);
    } catch (const std::runtime_error&) {
      tiles_tried[size] = std::numeric_limits<double>::infinity();
    }
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
  const mesh::Mesh& mesh = carved.nav_mesh().mesh();
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
  const Floor& floor = *carved.nav_mesh().shared_floor();
  const Point low = floor.cell_size() * Point{floor.origin().x + 0.5, floor.origin().y + 0.5};
  std::uniform_real_distribution<double> x(low.x, low.x + floor.columns() * floor.cell_size());
  std::uniform_real_distribution<double> y(low.y, low.y + floor.rows() * floor.cell_size());
  Point point{x(random), y(random)};
  while (floor.clearance(point) < kRoom) point = {x(random), y(random)};
  return point;
}

int Course::component(Point point) const {
  return *carved.nav_mesh().floor_components(point, kRoom).begin();
}

}  // namespace navvi_nav::bench
