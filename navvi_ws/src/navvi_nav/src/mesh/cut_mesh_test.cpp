#include "mesh/cut_mesh.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "allocations.hpp"
#include "plan/carving.hpp"
#include "small_world.hpp"

namespace navvi_nav::mesh {
namespace {

constexpr double kUnit = 0.05;  // m
constexpr int kSquare = 40;     // units
constexpr int kSquares = 8;     // along a side of the floor
constexpr int kSides = 16;

struct Disc {
  Point center;
  double radius = 0.0;
};

/// Squares of 2 m, some missing, some in two rectangles or triangles, so that corners meet edges.
std::vector<GridPolygon> random_floor(std::mt19937& random) {
  std::vector<GridPolygon> out;
  for (int column = 0; column < kSquares; ++column) {
    for (int row = 0; row < kSquares; ++row) {
      const int x = column * kSquare, y = row * kSquare;
      const int u = x + kSquare, v = y + kSquare;
      const int cut = 4 + static_cast<int>(random() % 33);
      switch (random() % 6) {
        case 0:
          break;
        case 1:
          out.push_back({{{x, y}, {u, y}, {u, y + cut}, {x, y + cut}}});
          out.push_back({{{x, y + cut}, {u, y + cut}, {u, v}, {x, v}}});
          break;
        case 2:
          out.push_back({{{x, y}, {x + cut, y}, {x + cut, v}, {x, v}}});
          out.push_back({{{x + cut, y}, {u, y}, {u, v}, {x + cut, v}}});
          break;
        case 3:
          out.push_back({{{x, y}, {u, y}, {u, v}}});
          out.push_back({{{x, y}, {u, v}, {x, v}}});
          break;
        default:
          out.push_back({{{x, y}, {u, y}, {u, v}, {x, v}}});
      }
    }
  }
  return out;
}

/// Anywhere, or on whole units, so that edges and corners coincide with the floor's.
Disc random_disc(std::mt19937& random) {
  const auto draw = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Disc out{{draw(-1.0, 17.0), draw(-1.0, 17.0)}, draw(0.4, 1.5)};
  const double grid = random() % 3 == 0 ? 2.0 : random() % 2 == 0 ? 0.5 : 0.0;
  if (grid > 0.0)
    out.center = {grid * std::round(out.center.x / grid), grid * std::round(out.center.y / grid)};
  return out;
}

using Shape = std::vector<std::pair<double, double>>;

Shape shape_of(const Mesh& mesh, int polygon) {
  Shape out;
  for (const Point at : mesh.outline(polygon)) out.emplace_back(at.x, at.y);
  std::rotate(out.begin(), std::min_element(out.begin(), out.end()), out.end());
  return out;
}

/// The polygons with their neighbours and corner flags, whatever their numbers.
std::map<Shape, std::pair<std::set<Shape>, std::set<Shape>>> content(const Mesh& mesh) {
  std::map<Shape, std::pair<std::set<Shape>, std::set<Shape>>> out;
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    if (mesh.polygons[i].corners.empty()) continue;
    auto& [next, corners] = out[shape_of(mesh, static_cast<int>(i))];
    for (const Portal& portal : mesh.polygons[i].portals) next.insert(shape_of(mesh, portal.to));
    for (const int corner : mesh.polygons[i].corners) {
      if (mesh.vertices[static_cast<std::size_t>(corner)].corner)
        corners.insert({{mesh.at(corner).x, mesh.at(corner).y}});
    }
  }
  return out;
}

bool in_hole(const std::vector<Disc>& discs, Point at, double slack) {
  for (const Disc& disc : discs) {
    bool inside = true;
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2 * kPi * k / kSides;
      inside =
          inside && dot(at - disc.center, {std::cos(angle), std::sin(angle)}) < disc.radius + slack;
    }
    if (inside) return true;
  }
  return false;
}

bool in_floor(const std::vector<GridPolygon>& floor, Point at) {
  for (const GridPolygon& polygon : floor) {
    std::vector<Point> corners;
    for (const auto& corner : polygon.corners)
      corners.push_back({corner[0] * kUnit, corner[1] * kUnit});
    if (nearest_in_convex(at, corners) == at) return true;
  }
  return false;
}

/// Edges are portals or walls, portals lead back, walls have nothing behind them, polygons are
/// convex, where a path may turn is marked, and the sides of a non-manifold vertex have their own
/// vertices.
void expect_sound(const Mesh& mesh) {
  Mesh numbered = mesh;
  Components().number(numbered);
  std::map<int, int> component_of, component_is;
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    if (mesh.polygons[i].corners.empty()) continue;
    const int told = mesh.polygons[i].component;
    const int found = numbered.polygons[i].component;
    ASSERT_EQ(component_of.emplace(told, found).first->second, found);
    ASSERT_EQ(component_is.emplace(found, told).first->second, told);
  }
  std::map<int, double> free;
  std::set<int> walled, wall_begins;
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const Polygon& polygon = mesh.polygons[i];
    if (polygon.corners.empty()) {
      ASSERT_TRUE(polygon.portals.empty());
      continue;
    }
    ASSERT_GE(polygon.corners.size(), 3U);
    ASSERT_EQ(std::set<int>(polygon.corners.begin(), polygon.corners.end()).size(),
              polygon.corners.size());
    std::size_t portal = 0;
    const std::size_t count = polygon.corners.size();
    for (std::size_t k = 0; k < count; ++k) {
      const int from = polygon.corners[k];
      const int to = polygon.corners[(k + 1) % count];
      const Point a = mesh.at(from), b = mesh.at(to);
      const Point c = mesh.at(polygon.corners[(k + 2) % count]);
      ASSERT_GE(cross(b - a, c - b), -1e-9);
      free[to] += std::abs(std::atan2(cross(c - b, a - b), dot(c - b, a - b)));
      if (portal < polygon.portals.size() && polygon.portals[portal].right == from) {
        ASSERT_EQ(polygon.portals[portal].left, to);
        const auto& back = mesh.polygon(polygon.portals[portal].to).portals;
        ASSERT_EQ(std::count_if(back.begin(), back.end(),
                                [&](const Portal& other) {
                                  return other.to == static_cast<int>(i) && other.right == to &&
                                         other.left == from;
                                }),
                  1);
        ASSERT_EQ(mesh.polygon(polygon.portals[portal].to).component, polygon.component);
        ++portal;
        continue;
      }
      walled.insert({from, to});
      ASSERT_TRUE(wall_begins.insert(from).second)
          << "a non-manifold vertex at " << a.x << " " << a.y;
      if (distance(a, b) < 1e-3) continue;
      const Point beyond = 0.5 * (a + b) + (1e-5 / distance(a, b)) * Point{b.y - a.y, a.x - b.x};
      const auto place = mesh.locate(beyond, 0.0);
      ASSERT_FALSE(place && place->polygon != static_cast<int>(i))
          << "a wall at " << beyond.x << " " << beyond.y;
    }
    ASSERT_EQ(portal, polygon.portals.size());
  }
  for (const int vertex : walled) {
    if (free[vertex] > kPi + 1e-6) {
      ASSERT_TRUE(mesh.vertices[static_cast<std::size_t>(vertex)].corner)
          << mesh.at(vertex).x << " " << mesh.at(vertex).y;
    }
  }
}

void expect_free_points(const Mesh& mesh, const std::vector<GridPolygon>& floor,
                        const std::vector<Disc>& discs, std::mt19937& random) {
  std::uniform_real_distribution<double> draw(-0.5, 16.5);
  for (int k = 0; k < 200; ++k) {
    const Point at{draw(random), draw(random)};
    const bool free = mesh.locate(at, 1e-9).has_value();
    if (!in_floor(floor, at) || in_hole(discs, at, 0.0)) {
      ASSERT_FALSE(free) << at.x << " " << at.y;
    } else if (!in_hole(discs, at, 4e-4)) {
      ASSERT_TRUE(free) << at.x << " " << at.y;
    }
  }
}

TEST(CutMesh, of_nothing_takes_holes) {
  CutMesh mesh({}, kUnit);
  const int hole = mesh.add({0, 0}, 1.0, kSides);
  EXPECT_EQ(mesh.update(), 0);
  mesh.remove(hole);
  EXPECT_EQ(mesh.update(), 0);
  EXPECT_TRUE(mesh.mesh().polygons.empty());
}

TEST(CutMesh, cuts_a_hole_and_heals) {
  CutMesh mesh({{{{0, 0}, {200, 0}, {200, 200}, {0, 200}}}}, kUnit);
  const Mesh before = mesh.mesh();
  const int hole = mesh.add({5, 5}, 1.0, kSides);
  EXPECT_EQ(mesh.update(), 1);
  expect_sound(mesh.mesh());
  EXPECT_EQ(mesh.mesh().polygons.size(), static_cast<std::size_t>(kSides));
  EXPECT_FALSE(mesh.mesh().locate({5, 5}, 0.9));
  EXPECT_TRUE(mesh.mesh().locate({5, 6.001}, 0.0));  // along an axis nothing is lost
  mesh.remove(hole);
  EXPECT_EQ(mesh.update(), 1);
  EXPECT_TRUE(same(before, mesh.mesh()));
}

TEST(CutMesh, gives_the_sides_of_a_non_manifold_vertex_their_own_vertices) {
  // Above a corner of the floor, a hole moves by single steps; once its slanted edge touches it.
  CutMesh mesh({{{{0, 0}, {100, 0}, {100, 40}, {0, 40}}}, {{{0, -40}, {40, -40}, {40, 0}, {0, 0}}}},
               kUnit);
  const Mesh before = mesh.mesh();
  constexpr double kStep = kUnit / 512;
  int split = 0;
  for (int k = -5; k <= 5; ++k) {
    const int hole = mesh.add({2.4 - std::sqrt(0.5) + k * kStep, 0.4}, 0.5, kSides);
    mesh.update();
    expect_sound(mesh.mesh());
    std::set<int> there;
    for (const Polygon& polygon : mesh.mesh().polygons) {
      for (const int corner : polygon.corners) {
        if (mesh.mesh().at(corner) == (Point{2, 0})) there.insert(corner);
      }
    }
    split += there.size() == 2 ? 1 : 0;
    mesh.remove(hole);
    mesh.update();
    ASSERT_TRUE(same(before, mesh.mesh()));
  }
  EXPECT_EQ(split, 1);
}

TEST(CutMesh, parts_an_aisle_that_is_filled) {
  CutMesh mesh(
      {{{{0, 0}, {100, 0}, {100, 40}, {0, 40}}}, {{{100, 0}, {200, 0}, {200, 40}, {100, 40}}}},
      kUnit);
  const auto joined = [&mesh] {
    const Mesh& m = mesh.mesh();
    return m.polygon(m.locate({0.1, 1}, 0.0)->polygon).component ==
           m.polygon(m.locate({9.9, 1}, 0.0)->polygon).component;
  };
  EXPECT_TRUE(joined());
  const int filling = mesh.add({5, 1}, 1.0, kSides);
  mesh.update();
  EXPECT_FALSE(joined());
  mesh.remove(filling);
  mesh.add({5, 1}, 0.9, kSides);
  mesh.update();
  EXPECT_TRUE(joined());
}

TEST(CutMesh, is_sound_with_holes_anywhere_and_heals_to_what_it_was) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const std::vector<GridPolygon> floor = random_floor(random);
    CutMesh mesh(floor, kUnit);
    const Mesh before = mesh.mesh();
    expect_sound(before);
    std::vector<Disc> discs;
    std::vector<int> holes;
    for (auto k = random() % 12; k > 0; --k) {
      discs.push_back(random_disc(random));
      holes.push_back(mesh.add(discs.back().center, discs.back().radius, kSides));
    }
    mesh.update();
    expect_sound(mesh.mesh());
    expect_free_points(mesh.mesh(), floor, discs, random);
    for (const int hole : holes) mesh.remove(hole);
    mesh.update();
    EXPECT_TRUE(same(before, mesh.mesh()));
    if (HasFailure()) FAIL() << seed;
  }
}

TEST(CutMesh, does_not_remember_how_it_came_to_be) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const std::vector<GridPolygon> floor = random_floor(random);
    CutMesh mesh(floor, kUnit);
    std::vector<std::pair<Disc, int>> discs;
    for (int step = 0; step < 12; ++step) {
      for (auto k = 1 + random() % 3; k > 0; --k) {
        const Disc disc = random_disc(random);
        if (discs.size() > 8 || (!discs.empty() && random() % 2 == 0)) {
          const std::size_t which = random() % discs.size();
          mesh.remove(discs[which].second);
          discs.erase(discs.begin() + static_cast<std::ptrdiff_t>(which));
        } else {
          discs.emplace_back(disc, mesh.add(disc.center, disc.radius, kSides));
        }
      }
      mesh.update();
      expect_sound(mesh.mesh());
    }
    std::shuffle(discs.begin(), discs.end(), random);
    CutMesh fresh(floor, kUnit);
    for (const auto& disc : discs) fresh.add(disc.first.center, disc.first.radius, kSides);
    fresh.update();
    EXPECT_EQ(content(mesh.mesh()), content(fresh.mesh()));
    if (HasFailure()) FAIL() << seed;
  }
}

TEST(CutMesh, takes_a_part_of_another_floor) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const std::vector<GridPolygon> floor = random_floor(random);
    const std::vector<GridPolygon> other = random_floor(random);
    CutMesh mesh(floor, kUnit);
    std::vector<int> numbers(floor.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i);
    // Within a box that wanders, the other floor takes the first one's place, or gives it back.
    std::vector<GridPolygon> now = floor;
    for (int step = 0; step < 6; ++step) {
      const int x = kSquare * static_cast<int>(random() % kSquares);
      const int y = kSquare * static_cast<int>(random() % kSquares);
      const int side = kSquare * static_cast<int>(1 + random() % 4);
      const auto inside = [&](const GridPolygon& polygon) {
        for (const auto& corner : polygon.corners) {
          if (corner[0] < x || corner[0] > x + side || corner[1] < y || corner[1] > y + side)
            return false;
        }
        return true;
      };
      std::vector<int> gone, kept;
      std::vector<GridPolygon> come, next;
      for (std::size_t i = 0; i < now.size(); ++i) {
        (inside(now[i]) ? gone : kept).push_back(numbers[i]);
        if (!inside(now[i])) next.push_back(now[i]);
      }
      for (const GridPolygon& polygon : step % 2 == 0 ? other : floor) {
        if (inside(polygon)) come.push_back(polygon);
      }
      const std::vector<int> fresh = mesh.change_floor(gone, come);
      ASSERT_EQ(fresh.size(), come.size());
      now = next;
      now.insert(now.end(), come.begin(), come.end());
      numbers = kept;
      numbers.insert(numbers.end(), fresh.begin(), fresh.end());
      expect_sound(mesh.mesh());
      const auto before = content(mesh.mesh());
      ASSERT_EQ(before, content(CutMesh(now, kUnit).mesh())) << seed;
      std::vector<int> holes;
      for (int k = 0; k < 3; ++k) {
        const Disc disc = random_disc(random);
        holes.push_back(mesh.add(disc.center, disc.radius, kSides));
      }
      mesh.update();
      expect_sound(mesh.mesh());
      for (const int hole : holes) mesh.remove(hole);
      mesh.update();
      EXPECT_EQ(before, content(mesh.mesh()));
      if (HasFailure()) FAIL() << seed;
    }
  }
}

TEST(CutMesh, allocates_nothing_where_holes_were_before) {
  std::mt19937 random(1);
  CutMesh mesh(random_floor(random), kUnit);
  plan::Carving carving{plan::CarvingRules{}};
  std::vector<Cylinder> here, there;
  for (unsigned id = 0; id < 20; ++id) {
    const Disc disc = random_disc(random);
    here.push_back({id, disc.center, 0.3, {}});
    there.push_back({id, disc.center + Point{0.3, 0.1}, 0.3, {}});
  }
  for (int k = 0; k < 300; ++k) carving.carve(mesh, k % 2 == 0 ? here : there);
  const std::size_t before = allocations();
  for (int k = 0; k < 10; ++k) EXPECT_GT(carving.carve(mesh, k % 2 == 0 ? here : there), 0);
  EXPECT_EQ(allocations(), before);
  carving.carve(mesh, {{99, {8, 8}, 5.0, {}}});
  EXPECT_GT(allocations(), before);  // they are counted
}

TEST(CutMesh, stands_a_crowd_in_one_place_and_heals) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    CutMesh mesh(random_floor(random), kUnit);
    const Mesh before = mesh.mesh();
    std::vector<int> holes;
    for (int k = 0; k < 40; ++k) {
      const double angle = 0.3 * k;
      const Point at{8.0 + 0.05 * k * std::cos(angle), 8.0 + 0.05 * k * std::sin(angle)};
      holes.push_back(mesh.add(at, 0.3 + 0.01 * (k % 7), 4 + k % 13));
      if (k % 5 == 0) mesh.update();
    }
    mesh.update();
    expect_sound(mesh.mesh());
    for (const int hole : holes) mesh.remove(hole);
    mesh.update();
    ASSERT_TRUE(same(before, mesh.mesh())) << seed;
  }
}

}  // namespace
}  // namespace navvi_nav::mesh
