#include "cues/route_cues.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace navvi_feedback::cues {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr double kHour = kHourDegrees * kDegree;
constexpr double kHalfHour = kHour / 2.0;
/// m; a goal that moved less is the same goal.
constexpr double kSameGoal = 0.5;
/// rad; a person who hears of a smaller turn turns too far.
constexpr double kWorthSaying = 7.0 * kDegree;
/// rad; who faces elsewhere by so much more has not followed, or did not understand.
constexpr double kWorse = 15.0 * kDegree;
/// m; what is farther ahead than this need not be passed yet.
constexpr double kInTheWay = 1.0;
/// m; what moves about and is nearer than this ahead may soon be to stop for.
constexpr double kComing = 2.5;
/// m; a thing so near is steered away from, wherever the path leads.
constexpr double kTouching = 0.1;
/// m; what is beside the robot and farther off than this is out of reach.
constexpr double kBeside = 0.5;
/// m, by which a thing that was in the way may be farther off before it no longer is.
constexpr double kKept = 0.1;
/// m; a robot that turns with a smaller radius turns on the spot.
constexpr double kSpotRadius = 0.5;
/// m; where a sound leads, a shorter leg needs no words.
constexpr double kLongLeg = 10.0;
/// m; a turn so soon after another is told with it.
constexpr double kNextTurn = 3.0;
/// rad, away from where to steer, and s of driving so: that is the wrong way.
constexpr double kWrongWay = 120.0 * kDegree;
constexpr double kAstray = 1.5;
/// m from the path; nearer than the latter one is on it again.
constexpr double kOffPath = 0.7;
constexpr double kOnPath = 0.4;
/// m/s; who drives on the spot is about to turn.
constexpr double kDrives = 0.1;
/// s, before the same is said again.
constexpr double kStillAstray = 10.0;
/// s; what is ahead for so long is to be driven round.
constexpr double kStillAhead = 6.0;

Rounding rounding_of(const std::string& word) {
  return word == "floor" ? Rounding::floor : Rounding::nearest;
}

}  // namespace

RouteCues::RouteCues(const RouteConfig& config)
    : config_(config),
      rounding_(rounding_of(config.rounding)),
      steady_(rounding_, rounding_ == Rounding::floor ? 0.0 : config.hysteresis_degrees * kDegree) {
}

std::vector<Utterance> RouteCues::update(const Situation& now, bool halted, double time) {
  const Guidance& guidance = *now.guidance;
  by_sound_ = now.sounds.turn;
  const bool other_corner =
      last_ && (guidance.waypoint - last_->waypoint).norm() > config_.same_corner;
  // What was held was the direction to another place.
  if (other_corner) steady_.reset();
  observe(now, halted, time);
  if (!hour_ || !std::isfinite(guidance.waypoint_distance)) return {};
  if (guidance.state != Guidance::State::make_room) made_room_ = false;
  const Change change = last_ ? compare(guidance) : Change::none;
  if (change != Change::none && pending_ != Change::next_corner) pending_ = change;
  if (other_corner && ahead_told_ && change != Change::next_corner)
    fell_away_ = !turn_within_reach(guidance);
  if (change == Change::next_corner) turn_announced_ = ahead_told_;
  if (!last_ || change == Change::next_corner ||
      (other_corner && turn_within_reach(guidance) != turn_said_))
    ahead_told_ = false;
  last_ = guidance;
  if (halted) {
    // The corner of a robot that stands has not been reached: another plan has replaced it.
    pending_ = Change::none;
    return {};
  }
  if (new_goal(guidance)) {
    goal_ = guidance.goal;
    reroutes_ = reroutes_before_ = guidance.reroutes;
    pending_ = Change::none;
    said_hour_.reset();
    Utterance start = goal(CueKind::start, CueKind::start_distance, now);
    if (!by_sound_) return {start};
    // Ticks say where to turn first, but not to drive.
    if (*hour_ == 12) start.also = {*direction(guidance)};
    return {said(start, *hour_, time)};
  }
  return tell(now, time);
}

std::optional<Utterance> RouteCues::go_on(const Situation& now, double time) {
  const Guidance& guidance = *now.guidance;
  std::optional<Utterance> way = direction(guidance);
  if (!way) return std::nullopt;
  if (guidance.state == Guidance::State::make_room) {
    made_room_ = true;
    way->kind = CueKind::make_room;
    way->fillings.thing = guidance.blocked_by.value_or(ThingClass::other);
  } else if (new_goal(guidance)) {
    way->also = {goal(CueKind::goal_info, CueKind::goal_info_distance, now)};
    goal_ = guidance.goal;
    reroutes_ = reroutes_before_ = guidance.reroutes;
  } else if (guidance.reroutes != reroutes_ && way->kind != CueKind::slight) {
    way->kind = closed_way(guidance) ? CueKind::rerouted_blocked : CueKind::rerouted;
  } else if (const auto turn = turn_within_reach(guidance); turn && *hour_ == 12) {
    way = announce_turn(CueKind::straight_then, *way, *turn, time);
  }
  way->goes_on = true;
  way->priority = traits(CueKind::go_on).priority;
  return said(*way, *hour_, time);
}

std::vector<Utterance> RouteCues::tell(const Situation& now, double time) {
  const Guidance& guidance = *now.guidance;
  Utterance way = *direction(guidance);
  if (guidance.state == Guidance::State::make_room && !made_room_) {
    made_room_ = true;
    way.kind = CueKind::make_room;
    way.fillings.thing = guidance.blocked_by.value_or(ThingClass::other);
    return {said(way, *hour_, time)};
  }
  if (turning_) {
    if (by_sound_ || !about_to_face(now) || quiet(now, time)) return {};
    Utterance straight = *direction(guidance);
    straight.kind = CueKind::straight;
    straight.fillings.hour = 12;
    straight.priority = Priority::message;
    if (const auto turn = turn_within_reach(guidance))
      straight = announce_turn(CueKind::straight_then, straight, *turn, time);
    return {said(straight, 12, time)};
  }
  if (pending_ == Change::next_corner && *hour_ != 12) {
    // Ticks lead round what was announced; the words for the leg follow once the robot faces it.
    if (by_sound_ && turn_announced_) return {};
    if (by_sound_ && !worth_words(*hour_)) {
      pending_ = Change::none;
      return {};
    }
    if (leads_off_)
      way.priority = Priority::message;
    else
      way.kind = CueKind::turn_now;
    if (const auto turn = turn_within_reach(guidance);
        turn && config_.join && guidance.waypoint_distance < kNextTurn)
      way.also = {announce_turn(CueKind::turn_ahead, way, *turn, time)};
    return {said(way, *hour_, time)};
  }
  if (by_sound_ && pending_ == Change::reroute) {
    pending_ = Change::none;
    if (guidance.reroutes == reroutes_) return {};
    way.kind = closed_way(guidance) ? CueKind::way_blocked : CueKind::new_route;
    reroutes_before_ = std::exchange(reroutes_, guidance.reroutes);
    return {way};
  }
  if (now.voice_busy) return {};
  if (const auto astray = stray(now, time)) return {*astray};
  if (pending_ == Change::reroute && *hour_ != said_hour_) {
    way.kind = closed_way(guidance) ? CueKind::rerouted_blocked : CueKind::rerouted;
    return {said(way, *hour_, time)};
  }
  const std::optional<int> turn = turn_within_reach(guidance);
  if (fell_away_ && !turn && *hour_ == 12) {
    way.kind = CueKind::turn_cancelled;
    return {said(way, *hour_, time)};
  }
  if (direction_due(now, time)) {
    // Who is told "straight ahead" just before a turn drives past it.
    if (turn && *hour_ == 12) return {announce_turn(CueKind::straight_then, way, *turn, time)};
    // The route changed while the person waited.
    if (!said_hour_ && guidance.reroutes != reroutes_ && way.kind != CueKind::slight)
      way.kind = closed_way(guidance) ? CueKind::rerouted_blocked : CueKind::rerouted;
    return {said(way, *hour_, time)};
  }
  if (turn && !ahead_told_ && turn_ahead_due(guidance, *turn, time))
    return {announce_turn(CueKind::turn_ahead, way, *turn, time)};
  return {};
}

/// Driving the wrong way, or beside the path, told with the way back.
std::optional<Utterance> RouteCues::stray(const Situation& now, double time) {
  const Guidance& guidance = *now.guidance;
  const bool drives = now.measured && now.measured->linear > kDrives;
  const bool wrong = drives && std::abs(guidance.steer_angle) > kWrongWay;
  const double limit = astray_ == CueKind::off_path ? kOnPath : kOffPath;
  std::optional<CueKind> kind;
  if (guidance.path_offset > limit) kind = CueKind::off_path;
  if (wrong) kind = CueKind::wrong_way;
  if (kind != astray_) {
    astray_ = kind;
    astray_since_ = time;
    astray_said_.reset();
  }
  // Where words alone lead, they would take the place of the direction.
  if (!by_sound_ || !astray_ || time - astray_since_ < kAstray || !drives) return {};
  if (astray_said_ && time - *astray_said_ < kStillAstray) return {};
  astray_said_ = time;
  Utterance told = *direction(guidance);
  told.kind = *astray_;
  told.fillings.side = guidance.steer_angle > 0.0 ? Side::right : Side::left;
  if (!wrong) told.fillings.distance = guidance.path_offset;
  return said(told, *hour_, time);
}

Utterance RouteCues::announce_turn(CueKind kind, Utterance way, int turn, double time) {
  way.kind = kind;
  way.fillings.hour = turn;
  turn_said_ = turn;
  turn_said_time_ = time;
  ahead_told_ = true;
  return said(way, *hour_, time);
}

std::optional<Utterance> RouteCues::ask(const Guidance& guidance, double time) {
  const std::optional<Utterance> answer = direction(guidance);
  // An answer need not be said again by itself.
  if (answer) said(*answer, *answer->fillings.hour, time);
  return answer;
}

std::optional<Utterance> RouteCues::direction(const Guidance& guidance) const {
  // The held hour, so that what is asked for agrees with what was said; a fresh one where none is.
  const auto hour = hour_ ? hour_ : clock_hour(guidance.steer_angle, rounding_);
  if (!hour || !std::isfinite(guidance.waypoint_distance)) return std::nullopt;
  Utterance utterance;
  utterance.kind = leads_off_    ? CueKind::slight
                   : *hour == 12 ? CueKind::straight
                                 : CueKind::direction;
  utterance.fillings.hour = hour;
  utterance.fillings.side = *hour < 6 ? Side::right : Side::left;
  utterance.fillings.distance = std::max(0.0, guidance.waypoint_distance);
  return utterance;
}

Utterance RouteCues::next_turn(const Guidance& guidance) const {
  Utterance turn{CueKind::turn_ahead};
  turn.fillings.hour = hour_of(guidance.turn_angle);
  turn.fillings.distance = std::max(0.0, guidance.waypoint_distance);
  return turn;
}

Utterance RouteCues::goal(CueKind kind, CueKind without_hour, const Situation& now) const {
  Utterance utterance;
  utterance.fillings.distance = std::max(0.0, now.guidance->goal_distance);
  if (now.goal_angle) utterance.fillings.hour = clock_hour(*now.goal_angle, rounding_);
  utterance.kind = utterance.fillings.hour ? kind : without_hour;
  return utterance;
}

void RouteCues::pause() {
  last_.reset();
  said_hour_.reset();
  hour_.reset();
  steady_.reset();
  pending_ = Change::none;
  fell_away_ = made_room_ = false;
}

void RouteCues::forget() {
  pause();
  goal_.reset();
}

void RouteCues::remind(double time) { reminder_ = time; }

void RouteCues::unsaid() {
  said_hour_.reset();
  made_room_ = ahead_told_ = false;
}

void RouteCues::unheard() {
  unsaid();
  reroutes_ = reroutes_before_;
}

void RouteCues::route_unheard() {
  reroutes_ = reroutes_before_;
  pending_ = Change::reroute;
  if (!by_sound_) said_hour_.reset();
}

/// Who has just heard of what is ahead is not told to drive at it.
bool RouteCues::quiet(const Situation& now, double time) const {
  if (!config_.join || !reminder_ || time >= *reminder_ + kStillAhead) return false;
  const double free = std::min(kInTheWay, now.guidance->waypoint_distance);
  return time < *reminder_ ||
         std::any_of(now.nearby.begin(), now.nearby.end(), [&](const NearThing& thing) {
           return thing.gap < free && side_of_lane(thing.nearest) == Side::ahead;
         });
}

/// Something that moves about is near in the lane ahead.
bool RouteCues::comes_ahead(const Situation& now) const {
  const double free = std::min(kComing, now.guidance->waypoint_distance);
  return std::any_of(now.nearby.begin(), now.nearby.end(), [&](const NearThing& thing) {
    return thing.moving && thing.gap < free && side_of_lane(thing.nearest) == Side::ahead;
  });
}

bool RouteCues::new_goal(const Guidance& guidance) const {
  return !goal_ || (guidance.goal - *goal_).norm() > kSameGoal;
}

/// True if a reroute that was not said yet was made because something blocks the old path.
bool RouteCues::closed_way(const Guidance& guidance) const {
  return guidance.reroutes != reroutes_ &&
         (guidance.reroute_reason == Guidance::Replan::path_carved ||
          guidance.reroute_reason == Guidance::Replan::waypoint_blocked);
}

RouteCues::Change RouteCues::compare(const Guidance& guidance) const {
  if ((guidance.waypoint - last_->waypoint).norm() <= config_.same_corner) return Change::none;
  const bool rerouted = guidance.reroutes != last_->reroutes;
  if (last_->waypoint_distance <= config_.turn_now && !rerouted) return Change::next_corner;
  // Seen from one place at one instant: only the plan can have changed the hour.
  const double moved = std::remainder(guidance.waypoint_angle - last_->waypoint_angle, 2.0 * kPi);
  return std::abs(moved) > kHalfHour ? Change::reroute : Change::none;
}

void RouteCues::observe(const Situation& now, bool halted, double time) {
  hour_ = steady_.update(now.guidance->steer_angle);
  const bool ahead = hour_ == 12 && rounding_ == Rounding::nearest;
  // Who is about to be told to go on is led off sooner.
  if (ahead) hour_ = clear_of_things(now, leads_off_ || halted);
  leads_off_ = ahead && hour_ != 12;
  const auto beyond = [](double value, double limit) { return std::abs(value) > limit; };
  if (beyond(now.commanded.linear, 0.02) || beyond(now.commanded.angular, 0.05))
    last_commanded_ = time;
  const bool spot = now.measured && beyond(now.measured->angular, config_.turning_rate) &&
                    !beyond(now.measured->linear, kSpotRadius * std::abs(now.measured->angular));
  if (spot) last_turning_ = time;
  turning_ = last_turning_ && time - *last_turning_ < config_.settle;
}

/// After "straight ahead" a person drives on along the robot's heading. If that leads into a thing,
/// along one that is all but touched,
/// or along one that the path leaves, the hour on the path's side is nearer to the truth, however
/// small the angle; unless something blocks that side, too. Held like any hour.
int RouteCues::clear_of_things(const Situation& now, bool held) const {
  const double angle = now.guidance->steer_angle;
  const double touched = held ? 2.0 * kTouching : kTouching;
  for (const NearThing& thing : now.nearby) {
    const Side side = side_of(thing.nearest);
    if (thing.gap > touched || side == Side::ahead || side == Side::behind) continue;
    const double away = side == Side::left ? 1.0 : -1.0;
    const bool room = std::none_of(now.nearby.begin(), now.nearby.end(), [&](const auto& other) {
      return away * other.nearest.y() < 0.0 && other.gap < 2.0 * touched;
    });
    if (room && away * angle > -kWorthSaying) return away > 0.0 ? 1 : 11;
  }
  if (std::abs(angle) < (held ? 0.5 : 1.0) * kWorthSaying) return 12;
  const double side = angle > 0.0 ? 1.0 : -1.0;
  const double kept = held ? kKept : 0.0;
  const double ahead = std::min(kInTheWay, now.guidance->waypoint_distance);
  bool in_the_way = false;
  for (const NearThing& thing : now.nearby) {
    if (thing.nearest.x() <= 0.0) continue;
    const double beyond = side * (-std::atan2(thing.nearest.y(), thing.nearest.x()) - angle);
    if (thing.gap < ahead && beyond > 0.0 && beyond < kHour) return 12;
    const bool before = thing.gap < ahead + kept && std::abs(thing.nearest.y()) < kHalfLane + kept;
    const bool left_behind = thing.gap < kBeside + kept && side * thing.nearest.y() > 0.0;
    in_the_way = in_the_way || before || left_behind;
  }
  if (!in_the_way) return 12;
  return angle > 0.0 ? 1 : 11;
}

bool RouteCues::about_to_face(const Situation& now) const {
  if (said_hour_ == 12 || !now.measured) return false;
  // A turn by one hour is made in one go: there is nothing to stop it by.
  if (said_hour_ == 1 || said_hour_ == 11) return false;
  const double angle = now.guidance->steer_angle;
  // Turning left makes what lies ahead wander clockwise.
  const double soon = angle + now.measured->angular * config_.straight_lead;
  const bool faces = std::abs(std::remainder(soon, 2.0 * kPi)) <= kHalfHour;
  const bool crosses = angle * soon < 0.0;
  // A person who hears it more than an hour too early stops short and needs another cue.
  return std::abs(angle) <= 2.0 * kHalfHour && (faces || crosses);
}

bool RouteCues::passes_within_reach(const Guidance& guidance) const {
  const double across = guidance.waypoint_distance * std::sin(std::abs(guidance.waypoint_angle));
  return std::abs(guidance.waypoint_angle) < kPi / 3.0 && across < config_.reach &&
         guidance.waypoint_distance < config_.turn_now;
}

bool RouteCues::at_hand(const Guidance& guidance, double time) const {
  const auto ahead = [](std::optional<int> hour) { return hour && (*hour >= 11 || *hour == 1); };
  return guidance.waypoint_distance < config_.at_hand && ahead(hour_) && ahead(said_hour_) &&
         time - last_commanded_ <= config_.idle;
}

/// The hour of the turn at the next way-point, if it is near enough to be announced.
std::optional<int> RouteCues::turn_within_reach(const Guidance& guidance) const {
  const auto turn = clock_hour(guidance.turn_angle, rounding_);
  if (guidance.waypoint_is_goal || !turn || !worth_words(*turn) ||
      guidance.waypoint_distance > config_.turn_ahead)
    return std::nullopt;
  return turn;
}

/// A bend that a sound leads round needs no words.
bool RouteCues::worth_words(int hour) const {
  const bool bend = hour == 1 || hour == 11;
  return hour != 12 && !(bend && by_sound_);
}

bool RouteCues::turn_ahead_due(const Guidance& guidance, int turn, double time) const {
  if (*hour_ != 12 || guidance.waypoint_distance <= config_.turn_now) return false;
  if (turn == turn_said_ && time - turn_said_time_ < config_.same_turn) return false;
  return time - said_time_ >= config_.pause;
}

bool RouteCues::direction_due(const Situation& now, double time) const {
  const Guidance& guidance = *now.guidance;
  // Ticks lead anyway, and a word to stop may follow.
  if (by_sound_ && *hour_ == 12 && comes_ahead(now)) return false;
  if (!said_hour_) return true;
  const double since = time - said_time_;
  if (since < config_.pause) return false;
  if (*hour_ == 12 && quiet(now, time)) return false;
  if (reminder_ && time >= *reminder_) return true;
  if (at_hand(guidance, time)) return false;
  const bool corner_reached = pending_ == Change::next_corner;
  const bool idle = time - last_commanded_ > config_.idle;
  // A leg has words once, at its begin; a short one has those of its end.
  if (by_sound_ && !idle) return corner_reached && guidance.waypoint_distance >= kLongLeg;
  if (corner_reached) return true;
  const bool worse =
      *hour_ != 12 && std::abs(guidance.steer_angle) > std::abs(said_angle_) + kWorse;
  const bool wrong = hour_ != said_hour_ || worse;
  if (wrong && !by_sound_ && !passes_within_reach(guidance)) return true;
  const bool ahead = *hour_ == 12 || leads_off_;
  if (idle) return since >= 2.0 * config_.repeat_direction;
  return since >= (ahead ? config_.repeat_straight : config_.repeat_direction);
}

Utterance RouteCues::said(Utterance utterance, int hour, double time) {
  said_hour_ = hour;
  said_time_ = time;
  said_angle_ = last_ ? last_->steer_angle : 0.0;
  // Whose way has been told is no news later on.
  if (last_) reroutes_before_ = std::exchange(reroutes_, last_->reroutes);
  pending_ = Change::none;
  fell_away_ = false;
  reminder_.reset();
  return utterance;
}

}  // namespace navvi_feedback::cues
