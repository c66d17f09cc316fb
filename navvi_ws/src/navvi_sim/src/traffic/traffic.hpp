#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "traffic/driver.hpp"
#include "traffic/lanes.hpp"

namespace navvi_sim::traffic {

/// Everything that moves in a world, and the right of way (R-SIM-3).
///
/// The rule. A mover waits only in waiting zones: blocks of its track whose ground no other lane
/// touches. From one zone it reserves all ground up to the next at once, or none of it; the ground
/// behind it is free again. A segment is granted if no other mover is on ground that the segment
/// touches or has reserved such ground, and no mover that asked earlier wants it. On a shared track
/// the mover ahead must also be clear of the next zone.
///
/// No collisions. A body lies within the ground of the block that its place is in, a mover is only
/// in blocks that it has reserved, and reserved blocks of two movers never touch, because each
/// grant is checked against all reservations.
///
/// No deadlock, while the robot blocks nobody. A granted segment is driven to its end: nothing on
/// it waits for another mover. So it is left within a time that depends on its length and pauses
/// only. Three things can keep a mover from its next segment:
/// - a mover on a segment that touches it: that one is gone within this time;
/// - a waiting mover: it stands in a zone, which no segment of another lane touches. On a shared
///   track the mover ahead may stand in the next zone; but there are more zones than movers, so one
///   of them has a free zone ahead, and the free zone comes back to each in turn;
/// - a mover that asked earlier: it counts only while nothing of its own track is in its way. These
///   form a queue. Its first gets its segment when the movers that touch it are gone, for none that
///   came later can reserve that ground; then it is the last. So each waits for finitely many
///   segments.
///
/// The robot. A mover that the robot blocks releases the ground ahead after a while and asks anew
/// when the robot is gone, so a robot that stands still blocks only movers whose way leads over the
/// bodies that it stops. A mover that is blocked for longer reverses along its own track, to leave
/// the robot room to pass: to a place that no other lane touches, and, on a shared track, to a zone
/// that the mover behind has not reserved and does not need to leave shared ground. It reserves the
/// ground back to there at once, or none of it, by the same rule as a segment. There it waits until
/// the robot has left the ground that it gave up; if the robot stays, it reverses further.
///
/// So movers may stand on shared ground: on their way on, or reversing with the robot behind. Each
/// keeps asking for the rest of the range it was granted last, and a reversing one for the way on,
/// too. The range that was granted last touched none of the others then, so it can be granted
/// again; when its mover is gone, the same holds for those that remain. On a shared track the mover
/// ahead was clear of that range then; since then it has only gone further, or reversed to where it
/// is still clear of it, and no follower is granted blocks that the mover ahead has reserved for
/// reversing. Movers that start on shared ground are of this kind, in an order that lay_lanes has
/// found. A mover that has reversed stands in a waiting zone and blocks no one.
class Traffic {
 public:
  /// \throws WorldError as lay_lanes
  Traffic(const WorldDescription& world, const MoversConfig& config, std::uint64_t seed);
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;

  /// \param robot    what movers that yield stop for
  /// \param pressing  things, in order, that must stop at once: the robot cannot give way to them
  void step(const Disc& robot, const std::vector<std::size_t>& pressing, double dt);

  [[nodiscard]] std::size_t size() const { return users_.size(); }
  [[nodiscard]] const Mover& mover(std::size_t i) const { return users_[i].driver.mover; }
  /// Index in WorldDescription::things.
  [[nodiscard]] std::size_t thing(std::size_t i) const { return lanes_.users[i].thing; }
  /// Mixes all that the next steps depend on into `hash` (FNV-1a over words).
  [[nodiscard]] std::uint64_t hash(std::uint64_t hash) const;

 private:
  /// A driver among the others.
  struct User {
    Driver driver;
    std::size_t ahead;    ///< user before it on a shared track; itself if none
    std::size_t behind;   ///< user after it, likewise
    bool asking = false;  ///< is in the queue
    std::optional<BlockRange>
        claim{};  ///< what it asks for, where only driving movers are in its way
  };
  /// What keeps a mover from a range of blocks.
  enum class Obstacle { none, driving, waiting };

  void step(std::size_t user, const Disc& robot, bool presses, double dt);
  void leave_queue(std::size_t user);
  void serve_queue();
  bool serve(std::size_t user);
  [[nodiscard]] Obstacle obstacle(std::size_t user, const std::vector<Conflict>& conflicts) const;
  [[nodiscard]] bool clear_of_one_ahead(std::size_t user) const;
  [[nodiscard]] bool clear_of_one_behind(std::size_t user, int block) const;

  double patience_;  ///< s
  Lanes lanes_;
  std::vector<User> users_;         ///< ordered by thing
  std::vector<std::size_t> queue_;  ///< users that ask, the first first
  std::uint64_t steps_ = 0;
};

}  // namespace navvi_sim::traffic
