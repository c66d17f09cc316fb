#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "description/footprint.hpp"
#include "traffic/lanes.hpp"

namespace navvi_sim::traffic {

/// Drives along a track, smoothly and as fast as allowed, up to where it was allowed to go, or
/// reverses along it, slowly, to where it was sent. Pure: the same calls give the same places.
class Mover {
 public:
  static constexpr double kFree = std::numeric_limits<double>::infinity();

  /// \param lane   outlives the mover
  /// \param start  m along its track
  /// \param seed   of its pauses
  Mover(const Lane& lane, double start, const MoversConfig& config, std::uint64_t seed);

  /// \param room  m, how far it can go, the way it goes, before something stands there; kFree: far
  void step(double room, double dt);
  /// It is pressed against what cannot give way.
  void stop_dead();
  /// Stands still for `seconds`.
  void wait(double seconds) { pause_left_ = seconds; }
  /// Allows it to go on to `s`, m along the track and more than `s()`; beyond the track's length it
  /// comes round. It will not go further.
  void allow(double s) { allowed_ = s; }
  /// Sends it back to `s`, m along the track and less than `s()`; less than 0, it comes round. It
  /// must be standing, and is allowed nothing ahead.
  void back_out(double s);
  /// Allows it nothing but where it is.
  void halt() { rear_ = allowed_ = s_; }

  /// m it can go until it would touch the disc, less the clearance; kFree if not soon. A disc that
  /// moves is foreseen to go on until the mover would stand, and a little longer.
  /// \param further  m, that it looks beyond where it could stop
  [[nodiscard]] double room_before(const Disc& disc, double clearance, double further = 0.0) const;
  /// Likewise, backing out.
  [[nodiscard]] double room_behind(const Disc& disc, double clearance) const;
  /// m, from the disc to the mover if it stood at `s`.
  [[nodiscard]] double gap_at(double s, const Disc& disc) const;

  [[nodiscard]] double s() const { return s_; }
  [[nodiscard]] double allowed() const { return allowed_; }
  /// Where it backs out to; s() if it does not.
  [[nodiscard]] double rear() const { return rear_; }
  [[nodiscard]] bool backs_out() const { return rear_ < s_; }
  [[nodiscard]] const Pose2& place() const { return place_; }
  /// m/s along the track, also in turning; less than 0 backing out.
  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] double pause_left() const { return pause_left_; }
  [[nodiscard]] Eigen::Vector2d velocity() const;  ///< m/s, in map
  /// True if the place changed in the last step.
  [[nodiscard]] bool has_moved() const { return moved_; }
  /// Mixes all of its state into `hash` (FNV-1a over words).
  [[nodiscard]] std::uint64_t hash(std::uint64_t hash) const;

 private:
  [[nodiscard]] const Track::Element& element() const { return lane_->track.elements()[element_]; }
  void drive_on(double room, double dt);
  void drive_back(double room, double dt);
  void pass_end();
  void pass_begin();
  [[nodiscard]] bool may_meet(const Disc& disc, double look) const;
  [[nodiscard]] double room(const Disc& disc, double clearance, double look, double way) const;
  [[nodiscard]] double room_foreseen(const Disc& disc, double clearance, double further,
                                     double way) const;

  const Lane* lane_;
  double acceleration_;
  double back_speed_;
  double reach_;      ///< m, from its place, of what it may touch before it stands
  double foresight_;  ///< s, for which a disc is foreseen at most
  double pause_spread_;
  std::uint64_t random_;
  double s_;
  double allowed_;
  double rear_;
  double speed_ = 0.0;
  double pause_left_ = 0.0;
  std::size_t element_;
  Pose2 place_;
  bool moved_ = false;
};

}  // namespace navvi_sim::traffic
