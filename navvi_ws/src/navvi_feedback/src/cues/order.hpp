#pragma once

#include <optional>
#include <vector>

#include "cues/halt.hpp"
#include "cues/held_stick.hpp"
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
  void update(const Tick& tick, const StateCues& state, const HeldStick& held, const Halt& halt,
              const RouteCues& route, bool leads, const std::vector<Cue>& told);
  /// The voice has begun, cut or dropped a cue: what it does not say is not shown, either.
  void note(const CueEvent& event, double time);

  /// nullopt: nothing
  [[nodiscard]] const std::optional<Utterance>& now() const {
    return undriveable_ ? undriveable_ : event_ ? event_->words : lasting_;
  }
  /// The wheels are stopped until the stick, or the emergency stop, was released.
  [[nodiscard]] bool stopped() const {
    const CueKind kind = now() ? now()->kind : CueKind::lesson;
    return kind == CueKind::robot_stopped || kind == CueKind::emergency_stop;
  }
  /// The words, where they are those that the voice said; empty: those of now() are meant
  [[nodiscard]] std::string said() const { return !undriveable_ && event_ ? event_->text : ""; }

 private:
  struct Event {
    std::optional<Utterance> words;
    std::string text;
    double time = 0.0;     ///< s
    std::uint32_t id = 0;  ///< of the cue; 0: it was felt instead of said
  };

  std::optional<Utterance> undriveable_;
  std::optional<Event> event_;  ///< of a kind that is shown for some seconds
  std::optional<Utterance> lasting_;
};

}  // namespace navvi_feedback::cues
