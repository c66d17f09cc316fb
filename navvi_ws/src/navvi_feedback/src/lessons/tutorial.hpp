#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lessons/exercise.hpp"
#include "lessons/lesson.hpp"
#include "lessons/teller.hpp"

namespace navvi_feedback::lessons {

/// What a newcomer learns, from letting go of the stick to a first goal. Each step is told, and
/// passed by doing it; who does something else is told what, and tries again. At the end the
/// weakest step is practised once more. Next passes over a step, repeat tells it again, end ends
/// it.
class Tutorial : public Lesson {
 public:
  [[nodiscard]] static const std::vector<Step>& steps();
  /// The keys of all texts.
  [[nodiscard]] static std::vector<std::string> texts();

  struct Result {
    std::string step;
    int tries = 1;
    double seconds = 0.0;  ///< from its first try on
    bool passed = false;
    bool practice = false;  ///< once more, as the weakest
  };

  /// \throws navvi_config::ConfigError if the phrases lack a text
  Tutorial(const cues::Phrases& phrases, const drive::ButtonsConfig& buttons);

  [[nodiscard]] Taught update(const Observation& seen, double time) override;
  [[nodiscard]] bool over() const override { return over_; }
  [[nodiscard]] bool drives() const override;
  [[nodiscard]] bool speaks() const override { return !in_trial_; }
  [[nodiscard]] bool takes(drive::Button button) const override;
  [[nodiscard]] std::string record() const override;
  [[nodiscard]] const std::vector<Result>& results() const { return results_; }

 private:
  enum class Phase { telling, doing, leaving };

  void buttons(const Observation& seen);
  void begin(std::size_t step);
  void attempt();
  void act(const Observation& seen, double dt, Taught& taught);
  void finish(bool passed);
  void next();
  [[nodiscard]] bool given(const Step& step) const;
  [[nodiscard]] std::optional<std::size_t> weakest() const;
  [[nodiscard]] const Step& step() const { return steps()[at_]; }

  Teller teller_;
  drive::ButtonsConfig buttons_;
  Phase phase_ = Phase::telling;
  std::size_t at_ = 0;
  bool over_ = false;
  bool in_trial_ = false;
  bool practising_ = false;
  bool audible_ = true, motors_ = true;
  std::vector<Result> results_;       ///< the last is of the step that is being made
  std::optional<double> step_since_;  ///< s
  double time_ = 0.0;                 ///< s, of the last update
  navvi_types::TrialState::State trial_ = navvi_types::TrialState::State::free;

  // Of one try.
  double since_ = 0.0;  ///< s
  Moved moved_;
  Exercise exercise_;
};

}  // namespace navvi_feedback::lessons
