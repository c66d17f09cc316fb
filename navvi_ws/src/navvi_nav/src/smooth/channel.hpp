#pragma once

#include <vector>

#include "map/floor.hpp"

namespace navvi_nav::smooth {

/// What a path must keep: `radius` always, `radius + preferred` where there is room, m.
struct Clearances {
  double radius = 0.35;
  double preferred = 0.6;

  /// Share of the preferred clearance that a place `gap` m from the nearest obstacle lacks, [0, 1].
  [[nodiscard]] double missing(double gap) const {
    if (preferred <= 0.0) return 0.0;
    return std::clamp((radius + preferred - gap) / preferred, 0.0, 1.0);
  }
};

/// The free strip along a path, as a ladder: rungs across the path, half a metre apart and at each
/// corner, each as long as the floor is free, up to room.preferred (at least 0.6 m) on either side.
/// A path that crosses every rung in order can be drawn over onto the first one without leaving the
/// free floor, as nothing that blocks fits between two rungs: it leads through the same corridor
/// (it is homotopic).
class Channel {
 public:
  static constexpr int kSide = 4;  ///< samples on either side
  static constexpr int kSamples = 2 * kSide + 1;

  struct Rung {
    Point at;             ///< m, on the path
    Point across;         ///< to the left, of length 1
    bool corner = false;  ///< the path turns here
    double along = 0.0;   ///< m, from the start of the path
    int low = 0;          ///< samples that are free: from low (<= 0) to high (>= 0)
    int high = 0;
    double gap[kSamples] = {};  ///< m, to the nearest obstacle, of the free samples
  };

  /// \param path  of some length, clear by room.radius
  Channel(const Path& path, const map::Space& space, const Clearances& room);

  [[nodiscard]] const std::vector<Rung>& rungs() const { return rungs_; }
  [[nodiscard]] std::size_t size() const { return rungs_.size(); }
  [[nodiscard]] double step() const { return step_; }  ///< m, between two samples of a rung
  [[nodiscard]] Point point(std::size_t rung, int sample) const {
    const Rung& r = rungs_[rung];
    return r.at + (sample * step_) * r.across;
  }
  /// Where the line from `a` in direction `course` meets a rung, in samples from its middle; not
  /// finite if it does not.
  [[nodiscard]] double crossing(std::size_t rung, Point a, Point course) const {
    const Rung& r = rungs_[rung];
    return cross(course, a - r.at) / (step_ * cross(course, r.across));
  }
  /// m, to the nearest obstacle, on a rung: linear between its samples.
  [[nodiscard]] double gap(std::size_t rung, double sample) const;
  [[nodiscard]] const Clearances& room() const { return room_; }
  /// True if `path`, with the ends of the channel, crosses every rung in order.
  [[nodiscard]] bool holds(const Path& path) const;
  /// Takes the ends off the rungs that the segment crosses, on its side, where it comes nearest to
  /// an obstacle: for a segment that is not clear.
  /// \returns false if there was nothing left to take
  bool narrow(std::size_t from, std::size_t to, Point a, Point b);

 private:
  void place_rungs(const Path& path);
  void measure(const map::Space& space);
  void untangle();
  [[nodiscard]] bool beside(Point point) const;

  Clearances room_;
  double step_ = 0.0;
  std::vector<Rung> rungs_;
};

}  // namespace navvi_nav::smooth
