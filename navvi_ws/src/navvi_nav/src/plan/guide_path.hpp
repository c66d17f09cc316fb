#pragma once

#include "plan/nav_mesh.hpp"
#include "plan/plan_request.hpp"
#include "plan/route.hpp"
#include "search/search.hpp"
#include "smooth/smoothing.hpp"

namespace navvi_nav::plan {

/// Makes the paths that a person follows of the shortest ones (R-NAV-13).
class GuidePaths {
 public:
  explicit GuidePaths(const smooth::SmoothingConfig& config)
      : config_(config), smoother_(config.attempts) {}

  /// The plan of a route with its guide path from end to end. The straight leg of an escape stays
  /// as it is; another is drawn on to the next corner where that keeps the radius, or as much room
  /// as the robot has.
  /// \param followed  as PlanRequest's \param search  on the mesh on which the route was found
  [[nodiscard]] Plan plan(Route route, const Path& followed, const NavMesh& nav_mesh,
                          search::Search& search) const;

 private:
  smooth::SmoothingConfig config_;
  smooth::Smoother smoother_;
};

}  // namespace navvi_nav::plan
