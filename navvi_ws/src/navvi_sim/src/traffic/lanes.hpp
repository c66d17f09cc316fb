#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "description/footprint.hpp"
#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/traffic/movers_config.hpp"
#include "traffic/track.hpp"

namespace navvi_sim::traffic {

/// Ground of another lane that a segment touches: its blocks from first to last.
struct Conflict {
  std::size_t lane;
  int first;
  int last;
};

/// A block of a lane whose ground touches a block of another lane, or of its own far along it.
struct SharedBlock {
  int block;
  std::uint32_t lane;
  int other;
};

/// The way from one waiting zone to the next, in blocks.
struct Segment {
  int begin;  ///< the block after the last zone
  int end;    ///< the next zone; may be less than begin where the track comes round
  std::vector<Conflict> conflicts;
};

/// A track and its users. It is cut into blocks of about half a metre, numbered along it. A body
/// whose place is in a block lies within the ground of that block: the hull of all that the body
/// sweeps there. Blocks that touch the ground of no other lane are private; a waiting zone is a
/// private block, in whose middle a mover waits.
struct Lane {
  Track track;
  Footprint footprint;  ///< around all users
  int blocks;
  double block_length;                     ///< m
  int spacing = 0;                         ///< blocks between two bodies that surely do not touch
  std::vector<SharedBlock> shared_blocks;  ///< ordered by block, lane and other
  std::vector<bool> is_private;            ///< by block
  std::vector<Segment> segments;   ///< in order of their ends; none if all ground is private
  std::vector<std::size_t> users;  ///< indices of Lanes::users, in the order they drive in

  [[nodiscard]] int block_at(double s) const {
    const int block = static_cast<int>(s / block_length);
    return block < blocks ? block : blocks - 1;
  }
  /// m, where to stand in a waiting zone.
  [[nodiscard]] double waiting_place(int block) const {
    return !track.closed() && block + 1 == blocks ? track.length() : (block + 0.5) * block_length;
  }
  /// Number of the first segment that ends ahead of s.
  [[nodiscard]] std::size_t segment_after(double s) const;
  /// What the ground of its blocks from `first` to `last` touches; last may be less than first
  /// where the track comes round.
  [[nodiscard]] std::vector<Conflict> conflicts(int first, int last) const;
};

/// A thing with a route, on its lane.
struct LaneUser {
  std::size_t thing;  ///< index in WorldDescription::things
  std::size_t lane;
  double start;  ///< m along the track
};

/// Where everything that moves in a world drives, laid out once so that traffic never stops for
/// good (traffic.hpp says why).
struct Lanes {
  std::vector<Lane> lanes;
  std::vector<LaneUser> users;  ///< ordered by thing
};

/// Lays the lanes of a world. Corners are rounded where the thing then clears everything that
/// stands.
/// \throws WorldError naming the things, if one would pass through what stands, stands off its
///         route, or has no place to wait out of the way of the others
[[nodiscard]] Lanes lay_lanes(const WorldDescription& world, const MoversConfig& config);

/// The ground that everything with a route sweeps on its way, in convex pieces; m, in map.
/// \throws WorldError as lay_lanes, but for waiting places
[[nodiscard]] std::vector<Polygon> swept_ground(const WorldDescription& world,
                                                const MoversConfig& config);

}  // namespace navvi_sim::traffic
