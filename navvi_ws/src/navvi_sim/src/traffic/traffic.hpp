#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "traffic/driver.hpp"
#include "traffic/lanes.hpp"

namespace navvi_sim::traffic {

/// All that moves in a world, and who goes first (R-SIM-3).
///
/// The rule. A mover waits in refuges only: places of its track whose ground no other lane touches.
/// From one it takes all ground up to the next at once, or none of it; what lies behind it is free
/// again. It is given the ground if nobody is on what its leg touches, or was given it, and nobody
/// who asked earlier wants it. Who shares a track also lets the one ahead get clear of the refuge.
///
/// Why nobody meets. A body lies within the ground of the block its place is in; a mover is only in
/// blocks that it holds; and held blocks of two movers never touch, for each grant is checked
/// against all that is held.
///
/// Why nobody waits for ever, while the robot stands in nobody's way. A leg once given is driven to
/// its end: nothing on it waits for anybody. So it is left within a time that depends on its length
/// and pauses only. Consider what can keep a mover from its next leg:
/// - a mover on a leg that touches it: gone within that time;
/// - one that waits: it stands in a refuge, which no leg of another lane touches. On a shared track
///   the one ahead may stand in the next refuge; but there are more refuges than movers, so that
///   somebody's is free, and free room comes back to each in turn;
/// - one that asked earlier: it counts only where none of its own track is in its way. Those form a
///   line. The first of it is given its leg when the movers that touch it are gone, for nobody who
///   came later can take that ground; then it is the last. So each waits for finitely many legs.
///
/// The robot. A mover that the robot keeps from going on gives back what lies ahead of it after a
/// while and asks anew when the robot is gone, so that a robot that stands still blocks those only
/// whose way leads over the bodies it stops. Who is kept for longer still backs out along its own
/// track, to leave the robot room to pass: to a place that no other lane touches, and, on a shared
/// track, to a refuge that the one behind was not given and does not need to leave shared ground.
/// It takes the ground back to there at once, or none of it, by the same rule as a leg. There it
/// waits until the robot is gone from the ground that it gave up; if the robot stays, it backs out
/// further.
///
/// Movers may so be left standing on shared ground: going on, or backing out with the robot behind.
/// Each of them keeps asking for the rest of the way it was given last, and who was backing out for
/// the way on, too. That of the one that was given its way last touched none of the others when it
/// was given, so it can be given again; likewise, when it is gone, of those that remain. On a
/// shared track the one ahead was clear of that way then; it can only have gone further, or backed
/// out to where it is clear of it still, and nobody comes on into ground that the one ahead means
/// to back out over. Things that start on shared ground are such movers, in an order that lay_lanes
/// has found. Who backed out stands where those stand who wait, in nobody's way.
class Traffic {
 public:
  /// \throws WorldError as lay_lanes
  Traffic(const WorldDescription& world, const MoversConfig& config, std::uint64_t seed);
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;

  /// \param robot    what movers that yield stop for
  /// \param pressing things, in order, that must stop dead, for the robot cannot give way to them
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
    std::size_t ahead;           ///< user before it on a shared track; itself if there is none
    std::size_t behind;          ///< user after it, likewise
    bool asking = false;         ///< is in the line
    std::optional<Way> claim{};  ///< what it asks for, where only who drives is in its way
  };
  /// What keeps a mover from a way.
  enum class Obstacle { none, driving, waiting };

  void step(std::size_t user, const Disc& robot, bool presses, double dt);
  void leave_line(std::size_t user);
  void serve_line();
  bool serve(std::size_t user);
  [[nodiscard]] Obstacle obstacle(std::size_t user, const std::vector<Crossing>& crossings) const;
  [[nodiscard]] bool clear_of_one_ahead(std::size_t user) const;
  [[nodiscard]] bool clear_of_one_behind(std::size_t user, int block) const;

  double patience_;  ///< s
  Lanes lanes_;
  std::vector<User> users_;        ///< ordered by thing
  std::vector<std::size_t> line_;  ///< who asks, the first first
  std::uint64_t steps_ = 0;
};

}  // namespace navvi_sim::traffic
