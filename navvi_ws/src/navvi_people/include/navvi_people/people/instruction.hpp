#pragma once

#include <navvi_types/cue_kind.hpp>
#include <optional>

namespace navvi_people::people {

using navvi_types::Ask;

/// What a listener makes of a spoken sentence.
struct Instruction {
  enum class Side { none, left, right, ahead, behind };

  Ask asks = Ask::nothing;
  int hour = 12;                   ///< 1 to 12
  std::optional<double> distance;  ///< m
  Side side = Side::none;
  bool very_close = false;  ///< of what is near
  bool slight = false;      ///< a turn of less than half an hour
  bool goes_on = false;     ///< after "go on"
  bool holds = false;       ///< until "go on"
};

/// Left for right.
[[nodiscard]] Instruction mirrored(Instruction told);

}  // namespace navvi_people::people
