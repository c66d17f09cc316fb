#pragma once

#include <optional>
#include <vector>

#include "cues/cue.hpp"
#include "lessons/lesson.hpp"
#include "senses/observation.hpp"
#include "sounds/sounds_config.hpp"
#include "sounds/turn_notice.hpp"
#include "sounds/turn_sound.hpp"

namespace navvi_feedback::core {

class AuditoryDisplay {
 public:
  /// To where the person is led now, each as TurnSound takes it.
  struct Steering {
    std::optional<double> off;
    bool fine = false;
    Velocity motion;
  };

  explicit AuditoryDisplay(const sounds::SoundsConfig& config)
      : config_(config), turn_(config.turn) {}

  /// From now on. What was learnt of turns stays.
  void use(const sounds::SoundsConfig& config);

  /// Takes what sounds out of what is to be said, and adds what sounds besides. Call it at 50 Hz.
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::vector<sounds::Play> update(std::vector<cues::Cue>& cues,
                                                 const Observation& now, const Steering& lead,
                                                 const lessons::Taught& taught, double time);
  /// Of this person and robot; nullopt where nothing sounds.
  [[nodiscard]] std::optional<sounds::Learnt> learnt() const;
  /// What counts turns down.
  [[nodiscard]] sounds::TurnSound& turn() { return turn_; }
  [[nodiscard]] const sounds::TurnSound& turn() const { return turn_; }
  /// One of the chosen loudness, from ahead.
  [[nodiscard]] sounds::Play sample(sounds::Earcon earcon) const;

 private:
  /// What comes again and again.
  void add_recurring(const Observation& now, const Steering& lead, double time,
                     std::vector<sounds::Play>& plays);

  sounds::SoundsConfig config_;
  sounds::TurnSound turn_;
  sounds::TurnNotice notice_;
  std::optional<double> beacon_;  ///< s, when it was heard last
};

}  // namespace navvi_feedback::core
