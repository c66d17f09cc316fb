#include "read/sdf_motion.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "description/validate.hpp"
#include "generate/furniture.hpp"
#include "read/sdf_value.hpp"
#include "traffic/lanes.hpp"

namespace navvi_sim::read {
namespace {

constexpr int kMaxRounds = 4;

/// Finds which of the things with a route can keep it.
class RouteFilter {
 public:
  RouteFilter(const WorldDescription& world, const std::vector<std::string>& places,
              SdfNotes& notes)
      : world_(world), places_(places), notes_(notes) {
    for (std::size_t i = 0; i < world.things.size(); ++i)
      if (world.things[i].route) movers_.push_back(i);
  }

  /// The things that must stand.
  [[nodiscard]] std::set<std::size_t> things_without_route() {
    // A thing without its route then stands in the way of others.
    for (int round = 0; round < kMaxRounds; ++round) {
      driving_.clear();
      std::vector<std::size_t> hopeful;
      for (const std::size_t mover : movers_)
        if (standing_.count(mover) == 0) hopeful.push_back(mover);
      try_all(hopeful);
      if (objection({}).empty()) return standing_;
    }
    for (const std::size_t mover : movers_) give_up(mover, "too many others are in its way");
    return standing_;
  }

 private:
  /// Why the driving things and `more` cannot drive together; empty if they can.
  [[nodiscard]] std::string objection(const std::vector<std::size_t>& more) const {
    WorldDescription world;
    world.name = world_.name;
    world.floor_height = world_.floor_height;
    for (std::size_t i = 0; i < world_.things.size(); ++i) {
      const Thing& thing = world_.things[i];
      const bool drives =
          driving_.count(i) > 0 || std::find(more.begin(), more.end(), i) != more.end();
      const bool stands = !thing.route || standing_.count(i) > 0;
      if (!drives && !stands) continue;
      world.things.push_back(thing);
      if (!drives) world.things.back().route.reset();
    }
    try {
      static_cast<void>(traffic::lay_lanes(world, {}));
    } catch (const WorldError& error) {
      return error.what();
    }
    return "";
  }

  void try_all(const std::vector<std::size_t>& batch) {
    if (batch.empty()) return;
    const std::string why = objection(batch);
    if (why.empty()) {
      driving_.insert(batch.begin(), batch.end());
    } else if (batch.size() == 1) {
      give_up(batch[0], why);
    } else {
      const auto half = batch.begin() + static_cast<std::ptrdiff_t>(batch.size() / 2);
      try_all({batch.begin(), half});
      try_all({half, batch.end()});
    }
  }

  void give_up(std::size_t mover, const std::string& why) {
    if (standing_.insert(mover).second)
      notes_.add(places_[mover],
                 "'" + world_.things[mover].name +
                     "' stands where its way begins, since it cannot drive it: " + why);
  }

  const WorldDescription& world_;
  const std::vector<std::string>& places_;
  SdfNotes& notes_;
  std::vector<std::size_t> movers_;
  std::set<std::size_t> driving_;
  std::set<std::size_t> standing_;
};

constexpr double kSamePlace = 0.01;  // m

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

}  // namespace

void keep_routes_that_can_be_driven(WorldDescription& world, const std::vector<std::string>& places,
                                    SdfNotes& notes) {
  for (const std::size_t thing : RouteFilter(world, places, notes).things_without_route())
    world.things[thing].route.reset();
}

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

}  // namespace navvi_sim::read
