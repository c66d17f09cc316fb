#include "navvi_sim/lanes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "block_index.hpp"

namespace navvi_sim {
namespace {

constexpr double kBlock = 0.5;     // m
constexpr double kGap = 0.1;       // m, nearer lanes touch
constexpr double kTurnStep = 0.1;  // rad, between the poses of a body that a block is the hull of
constexpr double kDrivenOver = 0.05;  // m above the floor; lower things stop nobody
constexpr double kOffRoute = 0.1;     // m, farther from its way, corners cut, no thing may stand
constexpr int kHalvings = 3;          // of a corner's radius, before it is turned on the spot

[[noreturn]] void refuse(const std::string& sentence) { throw WorldError(sentence); }

std::string quoted(const Thing& thing) { return "'" + thing.name + "'"; }

std::string place_text(const Eigen::Vector2d& at) {
  std::ostringstream text;
  text.precision(3);
  text << "(" << at.x() << ", " << at.y() << ")";
  return text.str();
}

/// m, the radius at which things of a class round corners.
double corner_radius(ThingClass thing_class, const MoversConfig& config) {
  switch (thing_class) {
    case ThingClass::worker:
      return 0.25 * config.corner_radius;
    case ThingClass::pallet_robot:
      return 0.5 * config.corner_radius;
    default:
      return config.corner_radius;
  }
}

bool operator<(const Waypoint& a, const Waypoint& b) {
  const auto key = [](const Waypoint& w) {
    return std::array<double, 4>{w.at.x(), w.at.y(), w.pause, w.speed};
  };
  return key(a) < key(b);
}

/// Equal for things that drive the same round in the same direction and may follow each other.
struct RoundKey {
  ThingClass thing_class;
  double speed;
  std::vector<Waypoint> waypoints;  ///< beginning with the least
  std::size_t alone;                ///< for what shares with nobody

  bool operator<(const RoundKey& other) const {
    if (thing_class != other.thing_class) return thing_class < other.thing_class;
    if (speed != other.speed) return speed < other.speed;
    if (alone != other.alone) return alone < other.alone;
    return std::lexicographical_compare(
        waypoints.begin(), waypoints.end(), other.waypoints.begin(), other.waypoints.end(),
        [](const Waypoint& a, const Waypoint& b) { return navvi_sim::operator<(a, b); });
  }
};

RoundKey round_key(const Thing& thing, std::size_t id) {
  RoundKey key{thing.thing_class, thing.route->speed, thing.route->waypoints, 0};
  if (!thing.route->loop || thing.route->delay > 0.0) key.alone = id + 1;
  const auto least = std::min_element(
      key.waypoints.begin(), key.waypoints.end(),
      [](const Waypoint& a, const Waypoint& b) { return navvi_sim::operator<(a, b); });
  std::rotate(key.waypoints.begin(), least, key.waypoints.end());
  return key;
}

/// The ground that a body sweeps between two places of its track, a little wider in curves.
Polygon swept(const Track& track, const Footprint& print, double from, double to) {
  std::vector<Eigen::Vector2d> points;
  double wider = 0.0;
  const auto stand = [&](const Track::Element& element, double s) {
    const Place place = element.place(s);
    const Eigen::Rotation2Dd rotation(place.yaw);
    for (const Eigen::Vector2d& corner : print.hull) points.push_back(place.at + rotation * corner);
  };
  for (std::size_t e = track.element_at(from); e < track.elements().size(); ++e) {
    const Track::Element& element = track.elements()[e];
    if (element.begin >= to) break;
    const double begin = std::max(from, element.begin);
    const double end = std::min(to, element.end());
    const double turn = (std::abs(element.curvature) + std::abs(element.spin)) * (end - begin);
    const int steps = std::max(1, static_cast<int>(std::ceil(turn / kTurnStep)));
    for (int i = 0; i <= steps; ++i) stand(element, begin + (end - begin) * i / steps);
    // Between two poses a point leaves their chord by the arc's height.
    if (turn > 0.0) {
      const double radius =
          print.radius + (element.curvature != 0.0 ? 1.0 / std::abs(element.curvature) : 0.0);
      wider = std::max(wider, radius * (1.0 - std::cos(0.5 * turn / steps)));
    }
  }
  if (wider > 0.0) {
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i)
      for (const Eigen::Vector2d& side :
           {Eigen::Vector2d(wider, wider), Eigen::Vector2d(-wider, wider),
            Eigen::Vector2d(wider, -wider), Eigen::Vector2d(-wider, -wider)})
        points.push_back(points[i] + side);
  }
  return convex_hull(std::move(points));
}

/// The ground of each block.
std::vector<Polygon> ground_of(const Lane& lane) {
  std::vector<Polygon> ground;
  for (int block = 0; block < lane.blocks; ++block)
    ground.push_back(swept(lane.track, lane.footprint, block * lane.block_length,
                           (block + 1) * lane.block_length));
  return ground;
}

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

/// What stands, seen from above: a polygon a shape or triangle, with its heights.
struct Standing {
  std::size_t thing;
  double bottom;  ///< m, in map
  double top;     ///< m
  Polygon polygon;
};

/// Calls `visit` with each Standing of the world, one at a time: meshes are large.
template <typename Visit>
void for_each_standing(const WorldDescription& world, Visit visit) {
  for (std::size_t id = 0; id < world.things.size(); ++id) {
    const Thing& thing = world.things[id];
    if (thing.route || thing.thing_class == ThingClass::floor) continue;
    const auto show = [&](const std::vector<Eigen::Vector3d>& points) {
      Standing standing{
          id, std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(), {}};
      std::vector<Eigen::Vector2d> seen;
      for (const Eigen::Vector3d& point : points) {
        standing.bottom = std::min(standing.bottom, point.z());
        standing.top = std::max(standing.top, point.z());
        seen.emplace_back(point.x(), point.y());
      }
      if (standing.top <= world.floor_height + kDrivenOver) return;
      standing.polygon = convex_hull(std::move(seen));
      visit(standing);
    };
    for (const Shape& shape : thing.shapes) {
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry)) {
        const auto at = [&](std::uint32_t index) -> Eigen::Vector3d {
          return pose * (*mesh)->vertices[index].cast<double>();
        };
        for (const auto& [a, b, c] : (*mesh)->triangles) show({at(a), at(b), at(c)});
      } else {
        std::vector<Eigen::Vector3d> points = hull_points(shape.geometry);
        for (Eigen::Vector3d& point : points) point = pose * point;
        show(points);
      }
    }
  }
}

class Surveyor {
 public:
  Surveyor(const WorldDescription& world, const MoversConfig& config)
      : world_(world), config_(config) {}

  Lanes survey();

 private:
  struct Plan {
    std::vector<std::size_t> things;
    Route route;
    Footprint footprint;
    double base;  ///< m, the height of the things' origins
    TrackLimits limits;
    std::vector<double> radii;
  };
  /// A block of a lane.
  struct Block {
    std::size_t lane;
    int index;
  };

  void gather();
  void lay();
  void avoid_what_stands();
  void place_users();
  void forget_ground_behind();
  void find_private_ground();
  void find_spacing(std::size_t lane, std::vector<std::set<int>> touched);
  void choose_refuges();
  void choose_refuges(std::size_t lane);
  void find_crossings(Leg& leg, std::size_t lane) const;
  void check_start() const;
  [[nodiscard]] bool shares_track(const Lane& lane) const { return lane.users.size() > 1; }
  [[nodiscard]] std::size_t first_block(std::size_t lane) const { return offsets_[lane]; }
  [[nodiscard]] Block block(std::size_t number) const;
  [[nodiscard]] const Thing& thing_of(std::size_t user) const {
    return world_.things[lanes_.users[user].thing];
  }
  [[nodiscard]] std::string others_on(std::size_t lane) const;

  const WorldDescription& world_;
  const MoversConfig& config_;
  std::vector<Plan> plans_;
  Lanes lanes_;
  std::vector<std::size_t> offsets_;  ///< of each lane's blocks in ground_
  std::vector<Polygon> ground_;
  std::vector<std::vector<Block>> touching_;  ///< by block: of other lanes, or far along its own
};

Lanes Surveyor::survey() {
  gather();
  if (plans_.empty()) return {};
  avoid_what_stands();
  place_users();
  forget_ground_behind();
  find_private_ground();
  choose_refuges();
  check_start();
  return std::move(lanes_);
}

void Surveyor::gather() {
  std::map<RoundKey, std::size_t> rounds;
  for (std::size_t id = 0; id < world_.things.size(); ++id) {
    const Thing& thing = world_.things[id];
    if (!thing.route) continue;
    const RoundKey key = round_key(thing, id);
    const auto [entry, is_new] = rounds.emplace(key, plans_.size());
    const Footprint print = footprint_at(thing);
    if (is_new) {
      Route route = *thing.route;
      if (key.alone == 0) route.waypoints = key.waypoints;
      const double radius = corner_radius(thing.thing_class, config_);
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

void Surveyor::lay() {
  lanes_.lanes.clear();
  ground_.clear();
  offsets_.clear();
  for (const Plan& plan : plans_) {
    Track track(plan.route, plan.limits, plan.radii);
    const int blocks = std::max(3, static_cast<int>(std::ceil(track.length() / kBlock)));
    const double length = track.length() / blocks;
    lanes_.lanes.push_back({std::move(track), plan.footprint, blocks, length, 0, {}, {}, {}});
    offsets_.push_back(ground_.size());
    for (Polygon& polygon : ground_of(lanes_.lanes.back())) ground_.push_back(std::move(polygon));
  }
}

Surveyor::Block Surveyor::block(std::size_t number) const {
  const auto lane = static_cast<std::size_t>(
      std::upper_bound(offsets_.begin(), offsets_.end(), number) - offsets_.begin() - 1);
  return {lane, static_cast<int>(number - offsets_[lane])};
}

/// Where a rounded corner touches what stands, its radius is halved, and in the end it is turned on
/// the spot. What then still touches is refused.
void Surveyor::avoid_what_stands() {
  for (int halving = 0;; ++halving) {
    lay();
    const BlockIndex index(ground_, 0.0);
    std::set<std::pair<std::size_t, std::size_t>> tight;  // lane, way-point
    for_each_standing(world_, [&](const Standing& standing) {
      for (const std::size_t number : index.touching(standing.polygon)) {
        const auto [lane, at] = block(number);
        const Plan& plan = plans_[lane];
        const double low =
            std::max(plan.base + plan.footprint.bottom, world_.floor_height + kDrivenOver);
        if (standing.bottom >= plan.base + plan.footprint.top || standing.top <= low) continue;
        const Track& track = lanes_.lanes[lane].track;
        const double begin = at * lanes_.lanes[lane].block_length;
        const double end = begin + lanes_.lanes[lane].block_length;
        bool rounded = false;
        for (std::size_t e = track.element_at(begin); e < track.elements().size(); ++e) {
          const Track::Element& element = track.elements()[e];
          if (element.begin >= end) break;
          if (element.curvature == 0.0) continue;
          tight.emplace(lane, element.corner);
          rounded = true;
        }
        if (!rounded)
          refuse("thing " + quoted(world_.things[plan.things[0]]) + " would drive through " +
                 quoted(world_.things[standing.thing]) + " near " +
                 place_text(track.place(begin).at) +
                 "; allowed is a route that keeps its whole body clear of what stands");
      }
    });
    if (tight.empty()) return;
    for (const auto& [lane, waypoint] : tight)
      plans_[lane].radii[waypoint] *= halving < kHalvings ? 0.5 : 0.0;
  }
}

void Surveyor::place_users() {
  for (std::size_t lane = 0; lane < plans_.size(); ++lane)
    for (const std::size_t thing : plans_[lane].things) lanes_.users.push_back({thing, lane, 0.0});
  std::sort(lanes_.users.begin(), lanes_.users.end(),
            [](const LaneUser& a, const LaneUser& b) { return a.thing < b.thing; });
  for (std::size_t user = 0; user < lanes_.users.size(); ++user) {
    LaneUser& entry = lanes_.users[user];
    Lane& lane = lanes_.lanes[entry.lane];
    const Thing& thing = world_.things[entry.thing];
    const Eigen::Vector2d at = thing.pose.translation().head<2>();
    entry.start = lane.track.nearest({at, yaw_of(thing.pose)});
    const double off = (lane.track.place(entry.start).at - at).norm();
    const double cut = plans_[entry.lane].limits.corner_radius;
    if (off > kOffRoute + cut)
      refuse("thing " + quoted(thing) + " stands " + std::to_string(off).substr(0, 4) +
             " m off its route at the start; allowed is a place on the route");
    lane.users.push_back(user);
  }
  for (Lane& lane : lanes_.lanes)
    std::sort(lane.users.begin(), lane.users.end(), [&](std::size_t a, std::size_t b) {
      return std::make_pair(lanes_.users[a].start, a) < std::make_pair(lanes_.users[b].start, b);
    });
}

/// Who drives to an end and stays there never comes back to what lies behind where it starts.
void Surveyor::forget_ground_behind() {
  for (std::size_t lane = 0; lane < lanes_.lanes.size(); ++lane) {
    const Lane& here = lanes_.lanes[lane];
    if (here.track.closed()) continue;
    const int start = here.block_at(lanes_.users[here.users[0]].start);
    for (int i = 0; i < start; ++i)
      ground_[first_block(lane) + static_cast<std::size_t>(i)].clear();
  }
}

void Surveyor::find_private_ground() {
  touching_.assign(ground_.size(), {});
  std::vector<std::size_t> lane_of(ground_.size());
  for (std::size_t i = 0; i < ground_.size(); ++i) lane_of[i] = block(i).lane;
  const auto wanted = [&](const BlockIndex::Pair& pair) {
    return lane_of[pair.first] != lane_of[pair.second] ||
           shares_track(lanes_.lanes[lane_of[pair.first]]);
  };
  std::vector<std::map<int, std::set<int>>> own(lanes_.lanes.size());
  for (const auto& [a, b] : BlockIndex(ground_, kGap).pairs(wanted)) {
    const Block first = block(a), second = block(b);
    if (first.lane == second.lane) {
      own[first.lane][first.index].insert(second.index);
      own[first.lane][second.index].insert(first.index);
    } else {
      touching_[a].push_back(second);
      touching_[b].push_back(first);
    }
  }
  for (std::size_t lane = 0; lane < lanes_.lanes.size(); ++lane) {
    Lane& here = lanes_.lanes[lane];
    if (shares_track(here)) {
      std::vector<std::set<int>> touched(static_cast<std::size_t>(here.blocks));
      for (auto& [index, others] : own[lane])
        touched[static_cast<std::size_t>(index)] = std::move(others);
      find_spacing(lane, std::move(touched));
    }
    for (int i = 0; i < here.blocks; ++i)
      here.is_private.push_back(touching_[first_block(lane) + static_cast<std::size_t>(i)].empty());
  }
}

/// Bodies on one track touch where their blocks follow each other closely; `spacing` blocks apart
/// they do not. Where the track comes back to its own ground from elsewhere, it crosses itself as
/// if it were another lane.
void Surveyor::find_spacing(std::size_t lane, std::vector<std::set<int>> touched) {
  Lane& here = lanes_.lanes[lane];
  const int count = here.blocks;
  here.spacing = 1;
  for (int i = 0; i < count; ++i) {
    const std::set<int>& others = touched[static_cast<std::size_t>(i)];
    std::set<int> near;
    for (const int step : {1, -1})
      for (int k = 1; k < count; ++k) {
        const int other = ((i + step * k) % count + count) % count;
        if (others.count(other) == 0) break;
        near.insert(other);
        here.spacing = std::max(here.spacing, std::min(k, count) + 1);
      }
    for (const int other : others)
      if (near.count(other) == 0)
        touching_[first_block(lane) + static_cast<std::size_t>(i)].push_back({lane, other});
  }
}

void Surveyor::choose_refuges() {
  for (std::size_t lane = 0; lane < lanes_.lanes.size(); ++lane) choose_refuges(lane);
}

std::string Surveyor::others_on(std::size_t lane) const {
  std::map<std::size_t, std::size_t> shared;  // blocks, by lane
  for (int i = 0; i < lanes_.lanes[lane].blocks; ++i)
    for (const Block& other : touching_[first_block(lane) + static_cast<std::size_t>(i)])
      ++shared[other.lane];
  std::vector<std::pair<std::size_t, std::size_t>> order;
  for (const auto& [other, count] : shared) order.emplace_back(count, other);
  std::sort(order.rbegin(), order.rend());
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), 3); ++i)
    names += (i > 0 ? ", " : "") + quoted(thing_of(lanes_.lanes[order[i].second].users[0]));
  if (order.size() > 3) names += " and " + std::to_string(order.size() - 3) + " others";
  return names;
}

/// A lone user waits at the end of each private stretch. Those who share a track need a chain of
/// refuges to move up in, one more than they are.
void Surveyor::choose_refuges(std::size_t lane) {
  Lane& here = lanes_.lanes[lane];
  const int count = here.blocks;
  const bool shared_track = shares_track(here);
  const auto is_private = [&](int i) {
    return static_cast<bool>(here.is_private[static_cast<std::size_t>((i + count) % count)]);
  };
  const Thing& thing = thing_of(here.users[0]);
  if (!here.track.closed() && !is_private(count - 1))
    refuse("thing " + quoted(thing) + " ends its route in the way of " + others_on(lane) +
           "; allowed is an end where nothing else passes");
  bool any_shared = false;
  for (int i = 0; i < count; ++i) any_shared = any_shared || !is_private(i);
  if (!any_shared && !shared_track) return;  // it meets nobody

  std::vector<int> refuges;  // backwards
  int last = count - 1;      // the end of a private stretch, where there is one
  while (last > 0 && !(is_private(last) && !is_private(last + 1))) --last;
  if (!is_private(last)) last = count - 1;
  for (int k = 0; k < count; ++k) {
    const int i = ((last - k) % count + count) % count;
    if (!here.track.closed() && ground_[first_block(lane) + static_cast<std::size_t>(i)].empty())
      continue;
    if (!is_private(i)) continue;
    const bool ends_stretch = !is_private(i + 1) || (!here.track.closed() && i + 1 == count);
    const bool has_room =
        refuges.empty() ||
        (k - (last - refuges.back() + count) % count >= here.spacing && count - k >= here.spacing);
    if (shared_track ? has_room : ends_stretch) refuges.push_back(i);
  }
  const std::size_t needed = shared_track ? here.users.size() + 1 : 1;
  if (refuges.size() < needed) {
    const std::string others = others_on(lane);
    if (!shared_track)
      refuse("thing " + quoted(thing) +
             " has no place on its route where it is out of the way of " + others +
             "; each thing that moves needs one to wait in");
    refuse("the track of " + quoted(thing) + " is shared by " + std::to_string(here.users.size()) +
           " things and has " + std::to_string(refuges.size()) + " places to wait in" +
           (others.empty() ? "" : " out of the way of " + others) +
           "; allowed are fewer things than places");
  }
  std::reverse(refuges.begin(), refuges.end());
  std::sort(refuges.begin(), refuges.end());
  for (std::size_t i = 0; i < refuges.size(); ++i) {
    const int before = i > 0 ? refuges[i - 1] : (here.track.closed() ? refuges.back() : -1);
    here.legs.push_back({(before + 1) % count, refuges[i], {}});
    find_crossings(here.legs.back(), lane);
  }
}

void Surveyor::find_crossings(Leg& leg, std::size_t lane) const {
  const int count = lanes_.lanes[lane].blocks;
  std::set<std::pair<std::size_t, int>> touched;
  for (int i = leg.begin;; i = (i + 1) % count) {
    for (const Block& other : touching_[first_block(lane) + static_cast<std::size_t>(i)])
      touched.emplace(other.lane, other.index);
    if (i == leg.end) break;
  }
  for (const auto& [other, index] : touched) {
    const bool joins = !leg.crossings.empty() && leg.crossings.back().lane == other &&
                       leg.crossings.back().last + 1 == index;
    if (joins)
      leg.crossings.back().last = index;
    else
      leg.crossings.push_back({other, index, index});
  }
}

/// Lone users may start on shared ground if they can leave it one after another; who shares a
/// track starts on private ground, with room to the next.
void Surveyor::check_start() const {
  std::vector<std::size_t> waiting;  // users on shared ground
  const auto start_block = [&](std::size_t user) {
    return lanes_.lanes[lanes_.users[user].lane].block_at(lanes_.users[user].start);
  };
  for (std::size_t user = 0; user < lanes_.users.size(); ++user) {
    const Lane& lane = lanes_.lanes[lanes_.users[user].lane];
    const int block = start_block(user);
    const bool on_private = lane.is_private[static_cast<std::size_t>(block)];
    if (!shares_track(lane)) {
      if (!on_private) waiting.push_back(user);
      continue;
    }
    const auto place = std::find(lane.users.begin(), lane.users.end(), user) - lane.users.begin();
    const std::size_t next = lane.users[static_cast<std::size_t>(place + 1) % lane.users.size()];
    const int gap = (start_block(next) - block + lane.blocks) % lane.blocks;
    if (gap < lane.spacing)
      refuse("things " + quoted(thing_of(user)) + " and " + quoted(thing_of(next)) +
             " start too close to each other on the track they share; allowed are " +
             std::to_string(lane.spacing * lane.block_length).substr(0, 4) + " m or more");
    if (!on_private)
      refuse("thing " + quoted(thing_of(user)) + " starts in the way of " +
             others_on(lanes_.users[user].lane) +
             "; what shares its track with others must start where it is out of the way");
  }
  const auto leg_of = [&](std::size_t user) -> const Leg& {
    const Lane& lane = lanes_.lanes[lanes_.users[user].lane];
    const auto leg = std::find_if(lane.legs.begin(), lane.legs.end(), [&](const Leg& candidate) {
      return candidate.end >= start_block(user);
    });
    return leg == lane.legs.end() ? lane.legs.front() : *leg;
  };
  const auto blocks_way = [&](std::size_t user, std::size_t other) {
    for (const Crossing& crossing : leg_of(user).crossings)
      if (crossing.lane == lanes_.users[other].lane && crossing.first <= start_block(other) &&
          start_block(other) <= crossing.last)
        return true;
    return false;
  };
  for (bool any = true; any;) {
    any = false;
    for (auto user = waiting.begin(); user != waiting.end();) {
      const bool free = std::none_of(waiting.begin(), waiting.end(), [&](std::size_t other) {
        return other != *user && blocks_way(*user, other);
      });
      any = any || free;
      user = free ? waiting.erase(user) : user + 1;
    }
  }
  if (waiting.size() < 2) return;
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(waiting.size(), 4); ++i)
    names += (i > 0 ? ", " : "") + quoted(thing_of(waiting[i]));
  refuse("things " + names + (waiting.size() > 4 ? " and others" : "") +
         " start in each other's way; allowed are places that one of them can leave first");
}

}  // namespace

void MoversConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Any;
  using navvi_config::Range;
  visit({"yield", Any{}, "",
         "movers stop for the robot unless their route says otherwise; false: none does"},
        yield);
  visit({"acceleration", Range{0.1, 5.0}, "m/s^2",
         "of movers, to faster and to slower, and sideways in curves"},
        acceleration);
  visit({"turn_rate", Range{0.1, 6.0}, "rad/s", "of movers, on the spot and in curves"}, turn_rate);
  visit({"corner_radius", Range{0.0, 10.0}, "m",
         "at which forklifts round corners where there is room; pallet robots half, workers a "
         "quarter of it; 0: all turn on the spot"},
        corner_radius);
  visit({"clearance", Range{0.05, 3.0}, "m", "gap at which movers stop before the robot"},
        clearance);
  visit({"pause_spread", Range{0.0, 1.0}, "",
         "share by which pauses at way-points vary either way, drawn from the seed"},
        pause_spread);
}

Lanes lay_lanes(const WorldDescription& world, const MoversConfig& config) {
  return Surveyor(world, config).survey();
}

}  // namespace navvi_sim
