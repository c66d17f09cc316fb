#pragma once

#include <optional>
#include <vector>

#include "cues/halt.hpp"
#include "cues/route_cues.hpp"
#include "cues/state_cues.hpp"
#include "cues/tick.hpp"

namespace navvi_feedback::cues {

/// What the person is to do now, as one utterance: voice, banner, panel, plate and pad follow it.
/// Its kind says by the columns of navvi_types::CueTraits how each of them treats it.
class Order {
 public:
  /// Call it once all else of the tick is decided.
  /// \param leads  the path is to be followed now \param told  the cues of the tick
  void update(const Tick& tick, const StateCues& state, const Halt& halt, const RouteCues& route,
              bool leads, const std::vector<Cue>& told);

  /// nullopt: nothing
  [[nodiscard]] const std::optional<Utterance>& now() const { return now_; }
  /// The wheels are stopped until the stick was released.
  [[nodiscard]] bool stopped() const { return now_ && now_->kind == CueKind::robot_stopped; }
  /// The words, where they are those that the voice said; empty: those of now() are meant
  [[nodiscard]] const std::string& said() const { return said_; }

 private:
  struct Event {
    Utterance words;
    std::string text;
    double time = 0.0;  ///< s
  };

  std::optional<Event> event_;  ///< of a kind that is shown for some seconds
  std::optional<Utterance> now_;
  std::string said_;
};

}  // namespace navvi_feedback::cues
