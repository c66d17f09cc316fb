#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lessons/lesson.hpp"
#include "lessons/teller.hpp"

namespace navvi_feedback::lessons {

/// Finds the weakest strength that is felt: weaker after each that was, stronger after each that
/// was not, in steps that are halved after the first turn (in the logarithm of the strength). The
/// threshold is the mean of the last turns.
class Staircase {
 public:
  /// [0, 1], to be given next
  [[nodiscard]] double strength() const { return strength_; }
  void answer(bool felt);
  [[nodiscard]] bool done() const { return turns_.size() >= 6 || ends_ >= 2; }
  /// [0, 1]; nullopt if even the strongest was not felt
  [[nodiscard]] std::optional<double> threshold() const;

 private:
  double strength_ = 0.3;
  std::optional<bool> last_;
  std::vector<double> turns_;  ///< strengths at which the answer was another than before
  int ends_ = 0;               ///< in succession, at the weakest or strongest strength
};

/// Finds out, by voice and buttons, what a person feels of each motor, how strong they like it,
/// and how long they take to let go of the stick at the sound that ends a turn. Says what it found,
/// and keeps it if the person wants. A prompt is told again after a silence, and by any button that
/// has nothing else to do.
class Calibration : public Lesson {
 public:
  /// \param haptics  as set so far; its `pads` are kept
  /// \param pad  what identifies it; without spaces
  /// \param robot_delay  s, that the robot adds to the person's delay in a turn
  /// \throws navvi_config::ConfigError if the phrases lack a text
  Calibration(const cues::Phrases& phrases, const drive::ButtonsConfig& buttons,
              const haptics::HapticsConfig& haptics, std::string pad, double robot_delay);

  [[nodiscard]] Taught update(const Observation& seen, double time) override;
  [[nodiscard]] bool over() const override { return over_; }
  [[nodiscard]] std::vector<std::string> settings() const override;
  [[nodiscard]] std::string record() const override;

  /// The keys of all texts.
  [[nodiscard]] static std::vector<std::string> texts();

 private:
  enum class Stage { left, right, comfort, halt, confirm, end };

  void enter(Stage stage, const Observation& seen);
  void feel(const Observation& seen, Taught& taught);
  void choose(const Observation& seen, Taught& taught);
  void halt(const Observation& seen, Taught& taught);
  void let_go(double delay, const Observation& seen);
  void tell_found();
  void confirm(const Observation& seen);
  void prompt();
  void prompt_again(const Observation& seen);
  [[nodiscard]] double delay() const;
  [[nodiscard]] double pause();

  haptics::HapticsConfig haptics_;
  std::string pad_;
  double robot_delay_;
  Teller teller_;
  Stage stage_ = Stage::end;
  bool begun_ = false;
  bool over_ = false;
  bool complete_ = false;
  double time_ = 0.0;  ///< s, of the last update

  Staircase staircase_;
  std::optional<double> left_, right_;  ///< thresholds
  double gain_ = 0.7;
  std::vector<double> delays_;       ///< s
  std::optional<double> due_;        ///< s, of the next signal
  std::optional<double> signalled_;  ///< s, of the last one
  int signals_ = 0;
  int late_ = 0;                        ///< answers that were none
  std::optional<double> silent_since_;  ///< s, neither the person nor the voice has done anything
};

}  // namespace navvi_feedback::lessons
