#include "contestant.hpp"

#include <memory>
#include <utility>

#include "search/search.hpp"

namespace navvi_nav::bench {
namespace {

Contestant on(const std::string& name, const mesh::Mesh& mesh, search::SearchMethod method) {
  struct State {
    search::Search search;
    mesh::Mesh::Place from, to;
  };
  const auto state = std::make_shared<State>(State{search::Search(method), {}, {}});
  return {name,
          [&mesh, state](const Query& query) {
            const auto from = mesh.locate(query.start, Course::kNear);
            const auto to = mesh.locate(query.goal, Course::kNear);
            if (!from || !to) return false;
            state->from = *from;
            state->to = *to;
            return true;
          },
          [&mesh, state] { return state->search.find(mesh, state->from, state->to).path; }};
}

}  // namespace

std::vector<Contestant> contestants(Course& course) {
  const mesh::Mesh& ours = course.ours.nav_mesh().mesh();
  const mesh::Mesh& detours = course.detours_mesh;
  return {
      on("exact, our mesh", ours, search::SearchMethod::exact),
      on("centroids and funnel, our mesh", ours, search::SearchMethod::centroid_astar),
      on("exact, Detour's polygons", detours, search::SearchMethod::exact),
      on("centroids and funnel, Detour's polygons", detours, search::SearchMethod::centroid_astar),
      {"Detour", [&course](const Query& q) { return course.detour_query.locate(q.start, q.goal); },
       [&course] { return course.detour_query.search(); }},
  };
}

std::vector<Contestant> among_discs(Course& course) {
  Contestant ours =
      on("exact, our mesh", course.carved.nav_mesh().mesh(), search::SearchMethod::exact);
  ours.place = [&course](const std::vector<Cylinder>& discs) { course.carved.carve(discs); };
  return {
      ours,
      {"Detour, TileCache's mesh",
       [&course](const Query& q) { return course.tile_cache_query->locate(q.start, q.goal); },
       [&course] { return course.tile_cache_query->search(); },
       [&course](const std::vector<Cylinder>& discs) { course.tile_cache->place(discs); }},
  };
}

}  // namespace navvi_nav::bench
