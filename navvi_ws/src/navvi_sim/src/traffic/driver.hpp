#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "traffic/lanes.hpp"
#include "traffic/mover.hpp"

namespace navvi_sim::traffic {

/// Blocks of a track, from first to last, which may run on past its end.
struct BlockRange {
  int first;
  int last;

  /// Whether it holds one of the conflict's blocks, on a track of `count`.
  [[nodiscard]] bool overlaps(const Conflict& conflict, int count) const;
};

/// Drives a mover along its lane: goes as far as it was granted, stops for the robot, releases
/// ground and reverses if the robot stays. It knows no other mover; Traffic decides the right of
/// way.
struct Driver {
  /// \param lane   outlives the driver
  /// \param entry  its place on the lane
  /// \param seed   of its pauses
  Driver(const Lane& lane, const LaneUser& entry, const Route& route, const MoversConfig& config,
         std::uint64_t seed);

  void drive(const Disc& robot, double dt);
  /// Its body is pressed against the robot, which cannot give way: it stops, unless it reverses.
  void press(const Disc& robot, double dt);

  /// Reserves its next segment and drives on to the end of it.
  void go_on();
  /// Reverses to `back_to`.
  void go_back();
  /// Keeps only the block it stands in of what it has reserved. False if that is all it has.
  bool release_ahead();

  /// m along its track, the nearest place behind that no other lane touches and that leaves the
  /// robot 3 m more than now; if there is none, the place that leaves most. \param may_stand
  /// whether the others on its track leave it a block; none further back is tried
  [[nodiscard]] std::optional<double> place_behind(const Disc& robot,
                                                   const std::function<bool(int)>& may_stand) const;

  /// The blocks that it is on or may drive to.
  [[nodiscard]] BlockRange reserved() const;
  [[nodiscard]] BlockRange range_ahead() const;   ///< its next segment
  [[nodiscard]] BlockRange range_behind() const;  ///< to `back_to`
  /// True if the robot has blocked it for so long that it releases ground.
  [[nodiscard]] bool has_waited() const { return kept > kGiveBack; }
  /// True if it would soon have to brake for the end of what it has reserved.
  [[nodiscard]] bool wants_more() const {
    return mover.allowed() - mover.s() <= ask_at_ && !mover.backs_out() &&
           !lane->segments.empty() &&
           (lane->track.closed() || mover.allowed() < lane->track.length());
  }
  /// Mixes all of its state into `hash` (FNV-1a over words).
  [[nodiscard]] std::uint64_t hash(std::uint64_t hash) const;

  Mover mover;
  const Lane* lane;
  std::size_t next = 0;           ///< segment to ask for
  double kept = 0.0;              ///< s that the robot has blocked it
  bool on_shared_ground = false;  ///< stands on shared ground, or did when it last asked
  bool goes_back = false;         ///< is reversing, and not there yet
  bool robot_ahead = false;
  bool robot_behind = false;
  std::optional<double> back_to;  ///< m along the track, where it wants to reverse to
  std::optional<double> gave_up;  ///< m along the track, where it stood before it reversed

 private:
  static constexpr double kGiveBack = 3.0;  // s

  [[nodiscard]] double room(const Disc& robot, double dt);
  void stay();

  double start_;             ///< m along the track
  double clearance_;         ///< m, to the robot
  double ask_at_;            ///< m before the end of what it has reserved, at which it asks
  double free_since_ = 0.0;  ///< s that the robot has been gone from what it gave up
  bool yields_;
};

}  // namespace navvi_sim::traffic
