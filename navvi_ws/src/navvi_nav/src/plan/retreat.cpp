#include "plan/retreat.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "plan/escape.hpp"

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

}  // namespace navvi_nav::plan
