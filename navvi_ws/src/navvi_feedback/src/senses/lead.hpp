#pragma once

#include <array>

namespace navvi_feedback::senses {

/// What leads a person along the way.
enum class Lead {
  words,
  ticks,  ///< a sound that counts turns down, and words
  flow,   ///< a sound that lasts: its side where to steer, its pitch how fast
  hand,   ///< pulses of the motors, likewise
};
[[nodiscard]] constexpr std::array<const char*, 4> names(Lead) {
  return {"words", "ticks", "flow", "hand"};
}
/// It leads while the person drives, without a stop before a turn.
[[nodiscard]] constexpr bool lasts(Lead lead) { return lead == Lead::flow || lead == Lead::hand; }

}  // namespace navvi_feedback::senses
