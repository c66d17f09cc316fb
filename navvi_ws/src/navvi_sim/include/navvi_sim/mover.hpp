#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "navvi_sim/footprint.hpp"
#include "navvi_sim/lanes.hpp"

namespace navvi_sim {

/// Drives along a track, smoothly and as fast as it may, up to where it was allowed to go. Pure:
/// the same calls give the same places.
class Mover {
 public:
  static constexpr double kFree = std::numeric_limits<double>::infinity();

  /// \param lane   outlives the mover
  /// \param start  m along its track
  /// \param seed   of its pauses
  Mover(const Lane& lane, double start, const MoversConfig& config, std::uint64_t seed);

  /// \param room  m, how far it can go before something stands in its way; kFree: nothing does
  void step(double room, double dt);
  /// It is pressed against what cannot give way.
  void stop_dead();
  /// Stands still for `seconds`.
  void wait(double seconds) { pause_left_ = seconds; }
  /// Allows it to go on to `s`, m along the track and more than `s()`; beyond the track's length it
  /// comes round. It will not go further.
  void allow(double s) { allowed_ = s; }

  /// m it can go until it would touch the disc, less the clearance; kFree if not soon.
  [[nodiscard]] double room_before(const Disc& disc, double clearance) const;

  [[nodiscard]] double s() const { return s_; }
  [[nodiscard]] double allowed() const { return allowed_; }
  [[nodiscard]] const Place& place() const { return place_; }
  [[nodiscard]] double speed() const { return speed_; }  ///< m/s along the track, also in turning
  [[nodiscard]] double pause_left() const { return pause_left_; }
  [[nodiscard]] Eigen::Vector2d velocity() const;  ///< m/s, in map
  [[nodiscard]] double turn_rate() const;          ///< rad/s
  /// True if the place changed in the last step.
  [[nodiscard]] bool has_moved() const { return moved_; }
  /// True at the end of a track that does not come round.
  [[nodiscard]] bool has_ended() const {
    return !lane_->track.closed() && s_ >= lane_->track.length();
  }

 private:
  [[nodiscard]] const Track::Element& element() const { return lane_->track.elements()[element_]; }
  void pass_end();

  const Lane* lane_;
  double acceleration_;
  double pause_spread_;
  std::uint64_t random_;
  double s_;
  double allowed_;
  double speed_ = 0.0;
  double pause_left_ = 0.0;
  std::size_t element_;
  Place place_;
  bool moved_ = false;
};

}  // namespace navvi_sim
