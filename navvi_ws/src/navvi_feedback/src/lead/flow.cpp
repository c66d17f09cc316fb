#include "lead/flow.hpp"

#include <algorithm>

namespace navvi_feedback::lead {

haptics::Rumble flow_of(const Course& course) {
  const double sum = kSlowest + (1.0 - kSlowest) * std::clamp(course.speed, 0.0, 1.0);
  const double lean = std::clamp(course.turn / kFullTurn, -1.0, 1.0);
  return {0.5 * sum * (1.0 - lean), 0.5 * sum * (1.0 + lean)};
}

}  // namespace navvi_feedback::lead
