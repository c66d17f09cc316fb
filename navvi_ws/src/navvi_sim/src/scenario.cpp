#include "navvi_sim/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "floor_grid.hpp"
#include "random.hpp"

namespace navvi_sim {
namespace {

constexpr int kAttempts = 20;
constexpr double kLookAhead = 2.0;  // m along the route, to which a drawn start looks

std::string text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

class Drawing {
 public:
  Drawing(const WorldDescription& world, const octomap::OcTree& map, const ScenarioConfig& config,
          std::uint64_t seed)
      : world_(world),
        config_(config),
        grid_(map, world.floor_height, config.robot_height),
        random_(seed) {
    for (std::size_t cell = 0; cell < grid_.size(); ++cell)
      if (grid_.clearance(cell) >= clear()) free_.push_back(cell);
    if (free_.empty())
      throw WorldError("world '" + world.name + "' has no place where a robot of radius " +
                       text(config.robot_radius) + " m stands " + text(config.clearance) +
                       " m clear of things; a start needs one");
  }

  [[nodiscard]] Scenario with_start(const FloorPose& start,
                                    const std::optional<Eigen::Vector2d>& goal) {
    const std::size_t root = checked(start);
    const FloorGrid::Ways ways = grid_.ways_from(root, passable(root));
    if (goal) return {start, *goal, reached(ways, *goal)};
    const std::size_t end = draw(ways, free_, "goal");
    return {start, grid_.centre(end), static_cast<double>(ways.length[end])};
  }

  [[nodiscard]] Scenario with_goal(const Eigen::Vector2d& goal) {
    const std::vector<std::size_t> starts = free_of_movers();
    const std::size_t root = goal.allFinite() ? grid_.cell_at(goal) : FloorGrid::kNone;
    if (root == FloorGrid::kNone || grid_.clearance(root) < config_.robot_radius) {
      // Navigation refuses such a goal; the start may then be anywhere.
      const Eigen::Vector2d place = grid_.centre(starts[random_.below(starts.size())]);
      return {{place.x(), place.y(), 0.0}, goal, 0.0};
    }
    const FloorGrid::Ways ways = grid_.ways_from(root, passable(root));
    const std::size_t start = draw(ways, starts, "start");
    return {looking_back(ways, start), goal, static_cast<double>(ways.length[start])};
  }

  [[nodiscard]] Scenario with_nothing() {
    const std::vector<std::size_t> starts = free_of_movers();
    Scenario best{{}, {}, -1.0};
    for (int attempt = 0; attempt < kAttempts && best.route_length < config_.min_route; ++attempt) {
      const std::size_t root = free_[random_.below(free_.size())];
      const FloorGrid::Ways ways = grid_.ways_from(root, clear());
      const std::vector<std::size_t> ends = far_enough(ways, starts);
      if (ends.empty()) continue;
      const std::size_t start = ends[random_.below(ends.size())];
      const auto length = static_cast<double>(ways.length[start]);
      if (length > best.route_length)
        best = {looking_back(ways, start), grid_.centre(root), length};
    }
    if (best.route_length < 0.0)
      throw WorldError("world '" + world_.name +
                       "' has no place for a start that is connected to one for a goal");
    return best;
  }

 private:
  [[nodiscard]] double clear() const { return config_.robot_radius + config_.clearance; }
  /// A way may leave from nearer to things than it may pass by.
  [[nodiscard]] double passable(std::size_t root) const {
    return std::min(clear(), grid_.clearance(root));
  }

  [[nodiscard]] std::size_t checked(const FloorPose& start) const {
    const std::string who =
        "start (" + text(start.x) + ", " + text(start.y) + ", " + text(start.yaw) + ")";
    if (!std::isfinite(start.x) || !std::isfinite(start.y) || !std::isfinite(start.yaw))
      throw WorldError(who + " has a number that is not finite; allowed is x,y,yaw in m and rad");
    const std::size_t cell = grid_.cell_at({start.x, start.y});
    if (cell == FloorGrid::kNone || grid_.clearance(cell) <= 0.0)
      throw WorldError(who + " is in a thing or off the floor of world '" + world_.name +
                       "'; allowed is free floor");
    if (grid_.clearance(cell) + grid_.cell_size() < config_.robot_radius)
      throw WorldError(who + " is " + text(grid_.clearance(cell)) +
                       " m from a thing or the floor's edge; allowed is the robot's radius of " +
                       text(config_.robot_radius) + " m or more");
    return cell;
  }

  /// Free places that keep their distance from where movers begin; all free places if none does.
  [[nodiscard]] std::vector<std::size_t> free_of_movers() const {
    std::vector<std::size_t> places;
    for (const std::size_t cell : free_) {
      const Eigen::Vector2d place = grid_.centre(cell);
      const bool near =
          std::any_of(world_.things.begin(), world_.things.end(), [&](const Thing& thing) {
            return thing.route &&
                   (thing.pose.translation().head<2>() - place).norm() < config_.mover_distance;
          });
      if (!near) places.push_back(cell);
    }
    return places.empty() ? free_ : places;
  }

  /// Those of `places` at the end of a way long enough, which in a small world is 0.8 of the
  /// longest.
  [[nodiscard]] std::vector<std::size_t> far_enough(const FloorGrid::Ways& ways,
                                                    const std::vector<std::size_t>& places) const {
    double longest = 0.0;
    for (const std::size_t place : places)
      if (std::isfinite(ways.length[place]))
        longest = std::max(longest, static_cast<double>(ways.length[place]));
    const double least = std::min(config_.min_route, 0.8 * longest);
    std::vector<std::size_t> ends;
    for (const std::size_t place : places)
      if (std::isfinite(ways.length[place]) && static_cast<double>(ways.length[place]) >= least)
        ends.push_back(place);
    return ends;
  }

  [[nodiscard]] std::size_t draw(const FloorGrid::Ways& ways,
                                 const std::vector<std::size_t>& places, const std::string& what) {
    const std::vector<std::size_t> ends = far_enough(ways, places);
    if (ends.empty())
      throw WorldError("world '" + world_.name + "' has no free place for a " + what +
                       " that is connected to what was given");
    return ends[random_.below(ends.size())];
  }

  /// The pose in `cell` that looks along the way back to where the ways begin.
  [[nodiscard]] FloorPose looking_back(const FloorGrid::Ways& ways, std::size_t cell) const {
    const Eigen::Vector2d place = grid_.centre(cell);
    std::size_t ahead = cell;
    while (ways.before[ahead] != FloorGrid::kNone &&
           static_cast<double>(ways.length[cell] - ways.length[ahead]) < kLookAhead)
      ahead = ways.before[ahead];
    const Eigen::Vector2d view = grid_.centre(ahead) - place;
    return {place.x(), place.y(), std::atan2(view.y(), view.x())};
  }

  [[nodiscard]] double reached(const FloorGrid::Ways& ways, const Eigen::Vector2d& goal) const {
    const std::size_t cell = goal.allFinite() ? grid_.cell_at(goal) : FloorGrid::kNone;
    if (cell == FloorGrid::kNone || !std::isfinite(ways.length[cell])) return 0.0;
    return static_cast<double>(ways.length[cell]);
  }

  const WorldDescription& world_;
  const ScenarioConfig& config_;
  FloorGrid grid_;
  Random random_;
  std::vector<std::size_t> free_;  ///< clear of everything that stands still
};

}  // namespace

Scenario draw_scenario(const WorldDescription& world, const octomap::OcTree& map,
                       const ScenarioConfig& config, std::uint64_t seed,
                       const std::optional<FloorPose>& start,
                       const std::optional<Eigen::Vector2d>& goal) {
  Drawing drawing(world, map, config, seed);
  if (start) return drawing.with_start(*start, goal);
  if (goal) return drawing.with_goal(*goal);
  return drawing.with_nothing();
}

}  // namespace navvi_sim
