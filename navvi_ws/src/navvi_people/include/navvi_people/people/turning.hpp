#pragma once

#include <cstdint>
#include <navvi_types/random.hpp>

#include "navvi_config/field.hpp"

namespace navvi_people::people {

using navvi_types::Random;

/// How far a turn truly goes.
struct TurningConfig {
  bool faults = true;
  double over_slight = 8.5;  ///< deg, turned too far by words, turns of 22.5 to 60 deg, the mean
  double over_ample = 6.5;   ///< deg, likewise, turns of 60 deg and more
  double over_spread = 3.0;  ///< deg, standard deviation, turn by turn
  double stop_delay = 0.05;  ///< s, from the decision to stop a turn to the hand, the median
  double stop_spread = 0.2;  ///< standard deviation of its logarithm

  void describe(navvi_config::Visitor& visit);
};

class Turning {
 public:
  Turning(const TurningConfig& config, std::uint64_t seed) : config_(config), random_(seed) {}

  /// \param angle  rad, of the turn that was asked for \return rad, that is made
  [[nodiscard]] double made(double angle);
  /// s, from the decision to stop a turn until the hand has let go
  [[nodiscard]] double stop_delay();

 private:
  TurningConfig config_;
  Random random_;
};

}  // namespace navvi_people::people
