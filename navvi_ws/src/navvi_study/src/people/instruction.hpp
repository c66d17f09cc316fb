#pragma once

#include <optional>

namespace navvi_study::people {

/// What a listener makes of a spoken sentence.
struct Instruction {
  enum class Kind {
    nothing,     ///< no word for the hands
    ready,       ///< a goal is told; a direction follows, or sounds lead
    turn,        ///< towards `hour`, then on
    straight,    ///< on as one goes
    turn_ahead,  ///< a turn comes in `distance`
    near,        ///< something is close at `side`
    bump,        ///< touched or stuck at `side`
    halt,        ///< hands off
    begin,       ///< press start
    arrived
  };
  enum class Side { none, left, right, ahead, behind };

  Kind kind = Kind::nothing;
  int hour = 12;                   ///< 1 to 12
  std::optional<double> distance;  ///< m
  Side side = Side::none;
  bool very_close = false;  ///< of what is near
  bool slight = false;      ///< a turn of less than half an hour
  bool goes_on = false;     ///< after "go on"
};

}  // namespace navvi_study::people
