#include "plan/route.hpp"

#include <algorithm>
#include <set>

#include "plan/escape.hpp"

namespace navvi_nav::plan {
namespace {

constexpr double kLatticeError = 4.0;  // cells, of a mesh's border besides contour_error
constexpr double kSameEnd = 0.5;       // m, by which another end must be nearer to the goal
constexpr double kOnFloor = 1e-3;      // m, from the end of a path that was found to the floor

const char* sentence_of(Guidance::Refusal refusal) {
  switch (refusal) {
    case Guidance::Refusal::not_finite:
      return "the goal is not a finite point";
    case Guidance::Refusal::off_the_map:
      return "the map shows no floor at the goal";
    case Guidance::Refusal::not_seen:
      return "the map does not show yet all that is within the robot's radius of the goal";
    case Guidance::Refusal::unreachable:
      return "no floor joins the goal with the robot";
    default:
      return "the goal is within the robot's radius of an obstacle or a closed zone";
  }
}

bool beyond_the_map(Guidance::Refusal refusal) {
  return refusal == Guidance::Refusal::not_seen || refusal == Guidance::Refusal::off_the_map;
}

bool share(const std::set<int>& a, const std::set<int>& b) {
  return std::any_of(a.begin(), a.end(), [&b](int item) { return b.count(item) > 0; });
}

/// Some of what is within the distance of the point, in m, is known to be an obstacle.
bool obstacle_within(const map::Floor& floor, Point point, double distance) {
  const map::Cell low = floor.cell_at({point.x - distance, point.y - distance});
  const map::Cell high = floor.cell_at({point.x + distance, point.y + distance});
  const double size = floor.cell_size();
  const auto off = [size](double at, int cell) {
    return std::max({0.0, cell * size - at, at - (cell + 1) * size});
  };
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      if (floor.ground({x, y}) == map::Ground::obstacle &&
          navvi_floor::norm({off(point.x, x), off(point.y, y)}) < distance)
        return true;
  return false;
}

}  // namespace

Route RouteFinder::find(Point start, Point goal) {
  if (nav_mesh_.empty()) return {no_plan(PlanStatus::no_map, "there is no map yet")};
  if (const std::optional<Plan> no = refused(start, goal)) return {*no};
  return find_on_floor(start, goal, true);
}

Route RouteFinder::find_toward(Point start, Point goal, const Path& followed) {
  if (nav_mesh_.empty()) return find(start, goal);
  const std::optional<Plan> no = refused(start, goal);
  if (!no || !beyond_the_map(no->refusal)) return find(start, goal);
  const std::set<int> here = nav_mesh_.floor_components(start, start_snap_);
  std::optional<Point> end = nav_mesh_.nearest_on_floor(goal, here);
  if (end && !followed.empty()) {
    const Point last = followed.back();
    const std::optional<Point> still = nav_mesh_.nearest_on_floor(last, here);
    const bool serves = still && distance(*still, last) <= kOnFloor;
    if (serves && distance(last, goal) - distance(*end, goal) < kSameEnd) end = last;
  }
  Route out = end ? find_on_floor(start, *end, false)
                  : Route{no_plan(PlanStatus::off_mesh, "the robot stands off the floor")};
  out.plan.ends_short = true;
  out.plan.refusal = no->refusal;
  if (out.plan.detail.empty()) out.plan.detail = no->detail;
  return out;
}

/// \param exactly  to the goal; else to what of the mesh is nearest to the place where the map ends
Route RouteFinder::find_on_floor(Point start, Point end, bool exactly) {
  if (!begin(start, end, std::nullopt).place)
    return {no_plan(PlanStatus::off_mesh, "the robot stands where no path can begin")};
  const std::string what = exactly ? "the goal" : "the end of the map";
  const Anchor to = anchor(end, near_goal(), std::nullopt);
  if (!to.place || (exactly && !to.joined))
    return {no_plan(PlanStatus::no_route, "a moving thing stands on " + what)};
  const Anchor from = begin(start, end, nav_mesh_.mesh().polygon(to.place->polygon).component);
  if (!from.place)
    return {no_plan(PlanStatus::no_route, "nothing joins the robot with " + what + " now")};
  return between(from, *to.place, start, exactly ? end : to.place->point);
}

Route RouteFinder::between(const Anchor& from, const mesh::Mesh::Place& to, Point start,
                           Point goal) {
  const search::Found& found = search_.find(nav_mesh_.mesh(), *from.place, to);
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

std::optional<Plan> RouteFinder::refused(Point start, Point goal) const {
  Guidance::Refusal refusal = refusal_of(goal);
  if (refusal == Guidance::Refusal::none) refusal = not_joined(start, goal);
  if (refusal == Guidance::Refusal::none) return std::nullopt;
  return no_plan(PlanStatus::refused, sentence_of(refusal), refusal);
}

Guidance::Refusal RouteFinder::refusal_of(Point goal) const {
  if (!finite(goal)) return Guidance::Refusal::not_finite;
  const map::Floor& floor = *nav_mesh_.shared_floor();
  const map::Cell cell = floor.cell_at(goal);
  if (!floor.area().contains(cell)) return Guidance::Refusal::off_the_map;
  if (floor.ground(cell) == map::Ground::none) return Guidance::Refusal::not_seen;
  if (!floor.segment_clear(goal, goal, radius())) return too_near(goal, radius());
  return Guidance::Refusal::none;
}

Guidance::Refusal RouteFinder::not_joined(Point start, Point goal) const {
  const std::set<int> at_goal = nav_mesh_.floor_components(goal, near_goal());
  const std::set<int> at_start = nav_mesh_.floor_components(start, start_snap_);
  if (at_goal.empty()) return too_near(goal, radius() + near_goal());
  if (!at_start.empty() && !share(at_start, at_goal)) return Guidance::Refusal::unreachable;
  return Guidance::Refusal::none;
}

/// Of a goal that something within the distance, in m, keeps the robot from.
Guidance::Refusal RouteFinder::too_near(Point goal, double distance) const {
  return obstacle_within(*nav_mesh_.shared_floor(), goal, distance)
             ? Guidance::Refusal::inside_obstacle
             : Guidance::Refusal::not_seen;
}

double RouteFinder::near_goal() const {
  return (nav_mesh_.config().contour_error + kLatticeError) * nav_mesh_.shared_floor()->cell_size();
}

Anchor RouteFinder::anchor(Point point, double within, std::optional<int> part) const {
  Anchor out;
  out.place = nav_mesh_.mesh().locate(point, within, part);
  if (out.place) out.joined = nav_mesh_.space().segment_clear(point, out.place->point, radius());
  return out;
}

Anchor RouteFinder::begin(Point start, Point goal, std::optional<int> part) const {
  if (!in_a_hole(start, nav_mesh_.space(), radius())) return anchor(start, start_snap_, part);
  Anchor out;
  out.place = escape(nav_mesh_.mesh(), nav_mesh_.space(), start, radius(), part, goal);
  out.joined = out.leaves_hole = out.place.has_value();
  return out;
}

}  // namespace navvi_nav::plan
