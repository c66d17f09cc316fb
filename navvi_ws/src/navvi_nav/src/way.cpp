#include "navvi_nav/way.hpp"

#include <algorithm>
#include <limits>

namespace navvi_nav {
namespace {

constexpr double kTick = 0.25;      // s, of looking ahead
constexpr double kStopRoom = 0.1;   // m, from who waits to what passes
constexpr double kNotice = 1.0;     // s, what will cut the path so soon cuts it
constexpr double kElbowRoom = 0.2;  // m, between hulls that pass each other
constexpr double kHeadway = 1.5;    // m, that what goes on ahead must keep before the robot
constexpr double kSpare = 0.05;     // m, for paths that are not quite followed
constexpr double kLate = 1.0;       // s, so much later a robot may be
constexpr double kSame = 1e-6;      // m
constexpr double kGained = 0.5;     // m, that what goes on ahead must have gained
constexpr double kChased = 3.0;     // s, what comes from behind later may still turn off
constexpr int kMostPlaces = 64;     // foreseen of one thing
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
struct WayAhead::Thing {
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

/// What one thing does to a path.
struct WayAhead::Meeting {
  Way::State state = Way::State::free;
  double at = 0.0;                  ///< m, along the path to the first cut
  double meets_in = 0.0;            ///< s
  double clears_in = 0.0;           ///< s, until it has left the path
  double hits_in = kNever;          ///< s
  double touches_in = kNever;       ///< s, until it does so with no room at all
  double hits_waiting_in = kNever;  ///< s
  bool ends = true;                 ///< it leaves the path

  [[nodiscard]] bool hits_waiting() const { return hits_waiting_in < kNever; }
  /// Neither going on nor waiting is safe, and it was not seen to come.
  [[nodiscard]] bool must_be_evaded() const {
    const bool from_behind = state != Way::State::comes && hits_waiting_in <= kChased;
    return hits_waiting() && hits_in < kNever && (ends || from_behind);
  }
};

void WayConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"tolerance", Range{0.0, 0.5}, "m", "how far an obstacle may reach into the path's room"},
        tolerance);
  visit({"look_ahead", Range{0.5, 1e6}, "m",
         "obstacles on the path farther ahead than this are left to move away"},
        look_ahead);
  visit({"standing_speed", Range{0.0, 2.0}, "m/s", "what is slower stands"}, standing_speed);
  visit({"pause", Range{0.0, 60.0}, "s",
         "what moved and has stood for less, or for less than it takes to get there, may go on"},
        pause);
  visit({"foresight", Range{0.0, 20.0}, "s",
         "what will have left the path within this time, keeping its velocity, only crosses"},
        foresight);
}

/// m, from a cylinder's centre, nearer than which a robot's touches it
double WayAhead::room(const Cylinder& obstacle) const {
  return obstacle.radius + config_.robot_radius - config_.tolerance;
}

/// m along the path to where it comes nearer to `center` than `room`.
std::optional<double> WayAhead::cut_at(const Path& path, Point center, double room) const {
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

/// m along the path to where it cuts it in so many s. Who is nearer than that now is cut off by
/// what comes nearer still.
std::optional<double> WayAhead::cut_at(const Path& path, const Thing& thing, double later) const {
  std::optional<double> first;
  for (const Cylinder& part : thing) {
    const double now = distance(path.front(), part.center) - kSame;
    const std::optional<double> cut =
        cut_at(path, part.center + later * part.velocity, std::min(room(part), now));
    if (cut && (!first || *cut < *first)) first = cut;
  }
  return first;
}

std::optional<WayAhead::Cut> WayAhead::first_cut(const Path& path,
                                                 const std::vector<Cylinder>& obstacles) const {
  std::optional<Cut> first;
  if (path.size() < 2) return first;
  Thing::each(obstacles, [&](const Thing& thing) {
    const std::optional<double> at = cut_at(path, thing, 0.0);
    if (at && (!first || *at < first->at)) first = Cut{thing.first->id, *at};
  });
  return first;
}

bool WayAhead::taken(Point place, const std::vector<Cylinder>& obstacles) const {
  return std::any_of(obstacles.begin(), obstacles.end(), [&](const Cylinder& obstacle) {
    return distance(place, obstacle.center) < room(obstacle);
  });
}

WayAhead::Meeting WayAhead::meet(const Path& path, const Thing& thing, double pace) const {
  Meeting out;
  const std::optional<double> now = cut_at(path, thing, 0.0);
  if (norm(thing.velocity()) <= config_.standing_speed) {
    if (!now) return out;
    // What has stood for long will stand for long.
    const double there = now.value() / pace;
    const double stood = thing.first->stood;
    const bool pauses = stood < config_.pause || there > std::max(config_.pause, stood);
    out = {pauses ? Way::State::comes : Way::State::stands, *now, there, 0.0, there};
    out.ends = false;
    return out;
  }
  const double touch = config_.robot_radius;
  std::optional<double> first = now;
  std::optional<double> last = now;
  double last_time = 0.0;
  double noticed = now ? 0.0 : config_.foresight;  // s, when it first cuts the path
  bool keeps_ahead = now.has_value();
  for (double t = kTick; t <= config_.foresight + 1e-9; t += kTick) {
    if (thing.gap(path.front(), t) < touch + kStopRoom)
      out.hits_waiting_in = std::min(out.hits_waiting_in, t);
    const std::optional<double> cut = cut_at(path, thing, t);
    if (!cut) continue;
    const double near = touch + kElbowRoom;
    const bool hits = thing.gap(point_at(path, pace * t), t) < near ||
                      (t > kLate && thing.gap(point_at(path, pace * (t - kLate)), t) < near);
    if (hits) out.hits_in = std::min(out.hits_in, t);
    if (thing.gap(point_at(path, pace * t), t) < touch + kStopRoom)
      out.touches_in = std::min(out.touches_in, t);
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
  out.clears_in = last_time + kTick;
  out.meets_in = *first / (pace + norm(thing.velocity()));
  out.ends =
      out.clears_in <= config_.foresight + 1e-9 || (keeps_ahead && *last >= *first + kGained);
  if (out.ends && noticed <= kNotice + 1e-9) out.state = Way::State::clears;
  if (!out.ends && now) out.state = Way::State::comes;
  return out;
}

Way WayAhead::judge(const Path& path, const std::vector<Cylinder>& obstacles, double pace) const {
  Way out;
  double touches_in = kNever;
  double hits_waiting_in = kNever;
  if (path.size() < 2) return out;
  Thing::each(obstacles, [&](const Thing& thing) {
    const Meeting one = meet(path, thing, pace);
    touches_in = std::min(touches_in, one.touches_in);
    hits_waiting_in = std::min(hits_waiting_in, one.hits_waiting_in);
    out.hits_in = std::min(out.hits_in, one.hits_in);
    out.hits_waiting = out.hits_waiting || one.hits_waiting();
    const bool moves = norm(thing.velocity()) > config_.standing_speed;
    if (moves && one.hits_in < kNever && (!out.wait || one.at < out.wait->at))
      out.wait = Way::Wait{thing.first->id, one.at, one.ends ? one.clears_in : -1.0};
    if (one.state == Way::State::free) return;
    if (out.state == Way::State::free || one.at < out.at) out.at = one.at;
    if (one.state == Way::State::comes && (out.meets_in <= 0.0 || one.meets_in < out.meets_in))
      out.meets_in = one.meets_in;
    out.state = std::max(out.state, one.state);
  });
  // Who waits must not be run into sooner than who goes on.
  if (out.hits_waiting && hits_waiting_in <= touches_in) out.wait.reset();
  return out;
}

std::vector<Cylinder> WayAhead::foreseen(const Path& path, const std::vector<Cylinder>& obstacles,
                                         double pace) const {
  std::vector<Cylinder> out;
  if (path.size() < 2) return out;
  Thing::each(obstacles, [&](const Thing& thing) {
    const Meeting one = meet(path, thing, pace);
    const bool evades = one.must_be_evaded();
    if (one.state != Way::State::comes && !evades) return;
    const double speed = norm(thing.velocity());
    if (speed <= config_.standing_speed) return;
    const double leaves = one.ends ? one.clears_in : config_.foresight;
    const double end = evades ? leaves : one.meets_in + kLate;
    const double step = std::max(std::max(thing.first->radius, config_.robot_radius) / speed,
                                 end / kMostPlaces);  // s
    const double spare = 2.0 * config_.robot_radius + kElbowRoom;
    for (double t = std::min(step, end); t <= end + 1e-9; t += step) {
      if (thing.gap(path.front(), t) < spare) {
        if (one.ends || !evades) break;
        continue;  // it goes on beyond who is on its way
      }
      for (Cylinder part : thing) {
        part.center = part.center + t * part.velocity;
        part.radius += kElbowRoom + kSpare;
        out.push_back(part);
      }
    }
  });
  return out;
}

}  // namespace navvi_nav
