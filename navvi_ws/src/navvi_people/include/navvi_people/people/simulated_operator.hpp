#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <navvi_types/cue_event.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_people/people/instruction.hpp"
#include "navvi_people/people/listener.hpp"

namespace navvi_people {
using navvi_types::CueEvent;
using navvi_types::Earcon;
}  // namespace navvi_people

namespace navvi_people::people {

struct SimulatedOperatorConfig {
  double min_reaction = 0.4;
  double max_reaction = 1.0;
  double turn_rate = 1.2;
  double full_speed = 0.9;
  double dead_zone = 0.12;
  double expo = 0.3;
  double gain_error = 0.10;
  double turn_error = 0.10;
  double cruise = 0.85;
  double slow = 0.6;
  double patience = 12.0;
  double idle_patience = 2.5;
  double strong_rumble = 0.6;
  std::string touch = "repulsive";
  double min_sound_reaction = 0.2;
  double max_sound_reaction = 0.4;
  double missed_sounds = 0.02;
  double trust = 10.0;
  bool obeys = false;

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
/// feels, and, roughly, how its own stick turns and drives the robot. It reacts late, misses some
/// sounds, and turns too far or too little, all drawn from the seed. How soon it answers sounds is
/// assumed, not measured. One that `obeys` does exactly what is taught: after "stop" and "wait" it
/// stays until "go on".
class SimulatedOperator {
 public:
  /// \param phrases  file of the phrases in the language that the person speaks
  SimulatedOperator(const SimulatedOperatorConfig& config, std::uint64_t seed,
                    const std::filesystem::path& phrases);

  /// Only speech that begins, ends or breaks off is heard, and short sounds.
  void hear(const CueEvent& cue, double time);
  /// \param left, right  motors [0, 1]
  void feel(double left, double right, double time);
  /// \param time  s, not going back \param dt  s since the last update
  [[nodiscard]] StickAndButtons update(double time, double dt);

  /// What it makes of a sentence.
  [[nodiscard]] const Listener& listener() const { return listener_; }
  [[nodiscard]] bool arrived() const { return mode_ == Mode::arrived; }
  /// What the hands are at, in words, for a trace.
  [[nodiscard]] std::string doing() const;

 private:
  enum class Mode { waiting, turning, driving, backing, arrived };
  /// A sentence, and where the operator believed to be when it began.
  struct Sentence {
    CueKind kind = CueKind::lesson;
    std::string text;
    double heading = 0.0;
    double odometer = 0.0;
    double begun = 0.0;  ///< s
    double time = 0.0;   ///< s: begun, or, once understood, when the hands will follow
  };

  /// A short sound, as the ear takes it.
  struct Heard {
    Earcon earcon = Earcon::turn;
    Instruction::Side side = Instruction::Side::none;
    double time = 0.0;              ///< s: when the hands will follow
    std::optional<bool> much = {};  ///< is left to turn; nullopt: as slow ticks tell
  };
  /// The ticks, or the motor, that tell to turn.
  struct Ticks {
    Instruction::Side side = Instruction::Side::none;
    double last = 0.0;  ///< s
    bool much = true;   ///< is left to turn
  };

  void hear_sound(Earcon earcon, double left, double right, double time);
  void follow(const Heard& sound, double time);
  void follow_tick(const Heard& tick, double time);
  void stop_turn(double time);
  [[nodiscard]] StickAndButtons turn_by_ear(double time) const;
  void understood(std::uint32_t id, double time);
  void follow(const Sentence& sentence, double time);
  void follow(const Sentence& sentence, const Instruction& instruction, double time);
  void turn_to(const Sentence& sentence, const Instruction& instruction);
  void go_for(const Sentence& sentence, const Instruction& instruction);
  void veer(Instruction::Side side, double angle, double until);
  [[nodiscard]] StickAndButtons act(double time, double dt);
  [[nodiscard]] StickAndButtons drive(double time) const;
  [[nodiscard]] double shaped(double stick) const;
  void shy_away(const Instruction& instruction, double time);
  void be_startled(double time);
  void wait_for_go_on(const Sentence& sentence);
  void back_off(Instruction::Side side, double time);
  void ask_soon(double time);
  void ask_when_lost(double time);

  SimulatedOperatorConfig config_;
  Listener listener_;
  std::mt19937_64 random_;
  std::mt19937_64 ear_random_;
  double sound_reaction_;  ///< s
  std::deque<Heard> heard_;
  std::optional<Ticks> ticks_;
  double turned_by_ear_ = -1e9;  ///< s
  bool told_to_halt_ = true;
  std::optional<double> waits_;  ///< s, since when for "go on"
  double turn_gain_;             ///< turns asked for are made this much too far
  double speed_gain_;            ///< distances are believed this much too long
  std::map<std::uint32_t, Sentence> hearing_;
  std::vector<Sentence> understood_;
  Mode mode_ = Mode::waiting;
  bool started_ = false;
  double start_ = 0.0;
  double heading_ = 0.0;          ///< rad, believed, counter-clockwise
  double odometer_ = 0.0;         ///< m, believed
  double target_ = 0.0;           ///< rad, heading to hold
  double stop_at_ = 0.0;          ///< m on the odometer: further is guessing
  bool straight_before_ = false;  ///< the last direction that was followed was 12
  double speed_ = 0.0;            ///< stick
  double turn_speed_ = 0.0;
  double veer_ = 0.0;  ///< rad, added to the target
  double veer_until_ = 0.0;
  double back_until_ = 0.0;
  double careful_until_ = 0.0;  ///< s
  double bumped_ = -1e9;
  bool other_side_ = false;
  double last_news_ = 0.0;
  double asked_ = -1e9;
  double pressed_ = -1e9;  ///< s, start
  double left_motor_ = 0.0;
  double right_motor_ = 0.0;
};

}  // namespace navvi_people::people
