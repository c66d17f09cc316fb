#include "navvi_perception/see/perception.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clusters/clusters.hpp"
#include "map/local_map.hpp"
#include "tracks/tracker.hpp"

namespace navvi_perception::see {
namespace {

constexpr double kShift =
    0.5;  // m, that the robot drives before standing things are looked up anew

double seconds(std::int64_t stamp) { return static_cast<double>(stamp) * 1e-9; }

/// The point of a column that is nearest to `place`, m.
Eigen::Vector2d nearest_of(const map::Column& column, double side, const Eigen::Vector2d& place) {
  const Eigen::Vector2d low(column.first * side, column.second * side);
  return place.cwiseMax(low).cwiseMin(low + Eigen::Vector2d(side, side));
}

struct Values {
  map::MapConfig map;
  tracks::TrackConfig tracks;
  double robot_radius = 0.35;     ///< m; what is nearer than this is the robot itself
  double detection_radius = 5.0;  ///< m, gap up to which things are reported as near
  static constexpr double kGap = 0.6;  ///< m, points no farther apart are one thing
  static constexpr std::size_t kFewest = 3;   ///< points of a thing that may move
  static constexpr double kPlace = 0.15;      ///< m, what is met nearer was met at that place
  static constexpr double kNarrowest = 0.25;  ///< m, least radius of a thing that may move
  static constexpr double kWidest = 3.5;      ///< m, what is longer does not move
  double wall = 2.0;              ///< m; what stands and is longer is called a wall
  /// Hz, at most, at which a sensor's sights go into the map
  static constexpr double kMapRate = 2.5;
  double period = 1.0;  ///< s, least time between two maps

  void describe(navvi_config::Visitor& visit) {
    visit.group("map", map);
    visit.group("tracks", tracks);
    visit(robot_radius, "robot_radius", navvi_config::Range{0.05, 3.0}, "m",
          "of the robot's hull; what is nearer to its middle is the robot itself");
    visit(wall, "wall", navvi_config::Range{0.5, 100.0}, "m",
          "least length of a standing object that is called a wall, a rack too; all else is other");
  }
};

Values& of(std::any& values) { return std::any_cast<Values&>(values); }
const Values& of(const std::any& values) { return std::any_cast<const Values&>(values); }

}  // namespace

PerceptionConfig::PerceptionConfig() : values_(Values()) {}
void PerceptionConfig::describe(navvi_config::Visitor& visit) { of(values_).describe(visit); }
double PerceptionConfig::resolution() const { return of(values_).map.resolution; }
double PerceptionConfig::robot_radius() const { return of(values_).robot_radius; }
void PerceptionConfig::set_robot_height(double height) { of(values_).map.high = height; }
double PerceptionConfig::robot_height() const { return of(values_).map.high; }
sight::Prior PerceptionConfig::prior_of(const std::string& file) const {
  return map::prior_of(file, of(values_).map);
}

struct Perception::Parts {
  struct Sensor {
    tracks::Tracker tracker;
    std::int64_t mapped = 0;           ///< ns
    std::vector<Eigen::Vector3d> few;  ///< that few rays met, then
  };

  Parts(const Values& values, const sight::Prior& prior) : config(values), map(values.map, prior) {}

  /// The points that the map does not explain; all others, but for those of movers that a lower
  /// sensor tells, are added to `rest`.
  [[nodiscard]] std::vector<Eigen::Vector3d> strange(const sight::Sight& sight,
                                                     std::vector<Eigen::Vector3d>& rest) const;
  void look_up(const navvi_types::Pose2& robot);
  /// Tracks that are told at the stamp, ns: of a lower sensor where two see the same.
  template <typename Visit>
  void for_each_track(std::int64_t stamp, const Visit& visit) const;

  Values config;
  map::LocalMap map;
  std::vector<Sensor> sensors;
  clusters::StandingThings standing;
  std::uint32_t next_id = 1;
  Eigen::Vector2d looked_up = Eigen::Vector2d::Constant(1e9);
  bool map_new = true;             ///< since standing things were looked up
  bool untold = true;              ///< since the map was told
  std::int64_t told = 0;           ///< ns
  std::vector<std::int8_t> bytes;  ///< that were told
};

Perception::Perception(const PerceptionConfig& config, const sight::Prior& prior)
    : parts_(std::make_unique<Parts>(of(config.values_), prior)) {}
Perception::~Perception() = default;

std::vector<Eigen::Vector3d> Perception::Parts::strange(const sight::Sight& sight,
                                                        std::vector<Eigen::Vector3d>& rest) const {
  const auto told = [&](const Eigen::Vector2d& hit) {
    return std::any_of(sensors.begin(), sensors.begin() + static_cast<std::ptrdiff_t>(sight.sensor),
                       [&](const Sensor& lower) {
                         return std::any_of(
                             lower.tracker.now().begin(), lower.tracker.now().end(),
                                            [&](const tracks::Track& track) {
                               return track.mover &&
                                      lower.tracker.sure(track, seconds(sight.stamp)) &&
                                      (hit - track.place).norm() < track.radius + config.kGap;
                                            });
                       });
  };
  const auto clear = [&](const Eigen::Vector3d& place) {
    return map.at(place, sight.in_plane) == map::LocalMap::Known::clear;
  };
  // Rays that graze the top of a low thing clear the voxels that it ends in, but not those below.
  const Eigen::Vector3d below(0.0, 0.0, 2.0 * map.resolution());
  std::vector<Eigen::Vector3d> found;
  for (const Eigen::Vector3d& hit : sight.hits) {
    if ((hit.head<2>() - sight.robot.position).norm() <= config.robot_radius) continue;
    if (map.matters(hit) && clear(hit) && (sight.in_plane || clear(hit - below)))
      found.push_back(hit);
    else if (!told(hit.head<2>()))
      rest.push_back(hit);
  }
  return found;
}

void Perception::know(const sight::Prior& prior) {
  parts_->map.know(prior);
  parts_->map_new = parts_->untold = true;
}

bool Perception::believes(const sight::Sight& sight) const {
  return !sight.hits.empty() || !parts_->map.contradicts(sight);
}

void Perception::take(const sight::Sight& sight) {
  Parts& parts = *parts_;
  const Values& config = parts.config;
  while (parts.sensors.size() <= sight.sensor)
    parts.sensors.push_back({tracks::Tracker(config.tracks), 0, {}});
  Parts::Sensor& sensor = parts.sensors[sight.sensor];

  sight::Sight stands = sight;
  stands.hits.clear();
  const std::vector<Eigen::Vector3d> points = parts.strange(sight, stands.hits);
  std::vector<clusters::Cluster> found =
      clusters::clusters_of(points, config.kGap, config.kNarrowest, sight.origin.head<2>());
  const auto add = [&](const clusters::Cluster& cluster) {
    for (const std::size_t i : cluster.members) stands.hits.push_back(points[i]);
  };
  std::vector<Eigen::Vector3d> few;
  const auto stand = std::stable_partition(found.begin(), found.end(), [&](const auto& one) {
    return one.length <= config.kWidest && one.members.size() >= config.kFewest;
  });
  for (auto one = stand; one != found.end(); ++one)
    if (one->length > config.kWidest)
      add(*one);
    else
      for (const std::size_t i : one->members) few.push_back(points[i]);
  found.erase(stand, found.end());
  const std::vector<std::size_t> tracks =
      sensor.tracker.update(found, points, seconds(sight.stamp), parts.next_id);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (sensor.tracker.now()[tracks[i]].settled) add(found[i]);

  if (seconds(sight.stamp - sensor.mapped) * config.kMapRate < 1.0 - 1e-6) return;
  sensor.mapped = sight.stamp;
  // What few rays meet twice at one place stands, such as a pole; rays at edges end anywhere.
  for (const Eigen::Vector3d& point : few)
    if (std::any_of(sensor.few.begin(), sensor.few.end(), [&](const Eigen::Vector3d& before) {
          return (point - before).norm() < config.kPlace;
        }))
      stands.hits.push_back(point);
  sensor.few = std::move(few);
  parts.map.insert(stands);
  parts.map_new = parts.untold = true;
}

template <typename Visit>
void Perception::Parts::for_each_track(std::int64_t stamp, const Visit& visit) const {
  std::vector<const tracks::Track*> told;
  for (const Sensor& sensor : sensors) {
    const std::size_t before = told.size();
    for (const tracks::Track& track : sensor.tracker.now()) {
      const bool known =
          std::any_of(told.begin(), told.begin() + static_cast<std::ptrdiff_t>(before),
                      [&](const tracks::Track* other) {
                        return (other->place - track.place).norm() < other->radius + track.radius;
                      });
      if (known || !sensor.tracker.sure(track, seconds(stamp))) continue;
      told.push_back(&track);
      visit(track, sensor.tracker.drives(track));
    }
  }
}

navvi_types::Obstacles Perception::obstacles(std::int64_t stamp) const {
  navvi_types::Obstacles out{stamp, {}};
  const double floor = parts_->config.map.floor;
  parts_->for_each_track(stamp, [&](const tracks::Track& track, bool drives) {
    navvi_types::MovingThing thing;
    thing.id = track.id;
    thing.pose.position = track.place;
    if (drives) {
      thing.velocity = track.velocity;
      thing.pose.yaw = std::atan2(track.velocity.y(), track.velocity.x());
    }
    thing.radius = track.radius;
    thing.height = track.top - floor;
    thing.floor = floor;
    out.things.push_back(thing);
  });
  return out;
}

void Perception::Parts::look_up(const navvi_types::Pose2& robot) {
  if (!map_new && (robot.position - looked_up).norm() < kShift) return;
  map_new = false;
  looked_up = robot.position;
  const double reach = config.detection_radius + config.robot_radius + 2.0 * kShift;
  const int apart = std::max(1, static_cast<int>(config.kGap / map.resolution()));
  (void)standing.update(map.standing(robot.position, reach), apart, next_id);
}

navvi_types::Proximity Perception::proximity(const navvi_types::Pose2& robot, std::int64_t stamp) {
  using navvi_types::ThingClass;
  Parts& parts = *parts_;
  const Values& config = parts.config;
  parts.look_up(robot);
  navvi_types::Proximity out{stamp, {}, config.detection_radius};
  const auto add = [&](std::uint32_t id, ThingClass thing_class, const Eigen::Vector2d& nearest,
                       bool moving) {
    const double gap = (nearest - robot.position).norm() - config.robot_radius;
    if (gap <= config.detection_radius)
      out.things.push_back({thing_class, id, gap, robot.to_local(nearest), moving});
  };
  const auto nearer = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a - robot.position).squaredNorm() < (b - robot.position).squaredNorm();
  };
  const double side = parts.map.resolution();
  for (const clusters::StandingThings::StandingThing& thing : parts.standing.now()) {
    Eigen::Vector2d best = Eigen::Vector2d::Constant(1e9);
    map::Column low = thing.cells.front(), high = low;
    for (const map::Column& column : thing.cells) {
      low = {std::min(low.first, column.first), std::min(low.second, column.second)};
      high = {std::max(high.first, column.first), std::max(high.second, column.second)};
      const Eigen::Vector2d point = nearest_of(column, side, robot.position);
      if (nearer(point, best)) best = point;
    }
    const int longest = std::max(high.first - low.first, high.second - low.second) + 1;
    add(thing.id, longest * side >= config.wall ? ThingClass::wall : ThingClass::other, best,
        false);
  }
  parts.for_each_track(stamp, [&](const tracks::Track& track, bool) {
    add(track.id, ThingClass::other,
        *std::min_element(track.surface.begin(), track.surface.end(), nearer), track.mover);
  });
  std::sort(out.things.begin(), out.things.end(), [](const auto& a, const auto& b) {
    return a.gap != b.gap ? a.gap < b.gap : a.id < b.id;
  });
  return out;
}

std::vector<Eigen::Vector3d> Perception::standing() const { return parts_->map.seen(); }

navvi_types::Contact Perception::bump(const navvi_types::Pose2& robot, std::uint32_t count,
                                      std::int64_t stamp) const {
  navvi_types::Contact contact;
  contact.robot = robot;
  contact.point = robot.to_parent({parts_->config.robot_radius, 0.0});
  contact.floor = parts_->config.map.floor;
  contact.counts[contact.thing_class] = contact.seq = count;
  contact.stamp = stamp;
  return contact;
}

std::optional<std::vector<std::int8_t>> Perception::map(std::int64_t stamp) {
  Parts& parts = *parts_;
  const double since = seconds(stamp - parts.told);
  if (!parts.untold || (!parts.bytes.empty() && since >= 0.0 && since < parts.config.period))
    return std::nullopt;
  parts.untold = false;
  parts.told = stamp;
  if (!parts.map.changed() && !parts.bytes.empty()) return std::nullopt;
  std::vector<std::int8_t> bytes = parts.map.bytes();
  if (bytes.empty() || bytes == parts.bytes) return std::nullopt;
  parts.bytes = std::move(bytes);
  return parts.bytes;
}

}  // namespace navvi_perception::see
