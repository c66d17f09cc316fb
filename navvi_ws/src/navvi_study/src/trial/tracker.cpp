#include "trial/tracker.hpp"

#include <navvi_types/angles.hpp>

namespace navvi_study::trial {

constexpr auto kPeriod = static_cast<std::int64_t>(1e9 / record::kTrackRate);  // ns
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

void Tracker::observe(const navvi_types::Guidance& guidance) {
  Way way{guidance.stamp, guidance.state, guidance.blocked_by, std::nullopt};
  if (guidance.is_followed()) way.steer = guidance.steer_angle;
  ways_.add(way);
}

void Tracker::observe(const navvi_types::Proximity& proximity) {
  Near near{proximity.stamp, 0.0, std::nullopt};
  if (!proximity.things.empty()) {
    near.gap = proximity.things.front().gap;
    near.nearest = proximity.things.front().thing_class;
  }
  near_.add(near);
}

void Tracker::observe(const navvi_types::CueEvent& cue) {
  if (cue.stage != navvi_types::CueStage::started) return;
  if (cue.modality() == navvi_types::Modality::rumble)
    motors_.add({cue.stamp, cue.left, cue.right});
  else if (!cue.lasts())
    begun_.add({cue.stamp, cue.modality(), cue.word()});
}

record::Track Tracker::rows_until(std::int64_t stamp) {
  record::Track rows;
  while (const auto place = places_.next(stamp)) {
    follow(*place);
    const bool due = place->stamp / kPeriod != last_ / kPeriod;
    yaw_ = place->pose.yaw;
    last_ = place->stamp;
    if (!due) continue;
    record::TrackRow row = row_at(*place);
    if (place->stamp >= start_) rows.push_back(row);
  }
  return rows;
}

/// The course that a guidance gave, from where the robot looked then.
void Tracker::follow(const navvi_types::Odometry& place) {
  const Way* way = ways_.at(place.stamp);
  if (way == nullptr || way->stamp == way_stamp_) return;
  way_stamp_ = way->stamp;
  course_.reset();
  if (way->steer) course_ = (way->stamp == place.stamp ? place.pose.yaw : yaw_) - *way->steer;
}

record::TrackRow Tracker::row_at(const navvi_types::Odometry& place) {
  const auto number = [](double value) { return static_cast<float>(value); };
  record::TrackRow row;
  row.time = 1e-9 * static_cast<double>(place.stamp);
  row.x = number(place.pose.position.x());
  row.y = number(place.pose.position.y());
  row.yaw = number(navvi_types::wrap(place.pose.yaw));
  row.speed = number(place.velocity.linear);
  row.turn_rate = number(place.velocity.angular);
  row.odom_x = row.odom_y = row.odom_yaw = row.gap = row.steer = kNone;
  if (const auto* odometry = odometry_.at(place.stamp)) {
    row.odom_x = number(odometry->pose.position.x());
    row.odom_y = number(odometry->pose.position.y());
    row.odom_yaw = number(navvi_types::wrap(odometry->pose.yaw));
  }
  if (course_) row.steer = number(navvi_types::wrap(place.pose.yaw - *course_));
  if (const Hands* hands = hands_.at(place.stamp)) {
    row.stick_forward = number(hands->forward);
    row.stick_left = number(hands->left);
    row.asks = hands->asks ? 1 : 0;
  }
  if (const Motors* motors = motors_.at(place.stamp)) {
    row.motor_left = number(motors->left);
    row.motor_right = number(motors->right);
  }
  if (const Near* near = near_.at(place.stamp); near != nullptr && near->nearest) {
    row.gap = number(near->gap);
    row.nearest = to_string(*near->nearest);
  }
  if (const Way* way = ways_.at(place.stamp)) {
    row.state = to_string(way->state);
    if (way->blocked_by) row.blocked_by = to_string(*way->blocked_by);
  }
  std::string sounds;
  while (const auto begun = begun_.next(place.stamp)) {
    if (begun->modality == navvi_types::Modality::speech)
      row.cue = begun->word;
    else
      sounds += (sounds.empty() ? "" : " ") + begun->word;
  }
  row.sounds = sounds;
  return row;
}

}  // namespace navvi_study::trial
