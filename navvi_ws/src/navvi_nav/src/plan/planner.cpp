#include "plan/planner.hpp"

#include <exception>
#include <limits>
#include <utility>

#include "plan/escape.hpp"

namespace navvi_nav::plan {
namespace {

constexpr double kRetreatStep = 0.5;       // m
constexpr double kRetreatFarthest = 12.0;  // m, as the crow flies
constexpr double kRetreatSpare = 0.2;      // m, that a robot keeps from the area it leaves
constexpr int kRetreatDirections = 16;
constexpr int kRetreatSearches = 200;
constexpr double kSlack = 0.02;         // m, of room that a start off the mesh need not keep
constexpr double kSameGoal = 0.5;       // m, a path that ends so near leads to the same goal
constexpr double kOnMesh = 1e-3;        // m, from a corner of a path on the mesh to the mesh
constexpr double kNode = 1.2;           // m, of legs measured in the time that a node takes
constexpr double kSearched = 0.85;      // of the work that is left, for another search at most
constexpr double kSearchedTurn = 0.75;  // of a turn by 90 degrees: what searches charge for each

Plan failure(PlanStatus status, std::string detail,
             Guidance::Refusal refusal = Guidance::Refusal::none) {
  Plan plan;
  plan.status = status;
  plan.refusal = refusal;
  plan.detail = std::move(detail);
  return plan;
}

Plan refused(Guidance::Refusal refusal) {
  switch (refusal) {
    case Guidance::Refusal::not_finite:
      return failure(PlanStatus::refused, "the goal is not a finite point", refusal);
    case Guidance::Refusal::off_the_map:
      return failure(PlanStatus::refused, "the map shows no floor at the goal", refusal);
    case Guidance::Refusal::unreachable:
      return failure(PlanStatus::refused, "no floor joins the goal with the robot", refusal);
    default:
      return failure(PlanStatus::refused, "the goal is within the robot's radius of an obstacle",
                     refusal);
  }
}

std::vector<Cylinder> joined(std::vector<Cylinder> a, const std::vector<Cylinder>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// True if the path might be found without obstacles.
bool may_be_closed(const Plan& plan) {
  return plan.status == PlanStatus::no_route || plan.status == PlanStatus::off_mesh;
}

bool share(const std::set<int>& a, const std::set<int>& b) {
  return std::any_of(a.begin(), a.end(), [&b](int item) { return b.count(item) > 0; });
}

}  // namespace

/// Where a point meets the mesh, and whether the straight way there is clear.
struct Planner::Anchor {
  std::optional<mesh::Mesh::Place> place;
  bool joined = false;
  bool leaves_hole = false;
};

void PlannerConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit.group("mesh", mesh);
  visit.group("smoothing", smoothing);
  visit(search, "search", navvi_config::OneOf{{"exact", "centroid_astar"}}, "",
        "the shortest path, or the paper's (R-NAV-6, R-NAV-7)");
  visit(alpha, "alpha", Range{0.0, 1.0}, "", "weight of centroid_astar's heuristic (R-NAV-6)");
  visit(start_snap, "start_snap", Range{0.0, 2.0}, "m", "how far off the mesh the robot may stand");
}

Planner::Planner(const PlannerConfig& config)
    : config_(config),
      nav_mesh_(config.mesh),
      search_(config.search == "exact" ? search::SearchMethod::exact
                                       : search::SearchMethod::centroid_astar,
              config.alpha),
      smoother_(config.smoothing.attempts) {}

PlanAnswer Planner::answer(const PlanRequest& request, bake::BakedMap baked) {
  PlanAnswer out;
  try {
    if (request.brings_map()) out.mesh = nav_mesh_.take(std::move(baked));
    out.map_error = out.mesh.error;
    out.map_taken = request.brings_map() && out.map_error.empty();
    uncarved_ = joined(request.obstacles, request.predicted);
    // Holes that wait until things have moved enough must see each move; others, the last.
    const bool waits = config_.mesh.carve_changed > 0.0 || config_.mesh.carve_moved > 0.0;
    if (request.goal || request.show_mesh || waits) carve_latest();
    if (request.goal) {
      out.plan = plan(request);
      if (may_be_closed(*out.plan)) out.plan = plan_without_obstacles(request, *out.plan);
      if (out.plan->status == PlanStatus::closed && !request.swept_area.empty()) {
        const Plan out_of_it = retreat(request.swept_area, request.start);
        if (out_of_it.status == PlanStatus::retreat) out.plan = out_of_it;
      }
    }
  } catch (const std::exception& error) {
    if (request.brings_map()) out.map_error = error.what();
    if (request.goal) out.plan = failure(PlanStatus::no_route, error.what());
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
    return nav_mesh_.bake(
        map::MapBytes{map.data.data(), map.data.size(), map.binary, map.id, map.resolution},
        request.stands_at);
  } catch (const std::exception& error) {
    failed.error = error.what();
  }
  return failed;
}

void Planner::carve_latest() {
  if (const auto latest = std::exchange(uncarved_, std::nullopt)) carve(*latest);
}

/// Clear of where the obstacles will be, or else of where they are: these are carved then.
Plan Planner::plan(const PlanRequest& request) {
  Plan out = plan(request.start, *request.goal, request.followed);
  if (out.status == PlanStatus::found || request.predicted.empty()) return out;
  carve(request.obstacles);
  return plan(request.start, *request.goal, request.followed);
}

Planner::Route Planner::search(Point start, Point goal) const {
  if (nav_mesh_.empty()) return {failure(PlanStatus::no_map, "there is no map yet")};
  const Guidance::Refusal refusal = refusal_of(goal);
  if (refusal != Guidance::Refusal::none) return {refused(refusal)};
  const double cell = nav_mesh_.shared_floor()->cell_size();
  const double near_goal = (config_.mesh.contour_error + 4.0) * cell;
  const std::set<int> goal_parts = nav_mesh_.floor_components(goal, near_goal);
  const std::set<int> start_parts = nav_mesh_.floor_components(start, config_.start_snap);
  if (goal_parts.empty()) return {refused(Guidance::Refusal::inside_obstacle)};
  if (!start_parts.empty() && !share(start_parts, goal_parts))
    return {refused(Guidance::Refusal::unreachable)};

  if (!begin(start, goal, std::nullopt).place)
    return {failure(PlanStatus::off_mesh, "the robot stands where no path can begin")};
  const Anchor to = anchor(goal, near_goal, std::nullopt);
  if (!to.place || !to.joined)
    return {failure(PlanStatus::no_route, "a moving thing stands on the goal")};
  const int part = nav_mesh_.mesh().polygon(to.place->polygon).component;
  const Anchor from = begin(start, goal, part);
  if (!from.place)
    return {failure(PlanStatus::no_route, "nothing joins the robot with the goal now")};
  return route_of(search_.find(nav_mesh_.mesh(), *from.place, *to.place), from, *to.place, start,
                  goal);
}

/// The path found, and what joins it to the start and the goal.
Planner::Route Planner::route_of(const search::Found& found, const Anchor& from,
                                 const mesh::Mesh::Place& to, Point start, Point goal) {
  Route out;
  out.plan.nodes_expanded = found.nodes_expanded;
  out.plan.status = found.found ? PlanStatus::found : PlanStatus::no_route;
  if (!found.found) return out;
  out.plan.path = found.path;
  out.from = *from.place;
  out.to = to;
  if (from.joined && !(from.place->point == start)) out.start = start;
  if (!(to.point == goal)) out.goal = goal;
  out.leaves_hole = from.leaves_hole;
  return out;
}

/// A closed plan, or why there is none without obstacles either.
Plan Planner::plan_without_obstacles(const PlanRequest& request, const Plan& blocked) {
  carve({});
  Plan out = plan(request.start, *request.goal, request.followed);
  carve(request.obstacles);
  if (out.status != PlanStatus::found) return out;
  out.status = PlanStatus::closed;
  out.detail = blocked.detail;
  return out;
}

Planner::Route Planner::search_retreat(const std::vector<Cylinder>& swept_area, Point start) const {
  Route out = search_retreat(swept_area, start, kRetreatSpare);
  return out.plan.status == PlanStatus::retreat ? out : search_retreat(swept_area, start, 0.0);
}

Planner::Route Planner::search_retreat(const std::vector<Cylinder>& swept_area, Point start,
                                       double spare) const {
  const mesh::Mesh& mesh = nav_mesh_.mesh();
  const double radius = config_.mesh.robot_radius;
  const map::Space swept{nav_mesh_.shared_floor().get(), &swept_area};
  search::Found best;
  Anchor best_from;
  mesh::Mesh::Place best_to;
  int searches = 0;
  for (double reach = kRetreatStep; reach <= kRetreatFarthest && searches < kRetreatSearches;
       reach += kRetreatStep) {
    if (best.found && reach >= best.length) break;
    for (int i = 0; i < kRetreatDirections; ++i) {
      const double angle = 2.0 * M_PI * i / kRetreatDirections;
      const Point place = start + reach * Point{std::cos(angle), std::sin(angle)};
      const std::optional<mesh::Mesh::Place> there = mesh.locate(place, 0.0);
      if (!there || in_a_hole(place, swept, radius + spare)) continue;
      const Anchor from = begin(start, place, mesh.polygon(there->polygon).component);
      if (!from.place) continue;
      ++searches;
      const search::Found& found = search_.find(mesh, *from.place, *there);
      if (!found.found || (best.found && found.length >= best.length)) continue;
      best = found;
      best_from = from;
      best_to = *there;
    }
  }
  if (!best.found) return {failure(PlanStatus::no_route, "there is no room to be made")};
  Route out = route_of(best, best_from, best_to, start, best_to.point);
  out.plan.status = PlanStatus::retreat;
  return out;
}

/// The guide path of a route, with its ends. The straight leg of an escape stays as it is; another
/// is drawn on to the next corner where that keeps the radius, or as much room as the robot has.
Plan Planner::guided(Route route, const Path& followed) const {
  Plan& plan = route.plan;
  if (plan.path.empty()) return plan;
  plan.shortest = length_of(plan.path);
  if (config_.smoothing.enabled) plan.path = guide_path(route, followed);
  const map::Space space = nav_mesh_.space();
  const double radius = config_.mesh.robot_radius;
  Path& path = plan.path;
  if (route.start) {
    const double own = std::min(radius, space.clearance(*route.start) - kSlack);
    plan.shortest += distance(*route.start, path.front());
    if (!route.leaves_hole && path.size() > 1 && own > 0.0 &&
        space.segment_clear(*route.start, path[1], own))
      path.front() = *route.start;
    else
      path.insert(path.begin(), *route.start);
  }
  if (route.goal) {
    plan.shortest += distance(path.back(), *route.goal);
    if (path.size() > 1 && space.segment_clear(path[path.size() - 2], *route.goal, radius))
      path.back() = *route.goal;
    else
      path.push_back(*route.goal);
  }
  return plan;
}

/// The cheapest for a person of what smoothing makes of a path with few turns, or else of the
/// shortest, of one that keeps out of slits, and of one that keeps the corners of `followed`.
Path Planner::guide_path(const Route& route, const Path& followed) const {
  const smooth::SmoothingConfig& config = config_.smoothing;
  const double shortest = length_of(route.plan.path);
  const double longest = std::max(config.max_stretch * shortest, shortest + config.max_detour);
  const smooth::GuideCost cost(config.cost, nav_mesh_.mesh(), nav_mesh_.space(),
                               config_.mesh.robot_radius, config_.mesh.preferred_clearance);
  const double all_work = config.effort * shortest;  // m
  double work =
      std::max(all_work - kNode * static_cast<double>(route.plan.nodes_expanded), all_work / 5.0);
  const auto with = [&](double part, const auto& run) {  // of the work that is left
    cost.allow(part * work);
    Path out = run();
    work -= part * work - cost.left();
    return out;
  };
  Path best = route.plan.path;
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Path& path, double gain) {
    const double price = cost.of(path) - gain;
    if (path.empty() || !(price < least) || length_of(path) > longest) return;
    best = path;
    least = price;
  };
  const auto lead_to = [&](const mesh::Mesh::Place& to, double narrow) {
    const auto nodes = static_cast<std::size_t>(std::max(0.0, kSearched * work / kNode));
    const search::Found& found =
        search_.find_at({config.cost.turn_price * kSearchedTurn, narrow, least, nodes},
                        nav_mesh_.mesh(), route.from, to);
    work -= kNode * static_cast<double>(found.nodes_expanded);
    return with(0.5, [&] { return smoother_.sketch(found.path, cost); });
  };
  // A search at other prices hardly ever expands fewer nodes than the one for the shortest path.
  const auto affords = [&] {
    return kSearched * work >= kNode * static_cast<double>(route.plan.nodes_expanded);
  };
  if (affords()) offer(lead_to(route.to, 0.0), 0.0);
  if (!std::isfinite(least))
    offer(with(0.5, [&] { return smoother_.sketch(route.plan.path, cost); }), 0.0);
  if (affords() && cost.tight(best) > config.cost.turn_price)
    offer(lead_to(route.to, 2.0 * config.cost.tight), 0.0);
  offer(with(followed.empty() ? 1.0 : 0.7, [&] { return smoother_.refine(best, cost); }), 0.0);
  const Path known = cost.known_end(followed);
  if (known.size() < 2 || distance(known.back(), best.back()) > kSameGoal) return best;
  const bool all =
      known.size() + 1 == followed.size() && std::isfinite(cost.leg(best.front(), known.front()));
  const auto there = nav_mesh_.mesh().locate(known.front(), kOnMesh);
  Path kept = all ? Path{best.front(), known.front()} : there ? lead_to(*there, 0.0) : Path{};
  if (kept.empty()) return best;
  kept.insert(kept.end(), known.begin() + 1, known.end());
  kept.back() = best.back();
  offer(kept, config.keep);
  return best;
}

Plan Planner::plan_near(Point start, Point goal, double tolerance) {
  carve_latest();
  Plan exact = plan(start, goal);
  const bool about_the_goal =
      exact.status == PlanStatus::no_route || (exact.status == PlanStatus::refused && finite(goal));
  if (!about_the_goal || !(tolerance > 0.0)) return exact;
  constexpr int kMost = 10;
  const double step =
      std::min(tolerance, std::max(tolerance / kMost, 3.0 * nav_mesh_.shared_floor()->cell_size()));
  const int steps = std::min(kMost, static_cast<int>(tolerance / step + 1e-6));
  std::vector<Point> places;
  for (int y = -steps; y <= steps; ++y) {
    for (int x = -steps; x <= steps; ++x) {
      if (x != 0 || y != 0) places.push_back(goal + Point{x * step, y * step});
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [goal](Point a, Point b) { return distance(a, goal) < distance(b, goal); });
  for (const Point place : places) {
    Plan near = plan(start, place);
    if (near.status == PlanStatus::found) return near;
  }
  return exact;
}

Guidance::Refusal Planner::refusal_of(Point goal) const {
  if (!finite(goal)) return Guidance::Refusal::not_finite;
  const map::Floor& floor = *nav_mesh_.shared_floor();
  if (floor.ground(floor.cell_at(goal)) == map::Ground::none) return Guidance::Refusal::off_the_map;
  if (!floor.segment_clear(goal, goal, config_.mesh.robot_radius))
    return Guidance::Refusal::inside_obstacle;
  return Guidance::Refusal::none;
}

Planner::Anchor Planner::anchor(Point point, double within, std::optional<int> part) const {
  Anchor out;
  out.place = nav_mesh_.mesh().locate(point, within, part);
  if (out.place)
    out.joined =
        nav_mesh_.space().segment_clear(point, out.place->point, config_.mesh.robot_radius);
  return out;
}

/// Where a path from `start` begins.
Planner::Anchor Planner::begin(Point start, Point goal, std::optional<int> part) const {
  const double radius = config_.mesh.robot_radius;
  if (!in_a_hole(start, nav_mesh_.space(), radius)) return anchor(start, config_.start_snap, part);
  Anchor out;
  out.place = escape(nav_mesh_.mesh(), nav_mesh_.space(), start, radius, part, goal);
  out.joined = out.leaves_hole = out.place.has_value();
  return out;
}

}  // namespace navvi_nav::plan
