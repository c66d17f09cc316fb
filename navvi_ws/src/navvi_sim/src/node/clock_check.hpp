#pragma once

#include <cmath>
#include <string>

namespace navvi_sim::node {

constexpr double kJump = 0.25;  // s, of simulated time; longer than any step

/// \param publisher, self  names of nodes
/// \param stamp  s, of a message on /clock
/// \param now  s, simulated time
/// \returns whether another clock than the simulator's own has published the stamp. A busy machine
///   hands the simulator's own messages back to it late, by any time, but never early.
[[nodiscard]] inline bool is_another_clock(const std::string& publisher, const std::string& self,
                                           double stamp, double now) {
  if (publisher == self && stamp <= now) return false;
  return std::abs(stamp - now) > kJump;
}

}  // namespace navvi_sim::node
