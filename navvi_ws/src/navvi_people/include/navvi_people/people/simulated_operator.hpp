#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "navvi_config/field.hpp"
#include "navvi_people/people/driving.hpp"
#include "navvi_people/people/ears.hpp"
#include "navvi_people/people/feeling.hpp"
#include "navvi_people/people/heard.hpp"
#include "navvi_people/people/mind.hpp"
#include "navvi_people/people/situation.hpp"
#include "navvi_people/people/tracking.hpp"

namespace navvi_people::people {

/// Each part in a group of its own. What typed() sets stands in the table of traits.
struct SimulatedOperatorConfig {
  int seed = 1;
  std::string type = "able";
  std::string lead = "ticks";  ///< the way of leading that the person was taught
  double worse = 1.0;
  HearingConfig hearing;
  TrackingConfig tracking;
  TurningConfig turning;
  DrivingConfig driving;
  FeelingConfig feeling;
  MemoryConfig memory;
  AttentionConfig attention;
  LearningConfig learning;

  void describe(navvi_config::Visitor& visit);
  /// With the traits of its type, drawn ones from its seed, so much the worse; and without what the
  /// type does not hear.
  [[nodiscard]] SimulatedOperatorConfig typed() const;
};

struct StickAndButtons {
  double left = 0.0;     ///< stick [-1, 1], left is positive
  double forward = 0.0;  ///< stick [-1, 1], forward is positive
  bool repeat = false;   ///< asks for the last direction again
  bool start = false;    ///< begins the trial
};

/// Drives by ear and touch alone, as a blind person would (R-TRL-5): it knows the words that it
/// heard to their end, the sounds and their sides (ahead and behind sound alike), the motors it
/// feels, and, roughly, how its own stick turns and drives the robot. Its parts decide how late and
/// how wrongly. It does what is taught: after "stop" and "wait" it stays until "go on".
class SimulatedOperator {
 public:
  /// \param listener  to the language that the person speaks
  /// \param occasion  seed of what happens by chance, as is the world's: on another occasion the
  /// same person hears, misses and trembles otherwise
  SimulatedOperator(const SimulatedOperatorConfig& config, Listener listener, int occasion);

  void hear(const Heard& heard, double time);
  void feel(const Felt& felt, double time);
  /// \param time  s, not going back \param dt  s since the last update
  [[nodiscard]] StickAndButtons update(double time, double dt);

  /// What it makes of a sentence.
  [[nodiscard]] const Listener& listener() const { return ears_.listener(); }
  [[nodiscard]] bool arrived() const { return now_.mode == Mode::arrived; }
  [[nodiscard]] bool gave_up() const { return attention_.gave_up(); }

 private:
  using Mode = Situation::Mode;
  /// \return nullopt: the next one decides
  using Rule = std::optional<StickAndButtons> (SimulatedOperator::*)(double time, double dt);

  void hear_words(const Speech& speech, double time);
  void understood(std::uint32_t id, double time);
  void touch(double time);
  void react_to_what_is_due(double time);
  void react(const Sentence& sentence, double time);
  void react(const Tone& tone, double time);
  void react(Meaning meaning, double time);
  void obey(const Sentence& sentence, const Instruction& told, double time);
  void turn_to(const Sentence& sentence, const Instruction& told, double time);
  void be_startled(double time);
  [[nodiscard]] StickAndButtons act(double time, double dt);
  [[nodiscard]] std::optional<StickAndButtons> follow_display(double time, double dt);
  [[nodiscard]] std::optional<StickAndButtons> wait(double time, double dt);
  [[nodiscard]] std::optional<StickAndButtons> follow_ticks(double time, double dt);
  [[nodiscard]] std::optional<StickAndButtons> turn(double time, double dt);
  [[nodiscard]] std::optional<StickAndButtons> drive(double time, double dt);
  [[nodiscard]] std::optional<StickAndButtons> back(double time, double dt);
  void ask_when_lost(double time);
  void believe(const StickAndButtons& hand, double dt);

  SimulatedOperatorConfig config_;
  Learning learning_;
  Ears ears_;
  Turning turning_;
  Driving driving_;
  Feeling feeling_;
  Memory memory_;
  Attention attention_;
  Tracking tracking_;  ///< of what is shown all the time
  Pulses pulses_;
  Situation now_;
  Felt felt_;                ///< now
  std::optional<Aim> flow_;  ///< that sounds
  StickAndButtons held_;     ///< by what is shown all the time, last
};

}  // namespace navvi_people::people
