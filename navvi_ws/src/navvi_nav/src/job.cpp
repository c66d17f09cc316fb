#include "navvi_nav/job.hpp"

#include <exception>

namespace navvi_nav {

Outcome work(Planner& planner, const Job& job) {
  Outcome out;
  out.reason = job.reason;
  out.goal_number = job.goal_number;
  const bool map_came = job.map || job.grid;
  try {
    if (job.map) {
      out.mesh = planner.set_map(MapBytes{job.map->data.data(), job.map->data.size(),
                                          job.map->binary, job.map->id, job.map->resolution});
    } else if (job.grid) {
      out.mesh = planner.set_map(*job.grid);
    }
    out.map_error = out.mesh.error;
    out.map_taken = map_came && out.mesh.error.empty();
    std::vector<Cylinder> all = job.obstacles;
    all.insert(all.end(), job.foreseen.begin(), job.foreseen.end());
    out.carved = planner.carve(all);
    if (job.goal && !job.foreseen.empty()) {
      out.plan = planner.plan(job.start, *job.goal);
      if (out.plan->status != PlanStatus::found) out.carved = planner.carve(job.obstacles);
    }
    if (job.goal && (!out.plan || out.plan->status != PlanStatus::found))
      out.plan = planner.plan_among(job.obstacles, job.start, *job.goal);
    if (out.plan && out.plan->status == PlanStatus::closed && !job.ground.empty()) {
      Plan aside = planner.plan_aside(job.ground, job.start);
      if (aside.status == PlanStatus::aside) out.plan = std::move(aside);
    }
  } catch (const std::exception& error) {
    if (map_came) out.map_error = error.what();
    if (job.goal) {
      out.plan = Plan{};
      out.plan->status = PlanStatus::no_route;
      out.plan->detail = error.what();
    }
  }
  out.polygons = planner.nav_mesh().mesh().polygons.size();
  if (job.show_mesh) out.navmesh = planner.nav_mesh().shared_mesh();
  out.floor = planner.nav_mesh().shared_floor();
  return out;
}

}  // namespace navvi_nav
