#pragma once

#include "record/figures.hpp"

namespace navvi_study::record {

/// How much was said, and how well it could be obeyed.
struct Speech {
  int cues = 0;      ///< sentences
  int words = 0;
  int repeats = 0;   ///< of a sentence, again within 10 s, that nobody had asked for
  int waits = 0;     ///< unasked words to stop
  int hasty = 0;     ///< of these, followed by another sentence within 2 s, before it can be obeyed
  int at_odds = 0;   ///< "straight ahead" and that something is ahead within 2 s
  double talk = 0.0; ///< s
};
[[nodiscard]] Speech speech_of(const Trial& trial);

/// Whether the directions that were spoken agree with one another.
struct Directions {
  int turns = 0;     ///< changes of the announced hour
  int flips = 0;     ///< a direction contradicts the one just before
  int misled = 0;    ///< the turn that is ordered is not the one announced for that corner
  int reversed = 0;  ///< a direction leads 4 hours or more elsewhere than one within 4 s before, no
                     ///< corner and no new route being told
};
/// nullopt where the record does not hold what the words mean, or no track.
[[nodiscard]] std::optional<Directions> directions_of(const Trial& trial);

}  // namespace navvi_study::record
