#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <navvi_config/field.hpp>
#include <vector>

#include "clusters/clusters.hpp"

namespace navvi_perception::tracks {

struct TrackConfig {
  /// m, farther from where it was expected a thing is another one
  static constexpr double kGate = 0.9;
  static constexpr double kKeep = 1.0;  ///< s, a thing is expected that is not seen
  /// s, without a sight of its sensor: longer than it takes to find that one silent, though late
  static constexpr double kTold = 1.5;
  static constexpr int kSightings = 3;  ///< after which a thing is told
  double noise = 0.08;   ///< m, standard deviation of a measured middle
  static constexpr double kAgility = 1.5;  ///< m/s^2, standard deviation of an acceleration
  /// m, at least, and its own radius, from where it was first: it is a mover
  static constexpr double kMoved = 0.3;
  static constexpr double kSpeed = 0.2;  ///< m/s, below which a mover stands
  /// s, after which what never moved belongs to what stands
  static constexpr double kSettle = 3.0;
  static constexpr double kRest = 20.0;  ///< s, likewise of a mover that stands

  void describe(navvi_config::Visitor& visit);
};

/// A thing that the standing map does not explain. Frame: map.
struct Track {
  std::uint32_t id = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();     ///< m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s; use drives()
  double radius = 0.0;                                 ///< m
  double top = 0.0;                                    ///< m, z
  std::vector<Eigen::Vector2d> surface = {};           ///< m, of the last sighting
  int sightings = 0;
  bool mover = false;    ///< it has moved
  bool settled = false;  ///< it has stood so long that it belongs to what stands
  double seen = 0.0;     ///< s, the last time
  double still = 0.0;    ///< s, since when it stands
  Eigen::Vector2d born = Eigen::Vector2d::Zero();  ///< m, where it was when `still` began
  double spread = 0.0, drift = 0.0, both = 0.0;    ///< of the Kalman filter, the same for x and y
};

/// Follows things from sighting to sighting of one sensor: the nearest to where each is expected,
/// at constant velocity (Kalman, 1960). The same sightings give the same tracks.
class Tracker {
 public:
  explicit Tracker(const TrackConfig& config) : config_(config) {}

  /// \param clusters  ordered as they were found \param points  m, of which they are made
  /// \param time      s, not before the last call's \param next  the next free number, counted on
  /// \return of each cluster, its track's index in now()
  std::vector<std::size_t> update(const std::vector<clusters::Cluster>& clusters,
                                  const std::vector<Eigen::Vector3d>& points, double time,
                                  std::uint32_t& next);
  [[nodiscard]] const std::vector<Track>& now() const { return tracks_; }
  /// True if it is to be told. \param time  s; the sensor may be silent by then
  [[nodiscard]] bool sure(const Track& track, double time) const {
    return track.sightings >= config_.kSightings && !track.settled &&
           time - time_ <= config_.kTold;
  }
  /// True if it moves now.
  [[nodiscard]] bool drives(const Track& track) const {
    return track.mover && track.velocity.norm() > config_.kSpeed;
  }

 private:
  void predict(Track& track, double dt) const;
  void correct(Track& track, const clusters::Cluster& cluster, double time) const;
  void judge(Track& track, double time) const;

  TrackConfig config_;
  double time_ = 0.0;
  std::vector<Track> tracks_;
};

}  // namespace navvi_perception::tracks
