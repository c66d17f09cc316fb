#include "tracks/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace navvi_perception::tracks {

void TrackConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(noise, "noise", Range{0.005, 1.0}, "m", "standard deviation of a measured middle");
}

void Tracker::predict(Track& track, double dt) const {
  track.place += dt * track.velocity;
  const double push = config_.kAgility * config_.kAgility;
  track.spread += dt * (2.0 * track.both + dt * track.drift) + 0.25 * push * std::pow(dt, 4);
  track.both += dt * track.drift + 0.5 * push * std::pow(dt, 3);
  track.drift += push * dt * dt;
}

void Tracker::correct(Track& track, const clusters::Cluster& cluster, double time) const {
  constexpr double kWidens = 0.3;  // of the difference, in which a radius follows a sighting
  const double total = track.spread + config_.noise * config_.noise;
  const double place_gain = track.spread / total;
  const double speed_gain = track.both / total;
  const Eigen::Vector2d error = cluster.centre - track.place;
  track.place += place_gain * error;
  track.velocity += speed_gain * error;
  track.drift -= speed_gain * track.both;
  track.both *= 1.0 - place_gain;
  track.spread *= 1.0 - place_gain;
  track.radius += kWidens * (cluster.radius - track.radius);
  track.top = std::max(track.top, cluster.top);
  track.seen = time;
  ++track.sightings;
}

/// Whether it moves, moved, or belongs to what stands.
void Tracker::judge(Track& track, double time) const {
  const bool fast = track.velocity.norm() > config_.kSpeed;
  const bool away = (track.place - track.born).norm() > std::max(config_.kMoved, track.radius);
  if (fast && away) track.mover = true;
  if (track.mover ? fast : away) {
    track.still = time;
    track.born = track.place;
  }
  track.settled = time - track.still > (track.mover ? config_.kRest : config_.kSettle);
}

std::vector<std::size_t> Tracker::update(const std::vector<clusters::Cluster>& clusters,
                                         const std::vector<Eigen::Vector3d>& points, double time,
                                         std::uint32_t& next) {
  constexpr double kAnySpeed = 1.5;  // m/s, standard deviation, of what is seen for the first time
  for (Track& track : tracks_) predict(track, std::max(0.0, time - time_));
  time_ = time;
  tracks_.erase(
      std::remove_if(tracks_.begin(), tracks_.end(),
                     [&](const Track& track) { return time - track.seen > config_.kKeep; }),
      tracks_.end());

  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // m, cluster, track
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      const double apart = (clusters[c].centre - tracks_[t].place).norm();
      if (apart < std::max(config_.kGate, tracks_[t].radius)) pairs.emplace_back(apart, c, t);
    }
  std::sort(pairs.begin(), pairs.end());
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> of(clusters.size(), kNone);
  std::vector<bool> taken(tracks_.size(), false);
  for (const auto& [apart, c, t] : pairs) {
    if (of[c] != kNone || taken[t]) continue;
    of[c] = t;
    taken[t] = true;
    correct(tracks_[t], clusters[c], time);
    judge(tracks_[t], time);
  }
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    if (of[c] == kNone) {
      of[c] = tracks_.size();
      Track track;
      track.id = next++;
      track.place = track.born = clusters[c].centre;
      track.radius = clusters[c].radius;
      track.top = clusters[c].top;
      track.sightings = 1;
      track.seen = track.still = time;
      track.spread = config_.noise * config_.noise;
      track.drift = kAnySpeed * kAnySpeed;
      tracks_.push_back(std::move(track));
    }
    Track& track = tracks_[of[c]];
    track.surface.clear();
    for (const std::size_t i : clusters[c].members) track.surface.push_back(points[i].head<2>());
  }
  return of;
}

}  // namespace navvi_perception::tracks
