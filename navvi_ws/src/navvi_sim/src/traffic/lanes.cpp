#include "traffic/lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "traffic/lane_ground.hpp"
#include "traffic/waiting_zones.hpp"

namespace navvi_sim::traffic {
namespace {

constexpr double kBlock = 0.5;           // m
constexpr double kDrivenOver = 0.05;     // m above the floor; lower things stop nobody
constexpr double kOffRoute = 0.1;        // m, farther from its way, corners cut, no thing may stand
constexpr double kForkliftCorner = 1.2;  // m, radius; pallet robots half, workers a quarter
constexpr double kThere = 1e-9;          // m, nearer is there
constexpr int kHalvings = 3;             // of a corner's radius, before it is turned on the spot

std::string place_text(const Eigen::Vector2d& at) {
  std::ostringstream text;
  text.precision(3);
  text << "(" << at.x() << ", " << at.y() << ")";
  return text.str();
}

/// m, the radius at which things of a class round corners where there is room; else all turn on the
/// spot.
double corner_radius(ThingClass thing_class) {
  switch (thing_class) {
    case ThingClass::worker:
      return 0.25 * kForkliftCorner;
    case ThingClass::pallet_robot:
      return 0.5 * kForkliftCorner;
    default:
      return kForkliftCorner;
  }
}

std::array<double, 4> values_of(const Waypoint& waypoint) {
  return {waypoint.at.x(), waypoint.at.y(), waypoint.pause, waypoint.speed};
}

/// Equal for things that drive the same round in the same direction and may follow each other:
/// their class, their speed, way-points beginning with the least, and for a thing that shares its
/// track with none a number of its own.
struct RoundKey {
  ThingClass thing_class;
  double speed;
  std::size_t alone;
  std::vector<std::array<double, 4>> waypoints;

  bool operator<(const RoundKey& other) const {
    return std::tie(thing_class, speed, alone, waypoints) <
           std::tie(other.thing_class, other.speed, other.alone, other.waypoints);
  }
};

Footprint footprint_at(const Thing& thing) { return footprint_of(thing, tilt_of(thing.pose)); }

void grow(Footprint& print, const Footprint& other) {
  print.front = std::max(print.front, other.front);
  print.back = std::max(print.back, other.back);
  print.side = std::max(print.side, other.side);
  print.radius = std::max(print.radius, other.radius);
  print.bottom = std::min(print.bottom, other.bottom);
  print.top = std::max(print.top, other.top);
  Polygon points = print.hull;
  points.insert(points.end(), other.hull.begin(), other.hull.end());
  print.hull = convex_hull(std::move(points));
}

class LaneBuilder {
 public:
  LaneBuilder(const WorldDescription& world, const MoversConfig& config)
      : world_(world), config_(config) {}

  Lanes build() {
    group_by_route();
    if (plans_.empty()) return {};
    avoid_what_stands();
    place_users();
    find_waiting_zones(world_, take_ground(), lanes_);
    return std::move(lanes_);
  }

  std::vector<Polygon> ground() {
    group_by_route();
    avoid_what_stands();
    return take_ground();
  }

 private:
  struct Plan {
    std::vector<std::size_t> things;
    Route route;
    Footprint footprint;
    double base;  ///< m, the height of the things' origins
    TrackLimits limits;
    std::vector<double> radii;
  };

  void group_by_route() {
    std::map<RoundKey, std::size_t> rounds;
    for (std::size_t id = 0; id < world_.things.size(); ++id) {
      const Thing& thing = world_.things[id];
      if (!thing.route) continue;
      Route route = *thing.route;
      const bool alone = !route.loop || route.delay > 0.0;
      std::vector<Waypoint>& round = route.waypoints;
      const auto is_less = [](const Waypoint& a, const Waypoint& b) {
        return values_of(a) < values_of(b);
      };
      if (!alone)
        std::rotate(round.begin(), std::min_element(round.begin(), round.end(), is_less),
                    round.end());
      RoundKey key{thing.thing_class, route.speed, alone ? id + 1 : 0, {}};
      for (const Waypoint& waypoint : round) key.waypoints.push_back(values_of(waypoint));
      const auto [entry, is_new] = rounds.emplace(key, plans_.size());
      const Footprint print = footprint_at(thing);
      if (is_new) {
        const double radius = corner_radius(thing.thing_class);
        plans_.push_back({{},
                          route,
                          print,
                          thing.pose.translation().z(),
                          {config_.acceleration, config_.turn_rate, radius},
                          std::vector<double>(route.waypoints.size(), radius)});
      }
      grow(plans_[entry->second].footprint, print);
      plans_[entry->second].things.push_back(id);
    }
  }

  [[nodiscard]] static Lane lay(const Plan& plan) {
    Track track(plan.route, plan.limits, plan.radii);
    const int blocks = std::max(3, static_cast<int>(std::ceil(track.length() / kBlock)));
    const double length = track.length() / blocks;
    return {std::move(track), plan.footprint, blocks, length, 0, {}, {}, {}, {}};
  }

  /// Halves the radius of a rounded corner that touches what stands, and in the end turns it on the
  /// spot. \throws WorldError for what still touches then
  void avoid_what_stands() {
    std::vector<std::size_t> changed;  // lanes
    for (std::size_t lane = 0; lane < plans_.size(); ++lane) {
      changed.push_back(lane);
      lanes_.lanes.push_back(lay(plans_[lane]));
    }
    ground_.resize(plans_.size());
    for (int halving = 0; !changed.empty(); ++halving) {
      std::vector<std::pair<std::size_t, int>> blocks;  // lane and block
      std::vector<Polygon> ground;                      // of each
      for (const std::size_t lane : changed) {
        if (halving > 0) lanes_.lanes[lane] = lay(plans_[lane]);
        ground_[lane] = ground_of(lanes_.lanes[lane]);
        ground.insert(ground.end(), ground_[lane].begin(), ground_[lane].end());
        for (int i = 0; i < lanes_.lanes[lane].blocks; ++i) blocks.emplace_back(lane, i);
      }
      std::set<std::pair<std::size_t, std::size_t>> tight;  // lane, way-point
      const PolygonIndex index(ground, 0.0);
      for_each_standing(world_, kDrivenOver, [&](const Standing& standing) {
        for (const std::size_t number : index.touching(standing.polygon)) {
          const auto [lane, block] = blocks[number];
          const Plan& plan = plans_[lane];
          const double bottom = plan.base + plan.footprint.bottom;
          const double top = plan.base + plan.footprint.top;
          if (standing.bottom >= top || standing.top <= bottom) continue;
          const auto corners = rounded_corners(lane, block);
          for (const std::size_t corner : corners) tight.emplace(lane, corner);
          if (corners.empty())
            throw WorldError("thing " + quoted(world_.things[plan.things[0]]) +
                             " would drive through " + quoted(world_.things[standing.thing]) +
                             " near " +
                             place_text(lanes_.lanes[lane]
                                            .track.place(block * lanes_.lanes[lane].block_length)
                                            .position) +
                             "; allowed is a route that keeps its whole body clear of what stands");
        }
      });
      changed.clear();
      for (const auto& [lane, waypoint] : tight) {
        plans_[lane].radii[waypoint] *= halving < kHalvings ? 0.5 : 0.0;
        if (changed.empty() || changed.back() != lane) changed.push_back(lane);
      }
    }
  }

  [[nodiscard]] std::vector<Polygon> take_ground() {
    std::vector<Polygon> all;
    for (std::vector<Polygon>& blocks : ground_)
      std::move(blocks.begin(), blocks.end(), std::back_inserter(all));
    return all;
  }

  /// The way-points whose rounded corners lie in a block.
  [[nodiscard]] std::vector<std::size_t> rounded_corners(std::size_t lane, int block) const {
    const Lane& here = lanes_.lanes[lane];
    const auto& elements = here.track.elements();
    const double begin = block * here.block_length;
    std::vector<std::size_t> corners;
    for (std::size_t e = here.track.element_at(begin);
         e < elements.size() && elements[e].begin < begin + here.block_length; ++e)
      if (elements[e].curvature != 0.0) corners.push_back(elements[e].corner);
    return corners;
  }

  void place_users() {
    for (std::size_t lane = 0; lane < plans_.size(); ++lane)
      for (const std::size_t thing : plans_[lane].things)
        lanes_.users.push_back({thing, lane, 0.0});
    std::sort(lanes_.users.begin(), lanes_.users.end(),
              [](const LaneUser& a, const LaneUser& b) { return a.thing < b.thing; });
    for (std::size_t user = 0; user < lanes_.users.size(); ++user) {
      LaneUser& entry = lanes_.users[user];
      Lane& lane = lanes_.lanes[entry.lane];
      const Thing& thing = world_.things[entry.thing];
      const Eigen::Vector2d at = thing.pose.translation().head<2>();
      entry.start = lane.track.nearest({at, yaw_of(thing.pose)});
      const double off = (lane.track.place(entry.start).position - at).norm();
      const double cut = plans_[entry.lane].limits.corner_radius;
      if (off > kOffRoute + cut)
        throw WorldError("thing " + quoted(thing) + " stands " + std::to_string(off).substr(0, 4) +
                         " m off its route at the start; allowed is a place on the route");
      lane.users.push_back(user);
    }
    for (Lane& lane : lanes_.lanes)
      std::sort(lane.users.begin(), lane.users.end(), [&](std::size_t a, std::size_t b) {
        return std::make_pair(lanes_.users[a].start, a) < std::make_pair(lanes_.users[b].start, b);
      });
  }

  const WorldDescription& world_;
  const MoversConfig& config_;
  std::vector<Plan> plans_;  ///< one a lane
  Lanes lanes_;
  std::vector<std::vector<Polygon>> ground_;  ///< of the blocks of each lane
};

}  // namespace

std::size_t Lane::segment_after(double s) const {
  const auto segment = std::find_if(
      segments.begin(), segments.end(),
      [&](const Segment& candidate) { return waiting_place(candidate.end) > s + kThere; });
  return segment == segments.end() ? 0 : static_cast<std::size_t>(segment - segments.begin());
}

std::vector<Conflict> Lane::conflicts(int first, int last) const {
  std::set<std::pair<std::size_t, int>> touched;
  const auto gather = [&](int from, int to) {
    auto shared_block =
        std::lower_bound(shared_blocks.begin(), shared_blocks.end(), from,
                         [](const SharedBlock& entry, int block) { return entry.block < block; });
    for (; shared_block != shared_blocks.end() && shared_block->block <= to; ++shared_block)
      touched.emplace(shared_block->lane, shared_block->other);
  };
  if (first <= last) {
    gather(first, last);
  } else {
    gather(first, blocks - 1);
    gather(0, last);
  }
  std::vector<Conflict> found;
  for (const auto& [lane, other] : touched) {
    if (!found.empty() && found.back().lane == lane && found.back().last + 1 == other)
      found.back().last = other;
    else
      found.push_back({lane, other, other});
  }
  return found;
}

Lanes lay_lanes(const WorldDescription& world, const MoversConfig& config) {
  return LaneBuilder(world, config).build();
}

std::vector<Polygon> swept_ground(const WorldDescription& world, const MoversConfig& config) {
  return LaneBuilder(world, config).ground();
}

}  // namespace navvi_sim::traffic
