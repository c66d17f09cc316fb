#include "navvi_sim/scenario/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "description/footprint.hpp"
#include "description/sentence.hpp"
#include "scenario/free_places.hpp"

namespace navvi_sim::scenario {
namespace {

constexpr int kAttempts = 20;
constexpr double kUsualRoute = 10.0;  // m
constexpr double kLeastRoute = 5.0;   // m; less is hardly a trial
constexpr double kNoRoute = 1.0;      // m; a robot has arrived there as it starts
constexpr double kSpot = 0.01;        // m
constexpr double kLookAhead = 2.0;    // m along the route, to which a drawn start looks

double length(const FloorWays::Ways& ways, std::size_t cell) {
  return static_cast<double>(ways.length[cell]);
}

/// The name of the smallest thing with a shape over `at` and between two heights in map.
std::string thing_at(const WorldDescription& world, const Eigen::Vector2d& at, double low,
                     double high) {
  std::string name;
  double smallest = std::numeric_limits<double>::max();
  const Polygon spot{
      {at.x() - kSpot, at.y() - kSpot}, {at.x() + kSpot, at.y() - kSpot}, {at.x(), at.y() + kSpot}};
  for (const Thing& thing : world.things)
    for (const Shape& shape : thing.shapes) {
      Eigen::AlignedBox3d bounds;
      std::vector<Eigen::Vector2d> points;
      for (const Eigen::Vector3d& local : hull_points(shape.geometry)) {
        const Eigen::Vector3d point = thing.pose * (shape.pose * local);
        bounds.extend(point);
        points.emplace_back(point.head<2>());
      }
      const double size = bounds.sizes().head<2>().prod();
      if (size >= smallest || bounds.max().z() < low || bounds.min().z() > high ||
          !overlap(convex_hull(std::move(points)), spot, 0.0))
        continue;
      name = thing.name;
      smallest = size;
    }
  return name;
}

/// Draws the ends of a route from a seed.
class ScenarioSampler {
 public:
  ScenarioSampler(const WorldDescription& world, const navvi_floor::Voxels& voxels,
                  const ScenarioConfig& config, std::uint64_t seed)
      : world_(world),
        config_(config),
        ways_(floor_of(voxels, world.floor_height, config.robot_height, clear())),
        places_(world, ways_, config),
        random_(seed) {}

  [[nodiscard]] StartAndGoal with_start(const Pose2& start,
                                        const std::optional<Eigen::Vector2d>& goal) {
    const std::size_t root = checked(start);
    const FloorWays::Ways ways = ways_.ways_from(root, passable(root));
    if (goal) {
      const std::size_t end = goal->allFinite() ? ways_.cell_at(*goal) : FloorWays::kNone;
      const bool joined = end != FloorWays::kNone && std::isfinite(ways.length[end]);
      return {start, *goal, joined ? length(ways, end) : 0.0};
    }
    const std::size_t end = draw(ways, {places_.quiet(), places_.all(), anywhere()}, "goal");
    return {start, ways_.centre(end), length(ways, end)};
  }

  [[nodiscard]] StartAndGoal with_goal(const Eigen::Vector2d& goal) {
    const Places starts = places_.away_from_movers(places_.all());
    const std::size_t root = goal.allFinite() ? ways_.cell_at(goal) : FloorWays::kNone;
    if (root == FloorWays::kNone || ways_.clearance(root) < config_.robot_radius) {
      // Navigation refuses such a goal; the start may then be anywhere.
      const Eigen::Vector2d place = ways_.centre(starts[random_.below(starts.size())]);
      return {{place, 0.0}, goal};
    }
    const FloorWays::Ways ways = ways_.ways_from(root, passable(root));
    const std::size_t start =
        draw(ways, {places_.away_from_movers(places_.quiet()), starts, anywhere()}, "start");
    return {looking_back(ways, start), goal, length(ways, start)};
  }

  [[nodiscard]] StartAndGoal with_nothing() {
    std::optional<StartAndGoal> scenario = between(places_.quiet());
    if (!scenario && places_.quiet().size() < places_.all().size())
      scenario = between(places_.all());
    if (!scenario)
      throw WorldError("world '" + world_.name +
                       "' has no place for a start that is connected to one for a goal" +
                       asked_for());
    return *scenario;
  }

  /// Where the ends of a route lie, if that is odd; else empty.
  [[nodiscard]] std::string note_on(const StartAndGoal& drawn) const {
    const double apart = (drawn.goal - drawn.start.position).norm();
    if (apart < kNoRoute || (drawn.route_length > 0.0 && drawn.route_length < kLeastRoute))
      return "start and goal are " + text(std::round(100.0 * apart) / 100.0) +
             " m apart, too near for a trial";
    const Polygon& hull = places_.hull();
    if (hull.empty()) return {};
    std::string who;
    if (!lies_in(hull, drawn.start.position)) who = "the start lies";
    if (!lies_in(hull, drawn.goal)) who = who.empty() ? "the goal lies" : "start and goal lie";
    return who.empty() ? who : who + " outside of everything that stands in this world";
  }

 private:
  using Places = FreePlaces::Places;

  /// Both ends drawn from `places`; nullopt if no route leads between any that were tried.
  [[nodiscard]] std::optional<StartAndGoal> between(const Places& places) {
    if (places.empty()) return std::nullopt;
    const Places starts = places_.away_from_movers(places);
    std::optional<StartAndGoal> best;
    const double enough = asks_for_route() ? 0.0 : kUsualRoute;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::size_t root = places[random_.below(places.size())];
      const FloorWays::Ways ways = ways_.ways_from(root, clear());
      const std::size_t start = try_draw(ways, starts);
      if (start == FloorWays::kNone || (best && length(ways, start) <= best->route_length))
        continue;
      best = {looking_back(ways, start), ways_.centre(root), length(ways, start)};
      if (best->route_length >= enough) break;
    }
    return best;
  }

  /// Those of `places` at the end of a way that is neither too short nor too long. Where no length
  /// is asked for, a small world has some at 0.8 of the longest way to a free place.
  [[nodiscard]] Places ends_of(const FloorWays::Ways& ways, const Places& places) {
    double longest = 0.0;
    for (const std::size_t place : places)
      if (std::isfinite(ways.length[place])) longest = std::max(longest, length(ways, place));
    longest_ = std::max(longest_, longest);
    const double least =
        asks_for_route() ? config_.min_route : std::min(kUsualRoute, 0.8 * longest);
    const double most = config_.max_route > 0.0 ? config_.max_route : longest;
    return those(places, [&](std::size_t place) {
      return std::isfinite(ways.length[place]) && length(ways, place) >= least &&
             length(ways, place) <= most;
    });
  }

  /// One of `places` to which a way leads as asked for; kNone if none was found.
  [[nodiscard]] std::size_t try_draw(const FloorWays::Ways& ways, const Places& places) {
    const Places ends = ends_of(ways, places);
    return ends.empty() ? FloorWays::kNone : ends[random_.below(ends.size())];
  }

  /// \param choices  of places, the better ones first
  [[nodiscard]] std::size_t draw(const FloorWays::Ways& ways, const std::vector<Places>& choices,
                                 const std::string& what) {
    for (const Places& places : choices) {
      const std::size_t end = try_draw(ways, places);
      if (end != FloorWays::kNone) return end;
    }
    throw WorldError("world '" + world_.name + "' has no free place for a " + what +
                     " that is connected to what was given" + asked_for());
  }

  /// The cell of a start that was given. \throws WorldError if no robot can stand there
  [[nodiscard]] std::size_t checked(const Pose2& start) const {
    const std::string who = "start (" + text(start.position.x()) + ", " + text(start.position.y()) +
                            ", " + text(start.yaw) + ")";
    if (!start.position.allFinite() || !std::isfinite(start.yaw))
      throw WorldError(who + " has a number that is not finite; allowed is x,y,yaw in m and rad");
    const std::size_t cell = ways_.cell_at(start.position);
    if (cell == FloorWays::kNone || ways_.clearance(cell) <= 0.0) {
      const double side = ways_.floor().cell_size(), floor = world_.floor_height + side / 2.0;
      const navvi_floor::Area area = ways_.floor().area();
      const auto corner = [&](navvi_floor::Cell cell) {
        return "(" + text(cell.x * side) + ", " + text(cell.y * side) + ")";
      };
      const std::string thing =
          thing_at(world_, start.position, floor, world_.floor_height + config_.robot_height);
      throw WorldError(who + (thing.empty() ? " is off the floor" : " is in '" + thing + "'") +
                       " of world '" + world_.name + "'; allowed is free floor, from " +
                       corner(area.low) + " to " + corner(area.high));
    }
    if (ways_.clearance(cell) + ways_.floor().cell_size() < config_.robot_radius)
      throw WorldError(who + " is " + text(ways_.clearance(cell)) +
                       " m from a thing or the floor's edge; allowed is the robot's radius of " +
                       text(config_.robot_radius) + " m or more");
    return cell;
  }

  /// The pose in `cell` that looks along the way back to where the ways begin.
  [[nodiscard]] Pose2 looking_back(const FloorWays::Ways& ways, std::size_t cell) const {
    const Eigen::Vector2d place = ways_.centre(cell);
    std::size_t ahead = cell;
    while (static_cast<double>(ways.length[cell] - ways.length[ahead]) < kLookAhead) {
      const std::size_t next = ways_.before(ways, ahead);
      if (next == FloorWays::kNone) break;
      ahead = next;
    }
    const Eigen::Vector2d view = ways_.centre(ahead) - place;
    return {place, std::atan2(view.y(), view.x())};
  }

  /// What was asked of the route, for a sentence.
  [[nodiscard]] std::string asked_for() const {
    if (!asks_for_route()) return "";
    std::string words = " by a route of " + text(config_.min_route) + " m or more";
    if (config_.max_route > 0.0) words += " and up to " + text(config_.max_route) + " m";
    return words + " (the longest that was found has " + text(std::round(longest_)) + " m)";
  }

  [[nodiscard]] bool asks_for_route() const {
    return config_.min_route > 0.0 || config_.max_route > 0.0;
  }

  /// For what joins a place that was given, wherever that is.
  [[nodiscard]] Places anywhere() const { return ways_.cells_clear_by(clear()); }
  [[nodiscard]] double clear() const { return config_.robot_radius + config_.clearance; }
  /// A way may leave from nearer to things than it may pass by.
  [[nodiscard]] double passable(std::size_t root) const {
    return std::min(clear(), ways_.clearance(root));
  }

  const WorldDescription& world_;
  const ScenarioConfig& config_;
  FloorWays ways_;
  FreePlaces places_;
  Random random_;
  double longest_ = 0.0;  ///< m, of the ways seen so far
};

}  // namespace

void ScenarioConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(min_route, "min_route", Range{0.0, 10000.0}, "m",
        "least length of the way from start to goal where one of them is drawn; 0: 10 where the "
        "world permits");
  visit(max_route, "max_route", Range{0.0, 10000.0}, "m", "its greatest length; 0: any");
}

StartAndGoal draw_scenario(const WorldDescription& world, const navvi_floor::Voxels& voxels,
                           const ScenarioConfig& config, std::uint64_t seed,
                           const std::optional<Pose2>& start,
                           const std::optional<Eigen::Vector2d>& goal) {
  if (config.max_route > 0.0 && config.max_route < config.min_route)
    throw WorldError("max_route is " + text(config.max_route) +
                     " m, less than min_route; allowed are " + text(config.min_route) +
                     " m or more, or 0 for any");
  ScenarioSampler sampler(world, voxels, config, seed);
  StartAndGoal drawn = start  ? sampler.with_start(*start, goal)
                       : goal ? sampler.with_goal(*goal)
                              : sampler.with_nothing();
  if (!(start && goal) && drawn.route_length > 0.0 && drawn.route_length < kNoRoute)
    throw WorldError("world '" + world.name + "' has room for a way of " +
                     text(drawn.route_length) + " m; allowed is " + text(kNoRoute) +
                     " m or more from start to goal");
  drawn.note = sampler.note_on(drawn);
  return drawn;
}

std::vector<Place> free_places_of(const WorldDescription& world, const navvi_floor::Voxels& voxels,
                                  const ScenarioConfig& config) {
  std::vector<Place> places;
  if (world.places.empty()) return places;
  const double clear = config.robot_radius + config.clearance;
  const FloorWays ways(floor_of(voxels, world.floor_height, config.robot_height, clear));
  for (Place place : world.places) {
    const Eigen::Vector2d middle = place.area.center();
    double nearest = std::numeric_limits<double>::infinity();
    ways.for_each_row_in(place.area, [&](std::size_t cell, std::size_t end) {
      for (; cell < end; ++cell) {
        const double distance = (ways.centre(cell) - middle).norm();
        if (ways.clearance(cell) < clear || distance >= nearest) continue;
        nearest = distance;
        place.at = ways.centre(cell);
      }
    });
    if (std::isfinite(nearest)) places.push_back(place);
  }
  return places;
}

}  // namespace navvi_sim::scenario
