#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "navvi_config/field.hpp"
#include "navvi_people/people/driving.hpp"
#include "navvi_people/people/ears.hpp"
#include "navvi_people/people/feeling.hpp"
#include "navvi_people/people/heard.hpp"
#include "navvi_people/people/instruction.hpp"
#include "navvi_people/people/mind.hpp"
#include "navvi_people/people/tracking.hpp"

namespace navvi_people::people {

/// Each part in a group of its own. What a type sets stands in the table of traits.
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
  /// m, driven on without a word after a turn that a sound has ended; assumed
  static constexpr double kTrust = 10.0;

  void describe(navvi_config::Visitor& visit);
};

/// What the hands do.
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
  /// \param phrases  file of the phrases in the language that the person speaks
  /// \param occasion  seed of what happens by chance, as is the world's: on another occasion the
  /// same person hears, misses and trembles otherwise
  SimulatedOperator(const SimulatedOperatorConfig& config, const std::filesystem::path& phrases,
                    int occasion);

  void hear(const Heard& heard, double time);
  void feel(const Felt& felt, double time);
  /// \param time  s, not going back \param dt  s since the last update
  [[nodiscard]] StickAndButtons update(double time, double dt);

  /// What it makes of a sentence.
  [[nodiscard]] const Listener& listener() const { return ears_.listener(); }
  [[nodiscard]] bool arrived() const { return mode_ == Mode::arrived; }
  [[nodiscard]] bool gave_up() const { return attention_.gave_up(); }

 private:
  static constexpr double kNearTheEnd = 1.5;   ///< m to where one expects to stop
  static constexpr double kListenFirst = 2.5;  ///< m, likewise

  enum class Mode { waiting, turning, driving, backing, arrived };
  /// The ticks, or the motor, that tell to turn.
  struct Ticks {
    Instruction::Side side = Instruction::Side::none;
    double last = 0.0;  ///< s
    bool much = true;   ///< is left to turn
  };

  /// What the guide's words left behind.
  struct Words {
    std::optional<double> waits;  ///< s, since when for "go on"
    bool told_to_halt = false;
    bool spoken_to = false;
  };
  struct Sounds {
    std::optional<Ticks> ticks;
    double turned = -1e9;  ///< s, when they last led a turn
  };
  struct Course {
    double target = 0.0;           ///< rad, heading to hold
    double stop_at = 0.0;          ///< m on the odometer: further is guessing
    bool straight_before = false;  ///< the last direction that was followed was 12
    double speed = 0.0;            ///< stick
    double turn_speed = 0.0;
    double veer = 0.0;  ///< rad, added to the target
    double veer_until = 0.0;
  };
  struct Backing {
    double until = 0.0;
    bool other_side = false;
  };
  /// s, on the clock of update().
  struct Moments {
    bool started = false;
    double start = 0.0;
    double news = 0.0;  ///< the last
    double asked = -1e9;
    double shown = -1e9;  ///< what leads all the time, last
    double pressed = -1e9;  ///< start
    double bumped = -1e9;
    double careful_until = 0.0;
  };
  /// The last turn by words.
  struct Turned {
    std::optional<double> to;  ///< rad, clockwise
    double at = -1e9;          ///< s
  };

  void hear_words(const Speech& speech, double time);
  void touch(double time);
  void react(Meaning meaning, double time);
  void react(const Tone& tone, double time);
  void follow_tick(const Tone& tick, double time);
  void stop_turn(double time);
  [[nodiscard]] StickAndButtons turn_by_ear(double time) const;
  void understood(std::uint32_t id, double time);
  void react(const Sentence& sentence, double time);
  void obey(const Sentence& sentence, const Instruction& instruction, double time);
  void turn_to(const Sentence& sentence, const Instruction& instruction, double time);
  void go_for(const Sentence& sentence, const Instruction& instruction);
  void expect_turn(const Sentence& sentence, const Instruction& turn);
  void veer(Instruction::Side side, double angle, double until);
  [[nodiscard]] StickAndButtons act(double time, double dt);
  [[nodiscard]] std::optional<StickAndButtons> follow_display(double time, double dt);
  [[nodiscard]] StickAndButtons drive(double time) const;
  void shy_away(const Instruction& instruction, double time);
  void be_startled(double time);
  void wait_for_go_on(const Sentence& sentence, bool holds);
  void back_off(Instruction::Side side, double time);
  void ask_soon(double time);
  void press_start(double time);
  void go_ahead();
  void ask_when_lost(double time);
  void react_to_what_is_due(double time);
  void believe(const StickAndButtons& hand, double dt);

  SimulatedOperatorConfig config_;
  Learning learning_;
  Ears ears_;
  Turning turning_;
  Driving driving_;
  Feeling feeling_;
  Memory memory_;
  Attention attention_;
  Mode mode_ = Mode::waiting;
  Words words_;
  Sounds sounds_;
  Belief at_;
  Course course_;
  Backing backing_;
  Moments when_;
  Felt felt_;  ///< now
  Turned turned_;
  Tracking tracking_;  ///< of what is shown all the time
  Pulses pulses_;
  std::optional<Aim> flow_;  ///< that sounds
  StickAndButtons held_;  ///< by that, last
};

}  // namespace navvi_people::people
