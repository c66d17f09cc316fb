#include "plan/guide_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace navvi_nav::plan {
namespace {

constexpr double kSlack = 0.02;    // m, of room that a start off the mesh need not keep
constexpr double kSameGoal = 0.5;  // m, a path that ends so near leads to the same goal
constexpr double kOnMesh = 1e-3;   // m, from a corner of a path on the mesh to the mesh
constexpr double kNode = 1.2;      // m, of legs measured in the time that a node takes
constexpr double kSpared = 5.0;  // one such part of all work is left, however long the search took
constexpr double kSearched = 0.85;      // of the work that is left, for another search at most
constexpr double kSearchedTurn = 0.75;  // of a turn by 90 degrees: what searches charge for each
constexpr double kSketch = 0.5;         // of the work that is left, for the sketch of a path
constexpr double kRefine = 0.7;         // likewise, to refine it if a known path comes after it

/// The work that one guide path may take, in metres of legs that are measured: not in seconds, so
/// that equal input gives equal output.
class Budget {
 public:
  /// \param nodes  expanded for the shortest path
  Budget(double all, std::size_t nodes)
      : first_(kNode * static_cast<double>(nodes)), left_(std::max(all - first_, all / kSpared)) {}

  /// A search at other prices hardly ever expands fewer nodes than the one for the shortest path.
  [[nodiscard]] bool affords_search() const { return kSearched * left_ >= first_; }
  /// Most nodes that a search may expand.
  [[nodiscard]] std::size_t nodes() const {
    return static_cast<std::size_t>(std::max(0.0, kSearched * left_ / kNode));
  }
  void searched(std::size_t nodes) { left_ -= kNode * static_cast<double>(nodes); }
  /// Lets `work` measure legs for a part of what is left. \returns what it made
  template <typename Work>
  Path spend(double part, const smooth::GuideCost& cost, const Work& work) {
    cost.allow(part * left_);
    Path out = work();
    left_ -= part * left_ - cost.left();
    return out;
  }

 private:
  double first_;  // m
  double left_;   // m
};

/// The cheapest for a person of the paths that were offered.
class Candidates {
 public:
  /// \param shortest  stands until a path is offered \param longest  m, that one may be
  Candidates(const smooth::GuideCost& cost, Path shortest, double longest)
      : cost_(cost), best_(std::move(shortest)), longest_(longest) {}

  /// \param path  may be empty: none \param gain  m, by which it may cost more than the best
  void offer(const Path& path, double gain = 0.0) {
    const double price = cost_.of(path) - gain;
    if (path.empty() || !(price < least_) || length_of(path) > longest_) return;
    best_ = path;
    least_ = price;
  }
  [[nodiscard]] const Path& best() const { return best_; }
  [[nodiscard]] double least() const { return least_; }  ///< m; infinite if none was taken

 private:
  const smooth::GuideCost& cost_;
  Path best_;
  double longest_;
  double least_ = std::numeric_limits<double>::infinity();
};

double longest_of(const smooth::SmoothingConfig& config, double shortest) {
  return std::max(config.kMaxStretch * shortest, shortest + config.kMaxDetour);
}

/// One guide path in the making.
class GuidePath {
 public:
  struct Tools {
    const smooth::SmoothingConfig& config;
    const smooth::Smoother& smoother;
    const smooth::GuideCost& cost;
    const mesh::Mesh& mesh;
    search::Search& search;
  };
  GuidePath(const Tools& tools, const Route& route)
      : tools_(tools),
        route_(route),
        budget_(tools.config.effort * length_of(route.plan.path), route.plan.nodes_expanded),
        candidates_(tools.cost, route.plan.path,
                    longest_of(tools.config, length_of(route.plan.path))) {}

  /// The cheapest of what smoothing makes of a path with few turns, or else of the shortest, of one
  /// that keeps out of slits, and of one that keeps the corners of `followed`.
  Path make(const Path& followed) {
    const smooth::GuideCostConfig& prices = tools_.config.cost;
    if (budget_.affords_search()) candidates_.offer(sketch_to(route_.to, 0.0));
    if (!std::isfinite(candidates_.least())) candidates_.offer(sketch(route_.plan.path));
    if (budget_.affords_search() && tools_.cost.tight(candidates_.best()) > prices.kTurnPrice)
      candidates_.offer(sketch_to(route_.to, 2.0 * prices.kTight));
    candidates_.offer(refined(candidates_.best(), followed.empty() ? 1.0 : kRefine));
    candidates_.offer(keeping(followed), tools_.config.kKeep);
    return candidates_.best();
  }

 private:
  Path sketch(const Path& path) {
    return budget_.spend(kSketch, tools_.cost,
                         [&] { return tools_.smoother.sketch(path, tools_.cost); });
  }
  Path refined(const Path& path, double part) {
    return budget_.spend(part, tools_.cost,
                         [&] { return tools_.smoother.refine(path, tools_.cost); });
  }
  /// Of a path with few turns. \param narrow  m, slits that it keeps out of
  Path sketch_to(const mesh::Mesh::Place& to, double narrow) {
    const double turn = tools_.config.cost.kTurnPrice * kSearchedTurn;
    const search::Found& found = tools_.search.find_at(
        {turn, narrow, candidates_.least(), budget_.nodes()}, tools_.mesh, route_.from, to);
    budget_.searched(found.nodes_expanded);
    return sketch(found.path);
  }
  /// A path that leads to the corners of `followed` that are still on the mesh; empty: none does.
  Path keeping(const Path& followed) {
    const Path known = tools_.cost.known_end(followed);
    const Path& best = candidates_.best();
    if (known.size() < 2 || distance(known.back(), best.back()) > kSameGoal) return {};
    Path out = way_to(known, followed);
    if (out.empty()) return {};
    out.insert(out.end(), known.begin() + 1, known.end());
    out.back() = best.back();
    return out;
  }
  Path way_to(const Path& known, const Path& followed) {
    const Point start = candidates_.best().front();
    const bool all =
        known.size() + 1 == followed.size() && std::isfinite(tools_.cost.leg(start, known.front()));
    const auto there = tools_.mesh.locate(known.front(), kOnMesh);
    if (all) return {start, known.front()};
    return there ? sketch_to(*there, 0.0) : Path{};
  }

  const Tools tools_;
  const Route& route_;
  Budget budget_;
  Candidates candidates_;
};

void join_start(const Route& route, const map::Space& space, double radius, Path& path) {
  const double own = std::min(radius, space.clearance(*route.start) - kSlack);
  if (!route.leaves_hole && path.size() > 1 && own > 0.0 &&
      space.segment_clear(*route.start, path[1], own))
    path.front() = *route.start;
  else
    path.insert(path.begin(), *route.start);
}

void join_goal(const Route& route, const map::Space& space, double radius, Path& path) {
  if (path.size() > 1 && space.segment_clear(path[path.size() - 2], *route.goal, radius))
    path.back() = *route.goal;
  else
    path.push_back(*route.goal);
}

}  // namespace

Plan GuidePaths::plan(Route route, const Path& followed, const NavMesh& nav_mesh,
                      search::Search& search) const {
  Plan& plan = route.plan;
  Path& path = plan.path;
  if (path.empty()) return plan;
  const map::Space space = nav_mesh.space();
  const double radius = nav_mesh.config().robot_radius;
  plan.shortest = length_of(path);
  if (config_.enabled) {
    const smooth::GuideCost cost(config_.cost, nav_mesh.mesh(), space, radius);
    path = GuidePath({config_, smoother_, cost, nav_mesh.mesh(), search}, route).make(followed);
  }
  if (route.start) {
    plan.shortest += distance(*route.start, path.front());
    join_start(route, space, radius, path);
  }
  if (route.goal) {
    plan.shortest += distance(path.back(), *route.goal);
    join_goal(route, space, radius, path);
  }
  return plan;
}

}  // namespace navvi_nav::plan
