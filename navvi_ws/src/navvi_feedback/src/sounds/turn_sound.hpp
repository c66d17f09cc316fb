#pragma once

#include <optional>

#include "navvi_feedback/sounds/earcon.hpp"
#include "navvi_feedback/sounds/learnt.hpp"
#include "sounds/sounds_config.hpp"
#include "types.hpp"

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

/// Counts a rotation down: while the heading is off, ticks from the side to turn to, the faster the
/// less is left; then a sound to stop at, early by what this person and robot take to stop, and
/// again while the robot turns on. Meanwhile the robot turns the slower the less is left, and
/// towards the end the slower the less alike this person's stops are. A soft one now and then while
/// the robot drives where it should: silence could be a fault. Where turns by sounds leave too much
/// it is silent, and words lead.
class TurnSound {
 public:
  explicit TurnSound(const TurnConfig& config) : config_(config), learning_(config) {}

  void use(const TurnConfig& config) {
    config_ = config;
    learning_.use(config);
  }

  /// Call it at 50 Hz.
  /// \param off  rad, clockwise from the nose to where to steer; nullopt: nowhere
  /// \param fine  a turn of half as much as usual counts
  /// \param motion  the robot's
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::optional<Play> update(std::optional<double> off, bool fine,
                                           const Velocity& motion, double time);

  /// The person takes its sounds for those of the other side: it is silent from now on.
  void find_sides_wrong() { learning_.found_sides_wrong(); }
  /// It does so where there is something to turn.
  [[nodiscard]] bool leads() const { return !learnt().words_lead; }
  /// rad/s, that the robot is to turn at most, so that a late hand does little; nullopt: no limit
  [[nodiscard]] std::optional<double> most_rate() const;
  [[nodiscard]] const Learnt& learnt() const { return learning_.learnt(); }

 private:
  struct Counting {
    double since = 0.0;            ///< s
    bool turned = false;           ///< the robot has, to the side of the ticks
    std::optional<double> ticked;  ///< s
    double away = 0.0;             ///< rad, that it now turns to the other side
    bool strayed = false;          ///< once far enough for a turn that went the wrong way
  };
  /// The turn that was told to end.
  struct Stopping {
    double since = 0.0;  ///< s
    double rate = 0.0;   ///< rad/s, at that moment
    double told = 0.0;   ///< s, when it was told last
    double angle = 0.0;  ///< rad, turned since the first time
  };

  [[nodiscard]] bool begins(double off, bool fine, double time);
  [[nodiscard]] std::optional<Play> count(double off, double rate, double dt, double time);
  [[nodiscard]] std::optional<Play> stop_again(double time);
  [[nodiscard]] std::optional<Play> on_course(const Velocity& motion, double time);
  void learn(std::optional<double> off, double rate, double dt, double time);
  void watch_words(std::optional<double> off, double rate);
  [[nodiscard]] double least_rate() const;

  TurnConfig config_;
  TurnLearning learning_;
  std::optional<Counting> counting_;
  double heard_ = 0.0;  ///< s, when any of its sounds began last
  std::optional<double> off_since_;
  std::optional<Stopping> stopping_;
  bool turns_by_words_ = false;
  double left_ = 0.0;  ///< rad, of the turn that is counted down or stopped; negative: too far
  double time_ = 0.0;  ///< s, of the last update
};

}  // namespace navvi_feedback::sounds
