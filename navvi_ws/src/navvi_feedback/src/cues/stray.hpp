#pragma once

#include <optional>

#include "cues/cue_config.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// How a robot that is led strays: it drives the wrong way, or beside the path.
/// \param now  with a guidance that leads
/// \param was  how it strayed at the last look, so that it takes less to be off the path still
/// \return wrong_way or off_path; nullopt: it does not
[[nodiscard]] std::optional<CueKind> straying(const Observation& now, std::optional<CueKind> was,
                                              const StrayConfig& config);

/// The robot drives on, and does not turn on the spot.
[[nodiscard]] bool drives_on(const Observation& now);

/// How long the robot has strayed, and when that was said.
struct Stray {
  std::optional<CueKind> kind;  ///< nullopt: it does not
  double since = 0.0;           ///< s
  std::optional<double> said;   ///< s

  /// Call it at each look. \param time  s, monotonic
  void observe(const Observation& now, const StrayConfig& config, double time);
  /// \return whether it is to be said now
  [[nodiscard]] bool due(const Observation& now, const StrayConfig& config, double time) const;
};

}  // namespace navvi_feedback::cues
