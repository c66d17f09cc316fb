#pragma once

#include "navvi_feedback/sounds/learnt.hpp"
#include "sounds/sounds_config.hpp"

namespace navvi_feedback::sounds {

/// What turns teach of the person who makes them: how late they stop, how alike that is from turn
/// to turn, and whether sounds are good to lead them by at all.
class TurnLearning {
 public:
  explicit TurnLearning(const TurnConfig& config)
      : learns_(config.learn), learnt_{config.stopping_delay, config.stopping_spread} {}

  void use(const TurnConfig& config) { learns_ = config.learn; }

  /// The robot stands. \param took  s, since the sound to stop at
  void stopped(double took);
  /// \param error  rad, what is left of a turn that sounds have led, or, where no turn was made,
  /// all of it
  void led_by_sounds(double error);
  /// The person turned away from the side of a sound, or, as it asked to, to that side.
  void turned(bool away);
  /// They take it for one of the other side: words lead from now on.
  void found_sides_wrong();
  /// \param error  rad, what is left of a turn that words have led
  void led_by_words(double error);

  [[nodiscard]] const Learnt& learnt() const { return learnt_; }

 private:
  bool learns_;
  Learnt learnt_;
  int turns_ = 0;     ///< that sounds have led
  int stops_ = 0;     ///< of these, where the robot was told to stop, and did
  int bad_ = 0;       ///< of the latest of them, those that left too much
  int away_ = 0;      ///< turns away from the sound, as bad_
  int by_words_ = 0;  ///< in a row, that words have led well
  int trial_ = 4;     ///< of these, until sounds are tried again
};

}  // namespace navvi_feedback::sounds
