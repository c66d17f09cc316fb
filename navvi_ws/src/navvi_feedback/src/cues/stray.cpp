#include "cues/stray.hpp"

#include <cmath>

#include "cues/clock_face.hpp"

namespace navvi_feedback::cues {
namespace {

/// m/s; a slower robot is about to turn on the spot.
constexpr double kDrives = 0.1;

}  // namespace

bool drives_on(const Observation& now) { return now.measured && now.measured->linear > kDrives; }

std::optional<CueKind> straying(const Observation& now, std::optional<CueKind> was,
                                const StrayConfig& config) {
  if (drives_on(now) && std::abs(now.guidance->steer_angle) > config.kWrongWayDegrees * kDegree)
    return CueKind::wrong_way;
  const double limit = was == CueKind::off_path ? config.kOnPath : config.kOffPath;
  return now.guidance->path_offset > limit ? std::optional(CueKind::off_path) : std::nullopt;
}

void Stray::observe(const Observation& now, const StrayConfig& config, double time) {
  const std::optional<CueKind> strays = straying(now, kind, config);
  if (strays != kind) *this = {strays, time, std::nullopt};
}

bool Stray::due(const Observation& now, const StrayConfig& config, double time) const {
  return kind && time - since >= config.kAfter && drives_on(now) &&
         (!said || time - *said >= config.kRepeat);
}

}  // namespace navvi_feedback::cues
