#include "guide/conflict_forecast.hpp"

#include <algorithm>

#include "guide/cylinders.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kStep = 0.25;        // s, of the forecast
constexpr double kChase = 3.0;        // s, what comes from behind and would hit later may turn off
constexpr double kSpareRoom = 0.05;   // m, for paths that are not followed exactly
constexpr double kHeadway = 1.5;      // m, what drives on so far ahead of the robot is no conflict,
constexpr double kHeadwayGain = 0.5;  // m, if it moves so far along the path by foresight
constexpr int kMostPlaces = 64;       // that one obstacle is predicted in
constexpr double kRounding = 1e-6;    // m
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The point `along` m down the path, or its end.
Point point_at(const Path& path, double along) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = distance(path[i - 1], path[i]);
    if (along < length) return path[i - 1] + (along / length) * (path[i] - path[i - 1]);
    along -= length;
  }
  return path.back();
}

}  // namespace

/// The cylinders of one thing: they follow each other.
struct ConflictForecast::Thing {
  const Cylinder* first;
  const Cylinder* last;  ///< one beyond

  [[nodiscard]] const Cylinder* begin() const { return first; }
  [[nodiscard]] const Cylinder* end() const { return last; }
  [[nodiscard]] Point velocity() const { return first->velocity; }
  /// m, from a point to its hull in so many s
  [[nodiscard]] double gap(Point point, double later) const {
    double best = kNever;
    for (const Cylinder& part : *this)
      best = std::min(best, distance(point, part.center + later * velocity()) - part.radius);
    return best;
  }
  template <typename Visit>
  static void each(const std::vector<Cylinder>& cylinders, Visit visit) {
    const Cylinder* const end = cylinders.data() + cylinders.size();
    for (const Cylinder* first = cylinders.data(); first != end;) {
      const Cylinder* last = first + 1;
      while (last != end && last->id == first->id) ++last;
      visit(Thing{first, last});
      first = last;
    }
  }
};

/// What one thing does to a path and to the robot on it.
struct ConflictForecast::Encounter {
  Conflict::State state = Conflict::State::clear;
  std::optional<double> cut;            ///< m, along the path to where it cuts it now
  double at = 0.0;                      ///< m, along the path to the first cut
  double time_to_meeting = 0.0;         ///< s
  double time_to_clear = 0.0;           ///< s, until it has left the path
  double time_to_collision = kNever;    ///< s, with elbow_room
  double time_to_touch = kNever;        ///< s, with no more than stop_room
  double time_to_hit_waiting = kNever;  ///< s
  bool ends = true;                     ///< it leaves the path

  [[nodiscard]] bool hits_waiting() const { return time_to_hit_waiting < kNever; }
};

void ConflictForecastConfig::describe(navvi_config::Visitor& visit) {
  visit(look_ahead, "look_ahead", navvi_config::Range{0.5, 1e6}, "m",
        "obstacles on the path farther ahead than this are left to move away");
}

/// Neither driving on nor waiting is safe, and it was not seen to come.
bool ConflictForecast::must_be_evaded(const Encounter& one) const {
  const bool from_behind =
      one.state != Conflict::State::oncoming && one.time_to_hit_waiting <= kChase;
  return one.hits_waiting() && one.time_to_collision < kNever && (one.ends || from_behind);
}

/// m, between the centres of a cylinder and of a robot that just touch
double ConflictForecast::room(const Cylinder& obstacle) const {
  return obstacle.radius + config_.robot_radius - config_.kTolerance;
}

/// m along the path to where it comes nearer to `center` than `room`.
std::optional<double> ConflictForecast::cut_at(const Path& path, Point center, double room) const {
  double before = 0.0;
  for (std::size_t i = 1; i < path.size() && before < config_.look_ahead; ++i) {
    const double left = config_.look_ahead - before;
    const double length = distance(path[i - 1], path[i]);
    const double share = length > left ? left / length : 1.0;
    const Point end = path[i - 1] + share * (path[i] - path[i - 1]);
    const Point nearest = nearest_on_segment(center, path[i - 1], end);
    const double gap = distance(center, nearest);
    if (gap < room) {
      const double chord = std::sqrt(room * room - gap * gap);
      return before + std::max(0.0, distance(path[i - 1], nearest) - chord);
    }
    before += length;
  }
  return std::nullopt;
}

/// m along the path to where it cuts it in so many s. A robot that is nearer than that now is cut
/// off by a thing that comes nearer still.
std::optional<double> ConflictForecast::cut_at(const Path& path, const Thing& thing,
                                               double later) const {
  std::optional<double> first;
  for (const Cylinder& part : thing) {
    const double now = distance(path.front(), part.center) - kRounding;
    const std::optional<double> cut =
        cut_at(path, part.center + later * part.velocity, std::min(room(part), now));
    if (cut && (!first || *cut < *first)) first = cut;
  }
  return first;
}

bool ConflictForecast::taken(Point place, const std::vector<Cylinder>& obstacles) const {
  return std::any_of(obstacles.begin(), obstacles.end(), [&](const Cylinder& obstacle) {
    return distance(place, obstacle.center) < room(obstacle);
  });
}

ConflictForecast::Encounter ConflictForecast::encounter(const Path& path, const Thing& thing,
                                                        double pace) const {
  Encounter out;
  // Most things are too far off to come near the robot or what is looked at of its path.
  const double far = config_.look_ahead + config_.kForesight * norm(thing.velocity()) +
                     config_.robot_radius + config_.kStopRoom + kRounding;
  if (thing.gap(path.front(), 0.0) > far) return out;
  const std::optional<double> now = cut_at(path, thing, 0.0);
  out.cut = now;
  if (norm(thing.velocity()) <= kStandingSpeed) return now ? standing(thing, *now, pace) : out;
  const double touch = config_.robot_radius;
  std::optional<double> first = now;
  std::optional<double> last = now;
  double last_time = 0.0;
  double noticed = now ? 0.0 : config_.kForesight;  // s, when it first cuts the path
  bool keeps_ahead = now.has_value();
  for (double t = kStep; t <= config_.kForesight + 1e-9; t += kStep) {
    if (thing.gap(path.front(), t) < touch + config_.kStopRoom)
      out.time_to_hit_waiting = std::min(out.time_to_hit_waiting, t);
    const std::optional<double> cut = cut_at(path, thing, t);
    if (!cut) continue;
    const double near = touch + config_.kElbowRoom;
    const bool hits = thing.gap(point_at(path, pace * t), t) < near ||
                      (t > config_.kLateTime &&
                       thing.gap(point_at(path, pace * (t - config_.kLateTime)), t) < near);
    if (hits) out.time_to_collision = std::min(out.time_to_collision, t);
    if (thing.gap(point_at(path, pace * t), t) < touch + config_.kStopRoom)
      out.time_to_touch = std::min(out.time_to_touch, t);
    if (!first) {
      first = cut;
      noticed = t;
    }
    last = cut;
    last_time = t;
    keeps_ahead = keeps_ahead && *cut >= pace * t + kHeadway;
  }
  if (!first) return out;
  out.at = *first;
  out.time_to_clear = last_time + kStep;
  out.time_to_meeting = *first / (pace + norm(thing.velocity()));
  out.ends = out.time_to_clear <= config_.kForesight + 1e-9 ||
             (keeps_ahead && *last >= *first + kHeadwayGain);
  if (out.ends && noticed <= config_.kNoticeTime + 1e-9) out.state = Conflict::State::crossing;
  if (!out.ends && now) out.state = Conflict::State::oncoming;
  return out;
}

/// What a standing thing does that cuts the path: what has stood for long will stand for long.
ConflictForecast::Encounter ConflictForecast::standing(const Thing& thing, double cut,
                                                       double pace) const {
  Encounter out;
  const double there = cut / pace;
  const double stood = thing.first->stood;
  const bool pauses = stood < config_.kPause || there > std::max(config_.kPause, stood);
  out.state = pauses ? Conflict::State::oncoming : Conflict::State::stationary;
  out.cut = out.at = cut;
  out.time_to_meeting = out.time_to_collision = there;
  out.ends = false;
  return out;
}

Conflict ConflictForecast::forecast(const Path& path, const std::vector<Cylinder>& obstacles,
                                    double pace) const {
  Conflict out;
  double time_to_touch = kNever;
  double time_to_hit_waiting = kNever;
  if (path.size() < 2) return out;
  Thing::each(obstacles, [&](const Thing& thing) {
    const Encounter one = encounter(path, thing, pace);
    time_to_touch = std::min(time_to_touch, one.time_to_touch);
    time_to_hit_waiting = std::min(time_to_hit_waiting, one.time_to_hit_waiting);
    out.time_to_collision = std::min(out.time_to_collision, one.time_to_collision);
    if (one.cut && (!out.cut || *one.cut < out.cut->at))
      out.cut = Conflict::Cut{thing.first->id, *one.cut};
    out.hits_waiting = out.hits_waiting || one.hits_waiting();
    const bool moves = norm(thing.velocity()) > kStandingSpeed;
    if (moves && one.time_to_collision < kNever && (!out.wait_for || one.at < out.wait_for->at))
      out.wait_for = Blocker{thing.first->id, one.at,
                             one.ends ? std::optional(one.time_to_clear) : std::nullopt};
    if (one.state == Conflict::State::clear) return;
    if (out.state == Conflict::State::clear || one.at < out.at) out.at = one.at;
    if (one.state == Conflict::State::oncoming &&
        (out.time_to_meeting <= 0.0 || one.time_to_meeting < out.time_to_meeting))
      out.time_to_meeting = one.time_to_meeting;
    out.state = std::max(out.state, one.state);
  });
  // Waiting must not lead to an earlier collision than driving on.
  if (out.hits_waiting && time_to_hit_waiting <= time_to_touch) out.wait_for.reset();
  out.waypoint_taken =
      distance(path[0], path[1]) <= config_.look_ahead && taken(path[1], obstacles);
  return out;
}

std::vector<Cylinder> ConflictForecast::predicted(const Path& path,
                                                  const std::vector<Cylinder>& obstacles,
                                                  double pace) const {
  std::vector<Cylinder> out;
  if (path.size() < 2) return out;
  Thing::each(obstacles, [&](const Thing& thing) {
    const Encounter one = encounter(path, thing, pace);
    const bool evades = must_be_evaded(one);
    if (one.state != Conflict::State::oncoming && !evades) return;
    const double speed = norm(thing.velocity());
    if (speed <= kStandingSpeed) return;
    const double leaves = one.ends ? one.time_to_clear : config_.kForesight;
    const double end = evades ? leaves : one.time_to_meeting + config_.kLateTime;
    const double step = std::max(std::max(thing.first->radius, config_.robot_radius) / speed,
                                 end / kMostPlaces);  // s
    const double spare = 2.0 * config_.robot_radius + config_.kElbowRoom;
    for (double t = std::min(step, end); t <= end + 1e-9; t += step) {
      if (thing.gap(path.front(), t) < spare) {
        if (one.ends || !evades) break;
        continue;  // it drives on beyond a robot on its way
      }
      for (Cylinder part : thing) {
        part.center = part.center + t * part.velocity;
        part.radius += config_.kElbowRoom + kSpareRoom;
        out.push_back(part);
      }
    }
  });
  return out;
}

}  // namespace navvi_nav::guide
