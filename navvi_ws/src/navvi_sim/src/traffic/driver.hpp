#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "traffic/lanes.hpp"
#include "traffic/mover.hpp"

namespace navvi_sim::traffic {

/// Blocks of a track, from first to last, which may run on past its end.
struct Way {
  int first;
  int last;

  /// Whether it holds one of the crossing's blocks, on a track of `count`.
  [[nodiscard]] bool meets(const Crossing& crossing, int count) const;
};

/// Who drives a mover along its lane: goes where it was allowed to, stops for the robot, gives back
/// ground and backs out if the robot stays. It knows of nobody else; who goes first is Traffic's to
/// say.
struct Driver {
  /// \param lane   outlives the driver
  /// \param entry  its place on the lane
  /// \param seed   of its pauses
  Driver(const Lane& lane, const LaneUser& entry, const Route& route, const MoversConfig& config,
         std::uint64_t seed);

  void drive(const Disc& robot, double dt);
  /// Its body is pressed against the robot, which cannot give way: stands, unless it backs out.
  void press(const Disc& robot, double dt);

  /// Goes on to the end of its next leg.
  void go_on();
  /// Backs out to `back_to`.
  void go_back();
  /// Keeps only the block it stands in, of what it was given. False if it has no more than that.
  bool strand();

  /// m along its track, the nearest place behind where it is in nobody's way and leaves the robot
  /// 3 m more than now; if there is none, where it leaves most.
  /// \param may_stand  whether the others on its track leave it a block; none further back is tried
  [[nodiscard]] std::optional<double> place_behind(const Disc& robot,
                                                   const std::function<bool(int)>& may_stand) const;

  /// The blocks that it is on or may go to.
  [[nodiscard]] Way held() const;
  [[nodiscard]] Way way_on() const;    ///< its next leg
  [[nodiscard]] Way way_back() const;  ///< to `back_to`
  /// True if it has been kept for so long that it gives back ground.
  [[nodiscard]] bool has_waited() const { return kept > kGiveBack; }
  /// True if it would soon have to brake for the end of what it was given.
  [[nodiscard]] bool wants_more() const {
    return mover.allowed() - mover.s() <= ask_at_ && !mover.backs_out() && !lane->legs.empty() &&
           (lane->track.closed() || mover.allowed() < lane->track.length());
  }
  /// Mixes all of its state into `hash` (FNV-1a over words).
  [[nodiscard]] std::uint64_t hash(std::uint64_t hash) const;

  Mover mover;
  const Lane* lane;
  std::size_t next = 0;    ///< leg to be asked for
  double kept = 0.0;       ///< s that the robot has kept it from going on
  bool stranded = false;   ///< stands on shared ground, or did when it last asked
  bool goes_back = false;  ///< was given the way back, and is not there yet
  bool robot_ahead = false;
  bool robot_behind = false;
  std::optional<double> back_to;  ///< m along the track, where it means to back out to
  std::optional<double> gave_up;  ///< m along the track, where it stood before it backed out

 private:
  static constexpr double kGiveBack = 3.0;  // s

  [[nodiscard]] double room(const Disc& robot, double dt);
  void stay();

  double start_;             ///< m along the track
  double clearance_;         ///< m, to the robot
  double ask_at_;            ///< m before the end of what it was given, at which it asks for more
  double free_since_ = 0.0;  ///< s that the robot has been gone from what it gave up
  bool yields_;
};

}  // namespace navvi_sim::traffic
