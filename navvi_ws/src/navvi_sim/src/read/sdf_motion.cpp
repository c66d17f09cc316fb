#include "read/sdf_motion.hpp"

#include <algorithm>
#include <cmath>

#include "description/validate.hpp"
#include "generate/furniture.hpp"
#include "read/sdf_value.hpp"

namespace navvi_sim::read {
namespace {

constexpr double kSamePlace = 0.01;       // m
constexpr double kFollowerSpeed = 1.0;    // m/s, of what is pushed by a force
constexpr double kPedestrianSpeed = 0.8;  // m/s, PedestrianSFMPlugin's own default
constexpr int kCircleCorners = 24;

/// Where an actor is at a time of its script.
struct Key {
  double time;  ///< s
  Eigen::Isometry3d pose;

  [[nodiscard]] Eigen::Vector2d at() const { return pose.translation().head<2>(); }
};

std::vector<Key> keys_of(const XmlElement& trajectory) {
  std::vector<Key> keys;
  for (const XmlElement* waypoint : trajectory.children_named("waypoint")) {
    const XmlElement& time = required(*waypoint, "time");
    keys.push_back({number(time), pose_value(required(*waypoint, "pose"))});
    if (!(keys.back().time >= 0.0 && keys.back().time <= 1e6))
      refuse(time, "<time> is " + time.text + "; allowed are 0 to 1000000 s");
    if (keys.size() > WorldLimits::waypoints)
      refuse(*waypoint, "a trajectory has more than " + std::to_string(WorldLimits::waypoints) +
                            " way-points; allowed is up to that");
  }
  std::stable_sort(keys.begin(), keys.end(),
                   [](const Key& a, const Key& b) { return a.time < b.time; });
  if (!keys.empty()) keys.front().time = 0.0;  // as Gazebo does
  return keys;
}

double id_of(const XmlElement& trajectory) {
  XmlElement id = trajectory;
  id.text = trajectory.attribute("id");
  return id.text.empty() ? 0.0 : number(id);
}

/// The keys of all trajectories, one after the other in the order of their ids.
std::vector<Key> keys_of_script(const XmlElement& script) {
  std::vector<const XmlElement*> trajectories = script.children_named("trajectory");
  std::stable_sort(trajectories.begin(), trajectories.end(),
                   [](const XmlElement* a, const XmlElement* b) { return id_of(*a) < id_of(*b); });
  std::vector<Key> all;
  for (const XmlElement* trajectory : trajectories) {
    const double begin = all.empty() ? 0.0 : all.back().time;
    for (Key key : keys_of(*trajectory)) {
      key.time += begin;
      all.push_back(key);
    }
  }
  return all;
}

/// \param note  takes what differs from Gazebo
template <typename Note>
Route route_of(const std::vector<Key>& keys, const Note& note) {
  Route route;
  bool hurried = false;
  bool jumped = false;
  double way = 0.0;
  double walked = 0.0;
  route.waypoints.push_back({keys.front().at(), 0.0, 0.0});
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const double time = keys[i].time - keys[i - 1].time;
    const double distance = (keys[i].at() - route.waypoints.back().at).norm();
    if (distance < kSamePlace) {
      route.waypoints.back().pause += time;
      continue;
    }
    Waypoint waypoint{keys[i].at(), 0.0, 0.0};
    jumped = jumped || !(time > 0.0);
    if (time > 0.0) {
      waypoint.speed = std::min(distance / time, WorldLimits::speed);
      hurried = hurried || distance / time > WorldLimits::speed;
      way += distance;
      walked += distance / waypoint.speed;
    }
    route.waypoints.push_back(waypoint);
  }
  if (walked > 0.0) route.speed = way / walked;
  if (hurried) note("moves faster than 5 m/s, which is the most here");
  if (jumped) note("jumps from one trajectory to the next, and walks here");
  return route;
}

/// A loop ends where it begins.
template <typename Note>
void close(Route& route, const Note& note) {
  Waypoint& first = route.waypoints.front();
  const Waypoint last = route.waypoints.back();
  if ((last.at - first.at).norm() >= kSamePlace) {
    note("jumps back to its first way-point after the last, and walks here");
    return;
  }
  first.speed = last.speed;
  first.pause += last.pause;
  route.waypoints.pop_back();
}

std::vector<Waypoint> waypoints_of(const XmlElement& list) {
  std::vector<Waypoint> waypoints;
  for (const XmlElement* waypoint : list.children_named("waypoint"))
    waypoints.push_back({floor_point(*waypoint), 0.0, 0.0});
  return waypoints;
}

/// There and back again, for a route that loops.
void add_way_back(std::vector<Waypoint>& waypoints) {
  for (std::size_t i = waypoints.size(); i > 2; --i) waypoints.push_back(waypoints[i - 2]);
}

double speed_of(const XmlElement& plugin, double otherwise) {
  const XmlElement* velocity = plugin.child("velocity");
  if (velocity == nullptr) return otherwise;
  const double speed = number(*velocity);
  if (!(speed > 0.0 && speed <= WorldLimits::speed))
    refuse(*velocity,
           "<velocity> is " + velocity->text + "; allowed is more than 0 and up to 5 m/s");
  return speed;
}

Route trajectory_follower(const XmlElement& plugin, const Eigen::Vector2d& start) {
  Route route;
  route.speed = kFollowerSpeed;
  route.loop = flag(plugin, "loop", false);
  if (const XmlElement* list = plugin.child("waypoints")) {
    route.waypoints = waypoints_of(*list);
    if (!route.loop) route.waypoints.insert(route.waypoints.begin(), {start, 0.0, 0.0});
  } else if (const XmlElement* line = plugin.child("line")) {
    const double direction = number(required(*line, "direction"));
    const Eigen::Vector2d way(std::cos(direction), std::sin(direction));
    route.waypoints = {{start, 0.0, 0.0}, {start + length(*line, "length") * way, 0.0, 0.0}};
  } else if (const XmlElement* circle = plugin.child("circle")) {
    const double radius = length(*circle, "radius");
    for (int i = 0; i < kCircleCorners; ++i) {
      const double angle = 2.0 * M_PI * i / kCircleCorners;
      route.waypoints.push_back(
          {start + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)), 0.0, 0.0});
    }
  }
  return route;
}

Route pedestrian(const XmlElement& plugin, const Eigen::Vector2d& start) {
  Route route;
  route.speed = speed_of(plugin, kPedestrianSpeed);
  if (const XmlElement* trajectory = plugin.child("trajectory")) {
    route.waypoints = waypoints_of(*trajectory);
    route.loop = flag(*trajectory, "cyclic", false);
  }
  if (!route.loop) route.waypoints.insert(route.waypoints.begin(), {start, 0.0, 0.0});
  return route;
}

Route obstacle_path(const XmlElement& plugin) {
  Route route;
  route.speed = speed_of(plugin, 1.0);
  if (const XmlElement* path = plugin.child("path")) route.waypoints = waypoints_of(*path);
  if (!flag(plugin, "loop", false)) add_way_back(route.waypoints);
  return route;
}

bool leads_somewhere(const Route& route) {
  return std::any_of(route.waypoints.begin(), route.waypoints.end(), [&](const Waypoint& one) {
    return (one.at - route.waypoints.front().at).norm() >= kSamePlace;
  });
}

}  // namespace

SdfMotion actor_motion(const XmlElement& actor, const Eigen::Isometry3d& pose, SdfNotes& notes) {
  const auto note = [&](const std::string& what) {
    notes.add(actor, "the actor '" + actor.attribute("name") + "' " + what);
  };
  const XmlElement* script = actor.child("script");
  const std::vector<Key> keys = script == nullptr ? std::vector<Key>{} : keys_of_script(*script);
  if (keys.empty()) return {pose, std::nullopt};
  Route route = route_of(keys, note);
  if (route.waypoints.size() < 2) return {keys.front().pose, std::nullopt};
  if (!flag(*script, "auto_start", true)) {
    note("waits for a plugin to start it, and stands here");
    return {keys.front().pose, std::nullopt};
  }
  if (const XmlElement* delay = script->child("delay_start")) {
    route.delay = number(*delay);
    if (!(route.delay >= 0.0 && route.delay <= WorldLimits::pause))
      refuse(*delay, "<delay_start> is " + delay->text + "; allowed are 0 to 3600 s");
  }
  for (const Waypoint& waypoint : route.waypoints)
    if (waypoint.pause > WorldLimits::pause)
      refuse(*script, "the actor '" + actor.attribute("name") +
                          "' stands for more than 3600 s at one place; allowed is up to that");
  const Eigen::Vector2d way = route.waypoints[1].at - route.waypoints[0].at;
  route.loop = flag(*script, "loop", true);
  if (route.loop) close(route, note);
  const Eigen::Vector3d at = keys.front().pose.translation();
  return {generate::at(at.x(), at.y(), at.z(), std::atan2(way.y(), way.x())), std::move(route)};
}

std::optional<SdfMotion> plugin_motion(const XmlElement& plugin, const Eigen::Isometry3d& pose,
                                       SdfNotes& notes) {
  const std::string who = plugin.attribute("filename") + " " + plugin.attribute("name");
  const auto is = [&](const char* word) { return who.find(word) != std::string::npos; };
  const Eigen::Vector2d start = pose.translation().head<2>();
  Route route;
  SdfMotion motion{pose, std::nullopt};
  if (is("trajectory-follower") || is("TrajectoryFollower")) {
    route = trajectory_follower(plugin, start);
  } else if (is("PedestrianSFM")) {
    route = pedestrian(plugin, start);
  } else if (is("obstaclePath")) {
    route = obstacle_path(plugin);
  } else {
    return std::nullopt;
  }
  if (!leads_somewhere(route)) {
    notes.add(plugin, "the plugin gives no way to follow; what it moves stands still");
    return motion;
  }
  if (is("TrajectoryFollower") || is("trajectory-follower"))
    notes.add(plugin, "what the plugin pushes by a force moves here at 1 m/s");
  const Eigen::Vector2d begin = route.waypoints.front().at;
  if ((begin - start).norm() >= kSamePlace)
    notes.add(plugin, "what the plugin moves begins here at its first way-point");
  motion.start.translation().head<2>() = begin;
  motion.route = std::move(route);
  return motion;
}

}  // namespace navvi_sim::read
