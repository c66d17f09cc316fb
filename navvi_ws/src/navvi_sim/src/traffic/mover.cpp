#include "traffic/mover.hpp"

#include <algorithm>
#include <cmath>

#include "description/hash.hpp"

namespace navvi_sim::traffic {
namespace {

constexpr double kSideMargin = 0.20;  // m, left beside what is passed
constexpr double kLook = 0.1;         // m, between the places looked at ahead
constexpr int kHalvings = 4;          // of the stretch in which it would touch
constexpr double kForesight = 0.5;    // s, that a disc is foreseen beyond the time to stop
constexpr int kMostForeseen = 8;      // places of a disc
constexpr double kThere = 1e-9;       // m, nearer is there

/// m, from the disc to the box around a body that stands at `place`.
double gap_to(const Disc& disc, const Pose2& place, const Footprint& print) {
  const Eigen::Vector2d away = disc.centre - place.position;
  const double c = std::cos(place.yaw), s = std::sin(place.yaw);
  const double x = c * away.x() + s * away.y();
  const double y = c * away.y() - s * away.x();
  const double ahead = std::max({x - print.front, -print.back - x, 0.0});
  const double aside = std::max(std::abs(y) - print.side, 0.0);
  return std::sqrt(ahead * ahead + aside * aside) - disc.radius;
}

}  // namespace

Mover::Mover(const Lane& lane, double start, const MoversConfig& config, std::uint64_t seed)
    : lane_(&lane),
      acceleration_(config.acceleration),
      back_speed_(config.back_speed),
      pause_spread_(config.pause_spread),
      random_(seed),
      s_(start),
      allowed_(start),
      rear_(start),
      element_(lane.track.element_at(start)),
      place_(lane.track.place(start)) {
  double fastest = back_speed_;
  for (const Track::Element& element : lane.track.elements())
    fastest = std::max(fastest, element.speed);
  const double to_stop = fastest / acceleration_;
  reach_ = lane.footprint.radius + kSideMargin + 2.0 * kLook + 0.5 * fastest * to_stop;
  foresight_ = to_stop + kForesight;
}

Eigen::Vector2d Mover::velocity() const {
  const Track::Element& here = element();
  if (speed_ == 0.0 || here.spin != 0.0) return Eigen::Vector2d::Zero();
  if (here.curvature == 0.0) return speed_ * here.along;
  return speed_ * Eigen::Vector2d(std::cos(place_.yaw), std::sin(place_.yaw));
}

void Mover::stop_dead() {
  speed_ = 0.0;
  moved_ = false;
}

void Mover::back_out(double s) {
  rear_ = s;
  allowed_ = s_;
}

void Mover::step(double room, double dt) {
  moved_ = false;
  if (pause_left_ > 0.0)
    pause_left_ -= dt;
  else if (backs_out())
    drive_back(room, dt);
  else
    drive_on(room, dt);
  if (moved_) place_ = element().place(s_);
}

void Mover::drive_on(double room, double dt) {
  const Track::Element& here = element();
  const double left = std::min(room, allowed_ - s_);
  if (speed_ == 0.0 && left < kThere) return;
  const double to_end = here.end() - s_;
  const double for_end = here.end_speed * here.end_speed + 2.0 * acceleration_ * to_end;
  const double for_room = left > 0.0 ? 2.0 * acceleration_ * left : 0.0;
  const double most = std::min(here.speed, std::sqrt(std::min(for_end, for_room)));
  speed_ = std::max(
      0.0, std::clamp(most, speed_ - 2.0 * acceleration_ * dt, speed_ + acceleration_ * dt));
  double move = std::max(0.0, std::min(speed_ * dt, allowed_ - s_));
  moved_ = move > 0.0;
  if (allowed_ - s_ - move < kThere) speed_ = 0.0;
  while (move >= element().end() - s_ - kThere) {
    move -= element().end() - s_;
    const bool stands = element().end_speed == 0.0;
    pass_end();
    if (stands || move <= 0.0) {
      move = 0.0;
      break;
    }
  }
  s_ += move;
  rear_ = s_;
}

void Mover::drive_back(double room, double dt) {
  const double left = std::min(room, s_ - rear_);
  if (speed_ == 0.0 && left < kThere) return;
  if (s_ - element().begin < kThere) pass_begin();
  const std::size_t count = lane_->track.elements().size();
  const double before_speed = lane_->track.elements()[(element_ + count - 1) % count].end_speed;
  const double to_begin = s_ - element().begin;
  const double for_begin = before_speed * before_speed + 2.0 * acceleration_ * to_begin;
  const double for_room = left > 0.0 ? 2.0 * acceleration_ * left : 0.0;
  const double most =
      std::min({element().speed, back_speed_, std::sqrt(std::min(for_begin, for_room))});
  const double speed = std::max(
      0.0, std::clamp(most, -speed_ - 2.0 * acceleration_ * dt, -speed_ + acceleration_ * dt));
  const double move = std::min({speed * dt, s_ - rear_, to_begin});
  moved_ = move > 0.0;
  speed_ = -speed;
  s_ -= move;
  if (s_ - element().begin < kThere && before_speed == 0.0) speed_ = 0.0;
  if (s_ - rear_ < kThere) {
    rear_ = s_;
    speed_ = 0.0;
  }
  allowed_ = s_;
}

/// The element before begins where this one ends only if the track comes round.
void Mover::pass_begin() {
  if (element_ > 0) {
    --element_;
    return;
  }
  if (!lane_->track.closed()) return;
  element_ = lane_->track.elements().size() - 1;
  s_ += lane_->track.length();
  allowed_ += lane_->track.length();
  rear_ += lane_->track.length();
}

void Mover::pass_end() {
  const Track::Element& passed = element();
  s_ = passed.end();
  if (passed.end_speed == 0.0) speed_ = 0.0;
  if (passed.pause > 0.0) {
    Random random(random_);
    pause_left_ = passed.pause * (1.0 + pause_spread_ * (2.0 * random.uniform(0.0, 1.0) - 1.0));
    random_ = random.state();
  }
  if (element_ + 1 < lane_->track.elements().size()) {
    ++element_;
  } else if (lane_->track.closed()) {
    element_ = 0;
    allowed_ -= lane_->track.length();
    s_ = 0.0;
  }
}

std::uint64_t Mover::hash(std::uint64_t hash) const {
  for (const double value : {s_, allowed_, rear_, speed_, pause_left_}) hash = mix(hash, value);
  for (const std::uint64_t word : {random_, std::uint64_t{element_}, std::uint64_t{moved_}})
    hash = mix(hash, word);
  return hash;
}

double Mover::gap_at(double s, const Disc& disc) const {
  return gap_to(disc, lane_->track.place(s), lane_->footprint);
}

double Mover::room_before(const Disc& disc, double clearance, double further) const {
  return may_meet(disc, clearance + further) ? room_foreseen(disc, clearance, further, 1.0) : kFree;
}

double Mover::room_behind(const Disc& disc, double clearance) const {
  return may_meet(disc, clearance) ? room_foreseen(disc, clearance, 0.0, -1.0) : kFree;
}

/// Quick, for most movers are far from the robot at all times.
bool Mover::may_meet(const Disc& disc, double look) const {
  const double near = reach_ + disc.radius + look + foresight_ * disc.velocity.lpNorm<1>();
  return (disc.centre - place_.position).squaredNorm() <= near * near;
}

/// The least room before the places where the disc will be.
double Mover::room_foreseen(const Disc& disc, double clearance, double further, double way) const {
  const double to_stop = std::abs(speed_) / acceleration_;  // s
  const double look = 0.5 * std::abs(speed_) * to_stop + clearance + 2.0 * kLook + further;
  const Eigen::Vector2d path = (to_stop + kForesight) * disc.velocity;
  const int places =
      std::min(kMostForeseen, static_cast<int>(std::ceil(path.norm() / disc.radius)));
  double least = room(disc, clearance, look, way);
  for (int i = 1; i <= places; ++i) {
    const Disc then{disc.centre + path * (static_cast<double>(i) / places), disc.radius};
    least = std::min(least, room(then, clearance, look, way));
  }
  return least;
}

/// \param way  1 ahead, -1 back
double Mover::room(const Disc& disc, double clearance, double look, double way) const {
  const Track& track = lane_->track;
  const auto gap = [&](double distance) {
    double s = s_ + way * distance;
    if (s < 0.0) s += track.length();
    if (s > track.length()) s -= track.length();
    return gap_at(s, disc);
  };
  const double end = track.closed() ? look : (way > 0.0 ? track.length() - s_ : s_);
  const double gap_now = gap_to(disc, place_, lane_->footprint);
  for (double distance = kLook; distance <= std::min(look, end); distance += kLook) {
    const double then = gap(distance);
    // What is beside or behind it comes no nearer.
    if (then >= kSideMargin || then >= gap_now - kThere) continue;
    double free = distance - kLook, taken = distance;
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = 0.5 * (free + taken);
      (gap(middle) < kSideMargin ? taken : free) = middle;
    }
    return std::max(0.0, free - clearance);
  }
  return kFree;
}

}  // namespace navvi_sim::traffic
