#include "plan/planner.hpp"

#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "plan/escape.hpp"
#include "plan/kept_bake.hpp"

namespace navvi_nav::plan {
namespace {

constexpr double kStep = 0.5;       // m, between rings of places
constexpr double kFarthest = 12.0;  // m, as the crow flies
constexpr double kSpare = 0.2;      // m, that a robot keeps from the area it leaves
constexpr int kDirections = 16;
constexpr int kSearches = 200;

/// Tries places on rings round the start, until no ring farther out can be nearer.
/// \param spare  m, kept from the swept area
std::optional<Route> nearest_outside(RouteFinder& routes, const map::Space& swept, Point start,
                                     double spare) {
  const mesh::Mesh& mesh = routes.nav_mesh().mesh();
  const double clear = routes.nav_mesh().config().robot_radius + spare;
  std::optional<Route> best;
  double shortest = std::numeric_limits<double>::infinity();
  int searches = 0;
  for (double reach = kStep; reach <= kFarthest && searches < kSearches; reach += kStep) {
    if (reach >= shortest) break;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2.0 * kPi * i / kDirections;
      const Point place = start + reach * Point{std::cos(angle), std::sin(angle)};
      const std::optional<mesh::Mesh::Place> there = mesh.locate(place, 0.0);
      if (!there || in_a_hole(place, swept, clear)) continue;
      const Anchor from = routes.begin(start, place, mesh.polygon(there->polygon).component);
      if (!from.place) continue;
      ++searches;
      Route route = routes.between(from, *there, start, there->point);
      const double length = length_of(route.plan.path);
      if (route.plan.status != PlanStatus::found || length >= shortest) continue;
      best = std::move(route);
      shortest = length;
    }
  }
  return best;
}

std::vector<Cylinder> joined(std::vector<Cylinder> a, const std::vector<Cylinder>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// True if the path might be found without obstacles.
bool may_be_closed(const Plan& plan) {
  return plan.status == PlanStatus::no_route || plan.status == PlanStatus::off_mesh;
}

}  // namespace

Route find_retreat(RouteFinder& routes, const std::vector<Cylinder>& swept_area, Point start) {
  const map::Space swept{routes.nav_mesh().shared_floor().get(), &swept_area};
  for (const double spare : {kSpare, 0.0}) {
    std::optional<Route> route = nearest_outside(routes, swept, start, spare);
    if (!route) continue;
    route->plan.status = PlanStatus::retreat;
    return *std::move(route);
  }
  return {no_plan(PlanStatus::no_route, "there is no room to be made")};
}

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
    // Holes that wait until enough has changed must see each move; others, the last.
    if (request.show_mesh || config_.mesh.carve_changed > 0.0) carve_latest();
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
    const MapMessage& map = *request.map;
    if (map.voxels && cache_ != nullptr && nav_mesh_.empty() && nav_mesh_.zones().empty())
      return kept_bake(nav_mesh_, *map.voxels, request.stands_at, *cache_);
    if (map.voxels) return nav_mesh_.bake(*map.voxels, request.stands_at);
    return nav_mesh_.bake({map.data.data(), map.data.size(), map.binary, map.id, map.resolution},
                          request.stands_at);
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
