#pragma once

#include <array>
#include <limits>
#include <optional>

#include "cues/halt.hpp"
#include "cues/held_stick.hpp"
#include "cues/route_cues.hpp"
#include "cues/state_cues.hpp"
#include "cues/tick.hpp"

namespace navvi_feedback::cues {

/// Answers what the person asks by a button, and again if the answer was dropped. The way is not
/// told a third time within seconds: words that never end would keep a person from driving.
class Answers {
 public:
  /// \param route  knows the way, and takes note that it was told
  /// \return the answer, if any; first of all the menu's
  [[nodiscard]] Utterances update(const Tick& tick, RouteCues& route, const Halt& halt,
                                  const StateCues& state, const HeldStick& held);
  /// That a wait is over, or begins just now, is a better answer than why a person waits: that one
  /// is withdrawn.
  void yield(Utterances& answer);

  /// These words have begun.
  void heard(const Content& content);
  void lost(const Content& content);

 private:
  /// Takes note that the way is asked for. \return false if that is too often
  [[nodiscard]] bool tells_way(double time);

  std::optional<Button> asked_;  ///< the last that was answered
  /// s, of the last two times that the way was told, the earlier one first
  std::array<double, 2> way_at_ = {-std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity()};
  std::optional<Content> answered_;   ///< the content of that, until it is heard
  std::optional<Button> question_;    ///< still to be answered, or again
  bool for_go_on_ = false;            ///< it waits for "go on", which is due soon
};

}  // namespace navvi_feedback::cues
