#include "plan/planner.hpp"

#include <exception>
#include <utility>

#include "plan/kept_bake.hpp"
#include "plan/retreat.hpp"

namespace navvi_nav::plan {
namespace {

std::vector<Cylinder> joined(std::vector<Cylinder> a, const std::vector<Cylinder>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// True if the path might be found without obstacles.
bool may_be_closed(const Plan& plan) {
  return plan.status == PlanStatus::no_route || plan.status == PlanStatus::off_mesh;
}

}  // namespace

void PlannerConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit.group("mesh", mesh);
  visit.group("smoothing", smoothing);
  visit(search, "search", navvi_config::OneOf{{"exact", "centroid_astar"}}, "",
        "the shortest path, or the paper's (R-NAV-6, R-NAV-7)");
  visit(alpha, "alpha", Range{0.0, 1.0}, "", "weight of centroid_astar's heuristic (R-NAV-6)");
}

Planner::Planner(const PlannerConfig& config, const navvi_files::Cache* cache)
    : config_(config),
      cache_(cache),
      nav_mesh_(config.mesh, config.smoothing.cost.preferred_clearance),
      search_(config.search == "exact" ? search::SearchMethod::exact
                                       : search::SearchMethod::centroid_astar,
              config.alpha),
      guide_paths_(config.smoothing) {}

PlanAnswer Planner::answer(const PlanRequest& request, bake::BakedMap baked) {
  PlanAnswer out;
  try {
    if (request.brings_map()) out.mesh = nav_mesh_.take(std::move(baked));
    out.map_error = out.mesh.error;
    out.map_taken = request.brings_map() && out.map_error.empty();
    uncarved_ = joined(request.obstacles, request.predicted);
    // Holes that wait until things have moved enough must see each move; others, the last.
    const bool waits = config_.mesh.carve_changed > 0.0 || config_.mesh.carve_moved > 0.0;
    if (request.show_mesh || waits) carve_latest();
    if (request.goal) out.plan = best_plan(request);
  } catch (const std::exception& error) {
    if (request.brings_map()) out.map_error = error.what();
    if (request.goal) out.plan = no_plan(PlanStatus::no_route, error.what());
  }
  if (request.show_mesh) out.navmesh = nav_mesh_.shared_mesh();
  out.polygons = nav_mesh_.mesh().polygons.size();
  out.floor = nav_mesh_.shared_floor();
  return out;
}

bake::BakedMap Planner::bake(const PlanRequest& request) const {
  bake::BakedMap failed;
  try {
    if (request.grid) return nav_mesh_.bake(*request.grid);
    if (!request.map) return {};
    const map::MapBytes map{request.map->data.data(), request.map->data.size(), request.map->binary,
                            request.map->id, request.map->resolution};
    if (cache_ != nullptr && nav_mesh_.empty())
      return kept_bake(nav_mesh_, map, request.stands_at, *cache_);
    return nav_mesh_.bake(map, request.stands_at);
  } catch (const std::exception& error) {
    failed.error = error.what();
  }
  return failed;
}

Plan Planner::plan(Point start, Point goal, const Path& followed, bool toward) {
  carve_latest();
  RouteFinder here = routes();
  return guide_paths_.plan(
      toward ? here.find_toward(start, goal, followed) : here.find(start, goal), followed,
      nav_mesh_, search_);
}

Plan Planner::retreat(const std::vector<Cylinder>& swept_area, Point start) {
  RouteFinder here = routes();
  return guide_paths_.plan(find_retreat(here, swept_area, start), {}, nav_mesh_, search_);
}

void Planner::carve_latest() {
  if (const auto latest = std::exchange(uncarved_, std::nullopt)) carve(*latest);
}

/// A path, or what may be done where obstacles close it.
Plan Planner::best_plan(const PlanRequest& request) {
  Plan out = clear_plan(request);
  if (may_be_closed(out)) out = plan_without_obstacles(request, out);
  if (out.status != PlanStatus::closed || request.swept_area.empty()) return out;
  Plan out_of_it = retreat(request.swept_area, request.start);
  return out_of_it.status == PlanStatus::retreat ? out_of_it : out;
}

/// Clear of where the obstacles will be, or else of where they are: these are carved then.
Plan Planner::clear_plan(const PlanRequest& request) {
  Plan out = plan(request);
  if (out.status == PlanStatus::found || request.predicted.empty()) return out;
  carve(request.obstacles);
  return plan(request);
}

/// A closed plan, or why there is none without obstacles either.
Plan Planner::plan_without_obstacles(const PlanRequest& request, const Plan& blocked) {
  carve({});
  Plan out = plan(request);
  carve(request.obstacles);
  if (out.status != PlanStatus::found) return out;
  out.status = PlanStatus::closed;
  out.detail = blocked.detail;
  return out;
}

}  // namespace navvi_nav::plan
