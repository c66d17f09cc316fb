#include "search/search.hpp"

#include <gtest/gtest.h>

#include "allocations.hpp"
#include "grid_world.hpp"
#include "join.hpp"
#include "visibility_graph.hpp"

namespace navvi_nav::search {
namespace {

constexpr int kSeeds = 60;    // of each kind of world
constexpr int kQueries = 12;  // in each world

/// By trying all polygons; the mesh may have been moved.
std::optional<mesh::Mesh::Place> place_of(const mesh::Mesh& mesh, Point point) {
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    if (mesh.polygons[i].corners.empty()) continue;
    const auto outline = mesh.outline(static_cast<int>(i));
    if (distance(nearest_in_convex(point, outline), point) < 1e-12)
      return mesh::Mesh::Place{static_cast<int>(i), point};
  }
  return std::nullopt;
}

/// Neither place lies on a non-manifold vertex.
struct Query {
  mesh::Mesh::Place start;
  mesh::Mesh::Place goal;
};

/// What must hold of any answer, besides its length.
void check_shape(const Found& found, const Query& query, VisibilityGraph& graph) {
  ASSERT_FALSE(found.path.empty());
  EXPECT_EQ(found.path.front(), query.start.point);
  EXPECT_EQ(found.path.back(), query.goal.point);
  for (std::size_t i = 1; i < found.path.size(); ++i)
    EXPECT_TRUE(graph.visible(found.path[i - 1], found.path[i]))
        << found.path[i - 1].x << " " << found.path[i - 1].y << " - " << found.path[i].x << " "
        << found.path[i].y;
}

struct Judge {
  Search exact{SearchMethod::exact};
  Search centroids{SearchMethod::centroid_astar};
  int answered = 0;
  int unreachable = 0;

  void judge(const mesh::Mesh& mesh, const Query& query, VisibilityGraph& graph) {
    SCOPED_TRACE(::testing::Message() << query.start.point.x << " " << query.start.point.y << " > "
                                      << query.goal.point.x << " " << query.goal.point.y);
    const std::optional<double> shortest = graph.distance(query.start, query.goal);
    const Found& found = exact.find(mesh, query.start, query.goal);
    const Found& rough = centroids.find(mesh, query.start, query.goal);
    ASSERT_EQ(found.found, shortest.has_value());
    ASSERT_EQ(found.found, rough.found);
    if (!shortest) {
      EXPECT_TRUE(found.path.empty());
      ++unreachable;
      return;
    }
    ++answered;
    EXPECT_NEAR(length_of(found.path), *shortest, 1e-9 * *shortest + 1e-12);
    EXPECT_GE(length_of(rough.path), length_of(found.path) * (1.0 - 1e-9));
    check_shape(found, query, graph);
  }
};

/// True if polygons meet in this point that no portal through it joins: then it is open on which
/// side of the vertex a path begins.
bool on_non_manifold_vertex(const mesh::Mesh& mesh, Point point) {
  std::vector<int> there;
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const auto outline = mesh.outline(static_cast<int>(i));
    if (!outline.empty() && distance(nearest_in_convex(point, outline), point) < 1e-12)
      there.push_back(static_cast<int>(i));
  }
  std::vector<int> joined(there.begin(), there.begin() + 1);
  for (std::size_t i = 0; i < joined.size(); ++i) {
    for (const mesh::Portal& portal : mesh.polygon(joined[i]).portals) {
      const Point near = nearest_on_segment(point, mesh.at(portal.right), mesh.at(portal.left));
      if (distance(near, point) < 1e-12 &&
          std::find(joined.begin(), joined.end(), portal.to) == joined.end())
        joined.push_back(portal.to);
    }
  }
  return joined.size() < there.size();
}

/// In a mesh of that world in half metres; none where a place lies in a hole or on such a vertex.
std::optional<Query> draw_query(const mesh::Mesh& mesh, const GridWorld& world,
                                std::mt19937& random) {
  const auto start = place_of(mesh, 0.5 * world.somewhere(random));
  const auto goal = place_of(mesh, 0.5 * world.somewhere(random));
  if (!start || !goal || on_non_manifold_vertex(mesh, start->point) ||
      on_non_manifold_vertex(mesh, goal->point))
    return std::nullopt;
  return Query{*start, *goal};
}

Point turned(Point point, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * point.x - s * point.y, s * point.x + c * point.y};
}

/// Turned, stretched and shifted, so that what was in line is so but for rounding.
void move(mesh::Mesh& mesh, double angle, double scale, Point shift) {
  for (mesh::Vertex& vertex : mesh.vertices) vertex.at = shift + turned(scale * vertex.at, angle);
}

void judge_worlds(WorldKind kind, double angle, Judge& judge) {
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const GridWorld world = grid_world(kind, seed);
    mesh::Mesh mesh = mesh::join(world.polygons(seed), 1.0);
    const double scale = angle == 0.0 ? 0.05 : 0.37;
    const Point shift = angle == 0.0 ? Point{} : Point{-211.3, 93.1};
    move(mesh, angle, scale, shift);
    VisibilityGraph graph(mesh);
    std::mt19937 random(seed);
    const auto somewhere = [&] {
      for (;;) {
        const Point point = shift + turned(scale * world.somewhere(random), angle);
        if (!on_non_manifold_vertex(mesh, point)) return *place_of(mesh, point);
      }
    };
    for (int i = 0; i < kQueries; ++i) {
      const Query query{somewhere(), somewhere()};
      judge.judge(mesh, query, graph);
      if (testing::Test::HasFailure()) return;
    }
  }
}

class Worlds : public testing::TestWithParam<WorldKind> {};

TEST_P(Worlds, have_no_shorter_path_than_the_exact_one) {
  for (const double angle : {0.0, 0.4}) {  // turned, walls in line are so but for rounding
    SCOPED_TRACE(angle);
    Judge judge;
    judge_worlds(GetParam(), angle, judge);
    EXPECT_GT(judge.answered, kSeeds * kQueries / 4);
    if (GetParam() == WorldKind::crumbs) {
      EXPECT_GT(judge.unreachable, 10);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Worlds,
                         testing::Values(WorldKind::warehouse, WorldKind::clutter, WorldKind::maze,
                                         WorldKind::crumbs));

TEST(Search, finds_the_shortest_path_when_holes_have_just_moved) {
  Judge judge;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const GridWorld world = grid_world(static_cast<WorldKind>(seed % 4), seed);
    mesh::CutMesh cut(world.polygons(seed), 0.5);
    std::mt19937 random(seed);
    std::vector<int> holes;
    for (int round = 0; round < 4; ++round) {
      for (const int hole : holes) cut.remove(hole);
      holes.clear();
      for (int i = 0; i < 5 && round < 3; ++i)
        // Some just touch a wall, with their centre on it or in a corner.
        holes.push_back(cut.add(0.5 * world.somewhere(random),
                                0.1 + 0.05 * static_cast<double>(random() % 8),
                                8 + static_cast<int>(random() % 9)));
      cut.update();
      const mesh::Mesh& mesh = cut.mesh();
      VisibilityGraph graph(mesh);
      for (int i = 0; i < 6; ++i) {
        const std::optional<Query> query = draw_query(mesh, world, random);
        if (!query) continue;
        judge.judge(mesh, *query, graph);
        if (HasFailure()) return;
      }
    }
  }
  EXPECT_GT(judge.answered, 1000);
}

TEST(Search, keeps_the_sides_of_a_non_manifold_vertex_apart) {
  struct Case {
    WorldKind kind;
    int holes;
    std::vector<std::uint32_t> seeds;
  };
  Judge judge;
  for (const Case& c :
       {Case{WorldKind::crumbs, 5, {2113, 2409, 5979, 6283, 7511, 8207, 8399, 8455, 11769, 12091}},
        Case{WorldKind::splinters, 12, {3915, 4977}}}) {
    for (const std::uint32_t seed : c.seeds) {
      SCOPED_TRACE(seed);
      const GridWorld world = grid_world(c.kind, seed);
      mesh::CutMesh cut(world.polygons(seed), 0.5);
      std::mt19937 random(seed);
      for (int i = 0; i < c.holes; ++i) {
        const Point at = 0.5 * world.somewhere(random);
        cut.add(at, 0.1 + 0.05 * static_cast<double>(random() % 8), 8);
      }
      cut.update();
      const mesh::Mesh& mesh = cut.mesh();
      VisibilityGraph graph(mesh);
      for (int i = 0; i < 200; ++i) {
        const std::optional<Query> query = draw_query(mesh, world, random);
        if (!query) continue;
        judge.judge(mesh, *query, graph);
        if (HasFailure()) return;
      }
    }
  }
  EXPECT_GT(judge.answered, 500);
}

TEST(Search, keeps_one_of_equal_routes_whose_turns_lie_in_line_with_another) {
  struct Case {
    WorldKind kind;
    std::uint32_t seed;
    Point start, goal;
  };
  Judge judge;
  for (const Case& c : {Case{WorldKind::maze, 604, {15.75, 12}, {4.5, 1.75}},
                        Case{WorldKind::clutter, 5520, {2, 1}, {14, 7}}}) {
    const mesh::Mesh mesh = mesh::join(grid_world(c.kind, c.seed).polygons(c.seed), 1.0);
    VisibilityGraph graph(mesh);
    judge.judge(mesh, {*place_of(mesh, c.start), *place_of(mesh, c.goal)}, graph);
  }
  EXPECT_EQ(judge.answered, 2);
}

TEST(Search, stays_where_it_is_if_the_start_is_the_goal) {
  const mesh::Mesh mesh = mesh::join({{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}}}, 1.0);
  for (const SearchMethod method : {SearchMethod::exact, SearchMethod::centroid_astar}) {
    Search search(method);
    for (const Point point : {Point{1, 1}, Point{0, 0}, Point{2, 1}}) {
      const Found& found = search.find(mesh, {0, point}, {0, point});
      EXPECT_TRUE(found.found);
      EXPECT_EQ(found.path, Path{point});
      EXPECT_EQ(length_of(found.path), 0.0);
    }
  }
}

TEST(Search, expands_few_nodes_where_very_many_routes_are_equally_long) {
  // Ten by ten blocks: 184756 shortest routes from corner to corner.
  GridWorld world(31, 31);
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) world.fill(1 + 3 * i, 1 + 3 * j, 2, 2);
  }
  const mesh::Mesh mesh = mesh::join(world.polygons(0), 1.0);
  Search search(SearchMethod::exact);
  const Found& found =
      search.find(mesh, *place_of(mesh, {0.5, 0.5}), *place_of(mesh, {30.5, 30.5}));
  ASSERT_TRUE(found.found);
  EXPECT_LT(found.nodes_expanded, 4000U);
}

TEST(Search, allocates_nothing_in_a_query_that_it_has_answered_before) {
  const GridWorld world = grid_world(WorldKind::warehouse, 3);
  const mesh::Mesh mesh = mesh::join(world.polygons(3), 1.0);
  Search search(SearchMethod::exact);
  std::mt19937 random(1);
  std::vector<Query> queries;
  for (int i = 0; i < 20; ++i)
    queries.push_back(
        {*place_of(mesh, world.somewhere(random)), *place_of(mesh, world.somewhere(random))});
  for (int round = 0; round < 2; ++round) {
    for (const Query& query : queries) search.find(mesh, query.start, query.goal);
  }
  const std::size_t before = allocations();
  for (const Query& query : queries) search.find(mesh, query.start, query.goal);
  EXPECT_EQ(allocations(), before);
  mesh::CutMesh cut(world.polygons(3), 1.0);
  cut.add(world.somewhere(random), 0.4, 8);
  cut.update();
  Search among_holes(SearchMethod::exact);
  queries.clear();
  while (queries.size() < 20) {
    const auto start = place_of(cut.mesh(), world.somewhere(random));
    const auto goal = place_of(cut.mesh(), world.somewhere(random));
    if (start && goal) queries.push_back({*start, *goal});
  }
  for (const Query& query : queries) among_holes.find(cut.mesh(), query.start, query.goal);
  const std::size_t asked = allocations();
  for (const Query& query : queries) among_holes.find(cut.mesh(), query.start, query.goal);
  EXPECT_EQ(allocations(), asked);
  Search other(SearchMethod::exact);
  other.find(mesh, queries[0].start, queries[0].goal);
  EXPECT_GT(allocations(), asked);  // they are counted
}

}  // namespace
}  // namespace navvi_nav::search
