#pragma once

#include <cstdint>
#include <deque>
#include <navvi_types/guidance.hpp>
#include <navvi_types/thing.hpp>
#include <vector>

#include "navvi_people/people/driving.hpp"
#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::people {

/// What eyes show: the path, and what is near.
struct Sight {
  navvi_types::Guidance guidance;
  std::vector<navvi_types::NearThing> nearby;
};

/// The reference for people who are guided: the same hand on the same stick, liking the same speed,
/// but it sees the path and what moves. It steers along the path, slows down in bends, and keeps
/// its distance from what is ahead, but creeps past what waits beside its lane. No person is like
/// it, so nothing of it is drawn or fitted.
class SightedDriver {
 public:
  /// \param person, occasion  seeds, as of `Driving`
  SightedDriver(const DrivingConfig& config, std::uint64_t person, std::uint64_t occasion)
      : config_(config), driving_(config, person, occasion) {}

  /// \param time  s, not going back \param dt  s since the last update
  [[nodiscard]] StickAndButtons update(const Sight& sight, double time, double dt);

 private:
  struct Seen {
    double time = 0.0;  ///< s
    Sight sight;
  };
  DrivingConfig config_;
  Driving driving_;
  std::deque<Seen> seen_;
  double halted_ = 0.0;  ///< s, when it last went on, or had no path
};

}  // namespace navvi_people::people
