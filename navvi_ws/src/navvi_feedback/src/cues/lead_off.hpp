#pragma once

#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// After "straight ahead" a person drives on along the robot's heading. If that leads into a thing,
/// along one that is all but touched, or along one that the path leaves, the hour on the path's
/// side is nearer to the truth, however small the angle; unless something blocks that side, too.
/// \param now  with a guidance whose angle to steer to lies within the hour 12
/// \param in_the_way  m, gap; a thing farther ahead need not be passed yet
/// \param held  the last answer led off, so that it takes more to lead ahead again
/// \return 12, or 1 or 11
[[nodiscard]] int lead_off(const Observation& now, double in_the_way, bool held);

}  // namespace navvi_feedback::cues
