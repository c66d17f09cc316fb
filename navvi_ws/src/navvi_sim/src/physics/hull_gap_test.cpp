#include "physics/hull_gap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "description/floor_height.hpp"
#include "physics/proximity.hpp"

namespace navvi_sim::physics {
namespace {

const Hull kHull{{0.3, -0.2}, 0.35, 0.05, 0.5};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  Eigen::Vector3d point(double reach) {
    return {(*this)(-reach, reach), (*this)(-reach, reach), (*this)(-0.5, 1.5)};
  }
  Eigen::Isometry3d pose(double reach, bool tilted) {
    Eigen::Isometry3d pose(Eigen::AngleAxisd((*this)(-3, 3), Eigen::Vector3d::UnitZ()));
    pose.translation() = point(reach);
    if (tilted) {
      pose.rotate(Eigen::AngleAxisd((*this)(-1.5, 1.5), Eigen::Vector3d::UnitX()));
      pose.rotate(Eigen::AngleAxisd((*this)(-1.5, 1.5), Eigen::Vector3d::UnitY()));
    }
    return pose;
  }

 private:
  std::mt19937_64 random_;
};

/// The least distance over a patch point(u, v), 0 <= u, v <= 1: a grid, then finer grids about its
/// best point.
template <typename Point>
double searched(Point point) {
  double low_u = 0, high_u = 1, low_v = 0, high_v = 1, best = 1e9;
  for (int round = 0; round < 7; ++round) {
    constexpr int kSteps = 24;
    double best_u = 0, best_v = 0;
    best = 1e9;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j) {
        const double u = low_u + (high_u - low_u) * i / kSteps;
        const double v = low_v + (high_v - low_v) * j / kSteps;
        const double distance = kHull.distance(point(u, v));
        if (distance < best) {
          best = distance;
          best_u = u;
          best_v = v;
        }
      }
    const double du = 3.0 * (high_u - low_u) / kSteps, dv = 3.0 * (high_v - low_v) / kSteps;
    low_u = std::max(0.0, best_u - du), high_u = std::min(1.0, best_u + du);
    low_v = std::max(0.0, best_v - dv), high_v = std::min(1.0, best_v + dv);
  }
  return best;
}

void expect_equal(const Gap& gap, double distance, const std::string& what) {
  if (distance < 1e-6) {
    EXPECT_LT(gap.gap, 1e-4) << what;
    return;
  }
  EXPECT_NEAR(gap.gap, distance, 2e-4) << what;
  EXPECT_NEAR(kHull.distance(gap.nearest), gap.gap, 2e-4) << what << ": its point";
}

TEST(HullGap, to_a_triangle_is_that_of_its_nearest_point) {
  Draw draw(1);
  for (int i = 0; i < 400; ++i) {
    const std::array<Eigen::Vector3d, 3> corners{draw.point(2), draw.point(2), draw.point(2)};
    const double distance = searched([&](double u, double v) -> Eigen::Vector3d {
      return corners[0] + u * ((1 - v) * (corners[1] - corners[0]) + v * (corners[2] - corners[0]));
    });
    expect_equal(gap_to(kHull, corners, 1e9), distance, "triangle " + std::to_string(i));
  }
}

TEST(HullGap, to_a_triangle_without_area_is_that_of_the_line) {
  const Gap point =
      gap_to(kHull, {Eigen::Vector3d(2.3, -0.2, 0.2), {2.3, -0.2, 0.2}, {2.3, -0.2, 0.2}}, 1e9);
  EXPECT_NEAR(point.gap, 2.0 - 0.35, 1e-9);
  const Gap wall = gap_to(kHull, {Eigen::Vector3d(1.3, -3, 0), {1.3, 3, 0}, {1.3, 0, 1}}, 1e9);
  EXPECT_NEAR(wall.gap, 1.0 - 0.35, 1e-9);
}

TEST(HullGap, to_a_box_is_that_of_its_faces) {
  Draw draw(2);
  for (int i = 0; i < 200; ++i) {
    const Box box{{draw(0.1, 2), draw(0.1, 2), draw(0.1, 2)}};
    const Eigen::Isometry3d pose = draw.pose(2.5, i % 2 == 0);
    double distance = 1e9;
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-0.5, 0.5})
        distance = std::min(distance, searched([&](double u, double v) -> Eigen::Vector3d {
                              Eigen::Vector3d local;
                              local[axis] = side * box.size[axis];
                              local[(axis + 1) % 3] = (u - 0.5) * box.size[(axis + 1) % 3];
                              local[(axis + 2) % 3] = (v - 0.5) * box.size[(axis + 2) % 3];
                              return pose * local;
                            }));
    expect_equal(gap_to(kHull, box, pose), distance, "box " + std::to_string(i));
  }
}

TEST(HullGap, to_a_cylinder_is_that_of_its_side_and_ends) {
  Draw draw(3);
  for (int i = 0; i < 200; ++i) {
    const Cylinder cylinder{draw(0.05, 1), draw(0.1, 2)};
    const Eigen::Isometry3d pose = draw.pose(2.5, i % 2 == 0);
    const auto at = [&](double radius, double turn, double height) -> Eigen::Vector3d {
      return pose * Eigen::Vector3d(radius * std::cos(turn), radius * std::sin(turn), height);
    };
    double distance = 1e9;
    for (int quarter = 0; quarter < 8; ++quarter) {
      const auto turn = [&](double u) { return 0.785398163397448 * (quarter + u); };
      distance = std::min(distance, searched([&](double u, double v) {
                            return at(cylinder.radius, turn(u), (v - 0.5) * cylinder.length);
                          }));
      for (const double end : {-0.5, 0.5})
        distance = std::min(distance, searched([&](double u, double v) {
                              return at(v * cylinder.radius, turn(u), end * cylinder.length);
                            }));
    }
    const Gap gap = gap_to(kHull, cylinder, pose);
    const Eigen::Vector3d middle = pose.inverse() * Eigen::Vector3d(0.3, -0.2, 0.275);
    const bool around =
        middle.head<2>().norm() < cylinder.radius && std::abs(middle.z()) < 0.5 * cylinder.length;
    if (around) {
      EXPECT_LE(gap.gap, 0.0) << "cylinder " << i << " holds the hull";
      continue;
    }
    expect_equal(gap, distance, "cylinder " + std::to_string(i));
  }
}

TEST(HullGap, is_no_more_than_what_lies_in_a_box_around) {
  Draw draw(4);
  for (int i = 0; i < 500; ++i) {
    const Sphere sphere{draw(0.05, 1)};
    const Eigen::Isometry3d pose = draw.pose(3, true);
    const double bound = kHull.bound(bounds_of(sphere, pose));
    EXPECT_LE(bound, std::max(0.0, gap_to(kHull, sphere, pose).gap) + 1e-12);
  }
}

/// Triangles of all sizes, scattered.
std::shared_ptr<const Mesh> soup(std::uint64_t seed, std::uint32_t count) {
  Draw draw(seed);
  Mesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d at = draw.point(8);
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices.push_back((at + draw(0.02, 1.0) * draw.point(1)).cast<float>());
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return std::make_shared<const Mesh>(std::move(mesh));
}

TEST(Proximity, of_a_mesh_is_that_of_all_its_triangles_one_by_one) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Draw draw(seed);
    Thing thing;
    thing.name = "soup";
    thing.pose = draw.pose(3, seed % 2 == 0);
    const auto mesh = soup(seed, 300);
    thing.shapes.push_back({mesh, Eigen::Isometry3d::Identity()});
    WorldDescription world;
    world.things = {thing};
    const Bodies bodies(world, kHull.bottom);
    double least = 1e9;
    for (const auto& indices : mesh->triangles) {
      std::array<Eigen::Vector3d, 3> corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = thing.pose * mesh->vertices[indices[i]].cast<double>();
      const double low = std::min({corners[0].z(), corners[1].z(), corners[2].z()});
      const double high = std::max({corners[0].z(), corners[1].z(), corners[2].z()});
      if (high < kHull.bottom || low > 2.0) continue;
      least = std::min(least, gap_to(kHull, corners, 1e9).gap);
    }
    const auto near = things_near(kHull, 5.0, 2.0, bodies, {});
    if (least > 5.0) {
      EXPECT_TRUE(near.empty());
      continue;
    }
    ASSERT_EQ(near.size(), 1u);
    EXPECT_NEAR(near[0].gap, least, 1e-6) << "seed " << seed;
  }
}

TEST(Proximity, of_many_things_is_that_of_each_alone) {
  Draw draw(9);
  WorldDescription world;
  for (int i = 0; i < 300; ++i) {
    Thing thing;
    thing.pose = draw.pose(15, i % 3 == 0);
    if (i % 3 == 0)
      thing.shapes.push_back({Box{{draw(0.1, 2), draw(0.1, 2), 0.5}}, draw.pose(1, false)});
    else if (i % 3 == 1)
      thing.shapes.push_back({Cylinder{draw(0.1, 1), 1.0}, draw.pose(1, false)});
    thing.shapes.push_back({Sphere{draw(0.1, 0.5)}, draw.pose(1, false)});
    world.things.push_back(thing);
  }
  const auto together = things_near(kHull, 5.0, 2.0, Bodies(world, kHull.bottom), {});
  EXPECT_GT(together.size(), 10u);
  std::size_t found = 0;
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    WorldDescription one;
    one.things = {world.things[i]};
    for (const ThingGap& alone : things_near(kHull, 5.0, 2.0, Bodies(one, kHull.bottom), {})) {
      ++found;
      const auto same = std::find_if(together.begin(), together.end(),
                                     [&](const ThingGap& near) { return near.thing == i; });
      ASSERT_NE(same, together.end());
      EXPECT_EQ(same->gap, alone.gap);
    }
  }
  EXPECT_EQ(found, together.size());
}

TEST(Proximity, of_what_moves_follows_it) {
  WorldDescription world;
  Thing thing;
  thing.route = Route{{{{0, 0}}, {{1, 0}}}};
  thing.shapes.push_back({Box{{1, 1, 1}}, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.5))});
  world.things = {thing};
  const Bodies bodies(world, kHull.bottom);
  MoverState mover;
  mover.thing.radius = 0.71;
  mover.pose = Eigen::Translation3d(3.3, -0.2, 0);
  const auto near = things_near(kHull, 5.0, 2.0, bodies, {mover});
  ASSERT_EQ(near.size(), 1u);
  EXPECT_NEAR(near[0].gap, 3.0 - 0.5 - 0.35, 1e-9);
  mover.pose.translation().x() = 30.0;
  EXPECT_TRUE(things_near(kHull, 5.0, 2.0, bodies, {mover}).empty());
}

}  // namespace
}  // namespace navvi_sim::physics
