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
constexpr double kNever = std::numeric_limits<double>::infinity();

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

using Triangle = std::array<Eigen::Vector3d, 3>;

/// m, level, from the hull to where a triangle crosses the height, which is a segment.
double distance_at(const Triangle& triangle, double z) {
  std::vector<Eigen::Vector2d> ends;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = triangle[i], &b = triangle[(i + 1) % 3];
    if ((a.z() > z) != (b.z() > z))
      ends.emplace_back((a + (b - a) * ((z - a.z()) / (b.z() - a.z()))).head<2>());
  }
  if (ends.size() < 2) return kNever;
  const Eigen::Vector2d along = ends[1] - ends[0], to = kHull.centre - ends[0];
  const double share = std::clamp(to.dot(along) / std::max(1e-30, along.squaredNorm()), 0.0, 1.0);
  return std::max(0.0, (to - share * along).norm() - kHull.radius);
}

/// The least of it over the hull's heights, along which it is convex.
double searched(const std::vector<Triangle>& triangles) {
  double best = kNever;
  for (const Triangle& triangle : triangles) {
    const auto [low, high] = std::minmax({triangle[0].z(), triangle[1].z(), triangle[2].z()});
    double from = std::max(low + 1e-12, kHull.bottom), to = std::min(high - 1e-12, kHull.top);
    if (from > to) continue;
    for (int i = 0; i < 50; ++i) {
      const double third = (to - from) / 3.0;
      if (distance_at(triangle, from + third) < distance_at(triangle, to - third))
        to -= third;
      else
        from += third;
    }
    best = std::min(best, distance_at(triangle, 0.5 * (from + to)));
  }
  return best;
}

void expect_equal(const Gap& gap, double distance, const std::string& what,
                  double tolerance = 1e-6) {
  if (distance < 1e-6) {
    EXPECT_LT(gap.gap, tolerance) << what;
    return;
  }
  if (std::isinf(distance)) {
    EXPECT_EQ(gap.gap, distance) << what;
    return;
  }
  EXPECT_NEAR(gap.gap, distance, tolerance) << what;
  EXPECT_NEAR((gap.nearest.head<2>() - kHull.centre).norm() - kHull.radius, gap.gap, 1e-9) << what;
  EXPECT_GE(gap.nearest.z(), kHull.bottom - 1e-9) << what;
  EXPECT_LE(gap.nearest.z(), kHull.top + 1e-9) << what;
}

TEST(HullGap, to_a_triangle_is_that_of_its_nearest_point_at_the_hulls_heights) {
  Draw draw(1);
  for (int i = 0; i < 400; ++i) {
    const Triangle corners{draw.point(2), draw.point(2), draw.point(2)};
    expect_equal(gap_to(kHull, corners), searched({corners}), "triangle " + std::to_string(i));
  }
}

TEST(HullGap, to_a_triangle_without_area_is_that_of_the_line) {
  const Gap point =
      gap_to(kHull, {Eigen::Vector3d(2.3, -0.2, 0.2), {2.3, -0.2, 0.2}, {2.3, -0.2, 0.2}});
  EXPECT_NEAR(point.gap, 2.0 - 0.35, 1e-9);
  const Gap wall = gap_to(kHull, {Eigen::Vector3d(1.3, -3, 0), {1.3, 3, 0}, {1.3, 0, 1}});
  EXPECT_NEAR(wall.gap, 1.0 - 0.35, 1e-9);
}

/// The faces of a prism of many sides around z, in its own frame; of a box, one of four.
std::vector<Triangle> faces_of(const std::vector<Eigen::Vector2d>& rim, double length,
                               const Eigen::Isometry3d& pose) {
  std::vector<Triangle> faces;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Eigen::Vector2d &here = rim[i], &next = rim[(i + 1) % rim.size()];
    const auto at = [&](const Eigen::Vector2d& place, double end) -> Eigen::Vector3d {
      return pose * Eigen::Vector3d(place.x(), place.y(), end * length);
    };
    faces.push_back({at(here, -0.5), at(here, 0.5), at(next, -0.5)});
    faces.push_back({at(next, 0.5), at(here, 0.5), at(next, -0.5)});
    for (const double end : {-0.5, 0.5})
      faces.push_back({at(here, end), at(next, end), at(Eigen::Vector2d::Zero(), end)});
  }
  return faces;
}

TEST(HullGap, to_a_box_is_that_of_its_faces) {
  Draw draw(2);
  for (int i = 0; i < 200; ++i) {
    const Box box{{draw(0.1, 2), draw(0.1, 2), draw(0.1, 2)}};
    const Eigen::Isometry3d pose = draw.pose(2.5, i % 2 == 0);
    const Eigen::Vector2d half = 0.5 * box.size.head<2>();
    const double distance = searched(
        faces_of({half, {-half.x(), half.y()}, -half, {half.x(), -half.y()}}, box.size.z(), pose));
    const Eigen::Vector3d middle = pose.inverse() * Eigen::Vector3d(0.3, -0.2, 0.275);
    const Eigen::Vector3d inside = 0.5 * box.size - middle.cwiseAbs();
    if (inside.minCoeff() > 0.0 || (i % 2 == 1 && inside.head<2>().minCoeff() > 0.0))
      EXPECT_LE(gap_to(kHull, box, pose).gap, 0.0) << "box " << i << " holds the hull";
    else if (std::isfinite(distance))
      expect_equal(gap_to(kHull, box, pose), distance, "box " + std::to_string(i));
  }
}

TEST(HullGap, to_a_cylinder_is_that_of_its_side_and_ends) {
  Draw draw(3);
  for (int i = 0; i < 200; ++i) {
    const Cylinder cylinder{draw(0.05, 1), draw(0.1, 2)};
    const Eigen::Isometry3d pose = draw.pose(2.5, i % 2 == 0);
    std::vector<Eigen::Vector2d> rim;
    for (int side = 0; side < 256; ++side)
      rim.push_back(cylinder.radius *
                    (Eigen::Rotation2Dd(2.0 * kPi / 256 * side) * Eigen::Vector2d::UnitX()));
    const double distance = searched(faces_of(rim, cylinder.length, pose));
    const Eigen::Vector3d middle = pose.inverse() * Eigen::Vector3d(0.3, -0.2, 0.275);
    const bool around =
        middle.head<2>().norm() < cylinder.radius && std::abs(middle.z()) < 0.5 * cylinder.length;
    if (around)
      EXPECT_LE(gap_to(kHull, cylinder, pose).gap, 0.0) << "cylinder " << i << " holds the hull";
    else if (std::isfinite(distance))
      expect_equal(gap_to(kHull, cylinder, pose), distance, "cylinder " + std::to_string(i), 3e-3);
  }
}

TEST(HullGap, is_no_more_than_what_lies_in_a_box_around) {
  Draw draw(4);
  for (int i = 0; i < 500; ++i) {
    const Sphere sphere{draw(0.05, 1)};
    const Eigen::Isometry3d pose = draw.pose(3, true);
    const double bound = kHull.bound(bounds_of(sphere, pose));
    if (std::isinf(bound)) continue;
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
      least = std::min(least, gap_to(kHull, corners).gap);
    }
    const auto near = things_near(kHull, 5.0, bodies, {});
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
  const auto together = things_near(kHull, 5.0, Bodies(world, kHull.bottom), {});
  EXPECT_GT(together.size(), 10u);
  std::size_t found = 0;
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    WorldDescription one;
    one.things = {world.things[i]};
    for (const ThingGap& alone : things_near(kHull, 5.0, Bodies(one, kHull.bottom), {})) {
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
  const auto near = things_near(kHull, 5.0, bodies, {mover});
  ASSERT_EQ(near.size(), 1u);
  EXPECT_NEAR(near[0].gap, 3.0 - 0.5 - 0.35, 1e-9);
  mover.pose.translation().x() = 30.0;
  EXPECT_TRUE(things_near(kHull, 5.0, bodies, {mover}).empty());
}

}  // namespace
}  // namespace navvi_sim::physics
