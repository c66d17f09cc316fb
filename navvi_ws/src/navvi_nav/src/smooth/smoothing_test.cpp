#include "smooth/smoothing.hpp"

#include <gtest/gtest.h>

#include "search/search.hpp"
#include "small_world.hpp"

namespace navvi_nav::smooth {
namespace {

Path smooth(const Path& path, const GuideCost& cost, const SmoothingConfig& config) {
  cost.allow(config.effort * length_of(path));
  const Smoother smoother(config.attempts);
  const Path out = smoother.sketch(path, cost);
  cost.allow(config.effort * length_of(path));
  return smoother.refine(out, cost);
}

class Smoothing : public testing::Test {
 protected:
  [[nodiscard]] GuideCost cost() const {
    return GuideCost(config_.cost, mesh_.mesh(), mesh_.space(), 0.35);
  }
  [[nodiscard]] Path smoothed(const Path& path) const { return smooth(path, cost(), config_); }

  plan::NavMesh mesh_ = mesh_of(SmallWorld().room(14, 10).box(4, 3, 0, 9, 6, 1.0));
  SmoothingConfig config_;
  const Path zigzag_{{1, 1}, {2, 2.3}, {3, 1.2}, {6, 2.4}, {9, 1.1}, {12, 2.0}, {12, 8}};
};

TEST_F(Smoothing, survives_paths_of_less_than_two_points_and_of_two_equal_ones) {
  EXPECT_TRUE(smoothed({}).empty());
  EXPECT_EQ(smoothed({{1, 1}}).size(), 1U);
  EXPECT_EQ(smoothed({{1, 1}, {1, 1}}).size(), 2U);
}

TEST_F(Smoothing, leaves_a_path_through_an_obstacle_as_it_is) {
  const Path through{{1, 4.5}, {13, 4.5}};
  EXPECT_EQ(smoothed(through), through);
}

TEST_F(Smoothing, makes_one_turn_of_a_zigzag_round_a_corner) {
  const Path path = smoothed(zigzag_);
  EXPECT_LE(path.size(), 3U);
  EXPECT_EQ(path.front(), zigzag_.front());
  EXPECT_EQ(path.back(), zigzag_.back());
}

TEST_F(Smoothing, moves_a_path_off_the_corners_that_it_hugs) {
  const Path hugging{{1, 4.5}, {3.65, 2.65}, {9.35, 2.65}, {12, 8}};
  const Path path = smoothed(hugging);
  double least = 10.0;
  for (const Point point : points_along(path, 0.05))
    least = std::min(least, mesh_.space().clearance(point));
  EXPECT_GT(least, 0.6);
}

TEST_F(Smoothing, stands_by_the_best_path_so_far_when_its_work_is_spent) {
  const Path hugging{{1, 4.5}, {3.65, 2.65}, {9.35, 2.65}, {12, 8}};
  const Smoother smoother(config_.attempts);
  for (const Path& path : {zigzag_, hugging}) {
    const GuideCost judge = cost();
    double least = judge.of(path);
    double spent = 0.0;  // m, of work
    for (double work = 0.0; work < 4000.0; work = 1.5 * work + 1.0) {
      const GuideCost counts = cost();
      counts.allow(work);
      const Path out = smoother.sketch(path, counts);
      spent = work - counts.left();
      EXPECT_LE(spent, work + 12.0 * length_of(path)) << "one try is carried through";
      EXPECT_LE(judge.of(out), least + 1e-9) << work;
      least = judge.of(out);
    }
    EXPECT_LT(spent, 4000.0) << "what is settled needs no more";
    EXPECT_LT(least, judge.of(path) - 1.0);
  }
}

/// Shortest paths of worlds anywhere, and what smoothing makes of them.
TEST(SmoothingSeeds, are_cheaper_on_the_mesh_and_dearer_without_ompl) {
  const SmoothingConfig config;
  SmoothingConfig without = config;
  without.attempts = 0;
  int paths = 0;
  int cheaper = 0;
  int dearer_without = 0;
  int dearer_with = 0;
  double saved = 0.0;  // m, by OMPL
  for (unsigned seed = 0; seed < 60; ++seed) {
    RandomWorld world(seed);
    plan::NavMesh nav_mesh = mesh_of(world.map);
    nav_mesh.carve(world.cylinders);
    const mesh::Mesh& mesh = nav_mesh.mesh();
    search::Search search(search::SearchMethod::exact);
    std::mt19937 random(seed);
    for (int i = 0; i < 40; ++i) {
      const auto pick = [&random](double size) {
        return 0.6 + size * static_cast<double>(random() % 1000) / 1000.0;
      };
      const auto from = mesh.locate({pick(18.8), pick(12.8)}, 0.0);
      const auto to = mesh.locate({pick(18.8), pick(12.8)}, 0.0);
      if (!from || !to || !search.find(mesh, *from, *to).found) continue;
      const Path shortest = search.find(mesh, *from, *to).path;
      if (shortest.size() < 4) continue;  // OMPL has corners to choose from
      ++paths;
      const GuideCost cost(config.cost, mesh, nav_mesh.space(), 0.35);
      const Path path = smooth(shortest, cost, config);
      EXPECT_EQ(path.front(), shortest.front());
      EXPECT_EQ(path.back(), shortest.back());
      EXPECT_TRUE(std::isfinite(cost.of(path)));
      EXPECT_LE(cost.of(path), cost.of(shortest));
      cheaper += cost.of(path) < cost.of(shortest) - 1e-9;
      const double gain = cost.of(smooth(shortest, cost, without)) - cost.of(path);
      dearer_without += gain > 0.01;
      dearer_with += gain < -0.01;
      saved += gain;
    }
  }
  EXPECT_GT(paths, 500);
  EXPECT_GT(cheaper, 9 * paths / 10);
  EXPECT_GT(dearer_without, paths / 3);
  EXPECT_GT(dearer_without, 2 * dearer_with);
  EXPECT_GT(saved, 0.0);
  RecordProperty("paths", paths);
  RecordProperty("dearer_without", dearer_without);
  RecordProperty("dearer_with", dearer_with);
}

}  // namespace
}  // namespace navvi_nav::smooth
