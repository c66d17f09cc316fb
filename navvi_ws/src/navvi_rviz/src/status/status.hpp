#pragma once

#include <cstdint>
#include <navvi_types/cue_event.hpp>
#include <navvi_types/drive_state.hpp>
#include <navvi_types/guidance.hpp>
#include <navvi_types/trial.hpp>
#include <optional>
#include <string>

#include "status/words.hpp"

namespace navvi_rviz::status {

/// What a person reads at a glance.
struct Shown {
  enum class Tone { calm, wait, alarm, good };

  std::string banner = {};  ///< what matters most now, such as "stop, worker ahead"; empty: nothing
  Tone tone = Tone::calm;   ///< of the banner
  std::string instruction = {};      ///< what the guide said last; of the way: as it is now
  std::string menu = {};             ///< what the spoken menu offers; empty while it is closed
  std::string distance = {};         ///< left to the goal along the path; empty: not known
  double speed = 0.0;                ///< m/s, >= 0
  std::optional<double> clock = {};  ///< s, since the trial began
  bool sound = true;                 ///< false: nothing can be heard
};

/// Turns what the nodes tell into words, in the language of the session. Times are s of one clock
/// that does not run backwards.
class Status {
 public:
  /// From now on.
  void use(const Words& words) { words_ = words; }
  [[nodiscard]] const Words& words() const { return words_; }
  void take(const navvi_types::CueEvent& cue, double time);
  void take(const navvi_types::Guidance& guidance);
  void take(const navvi_types::DriveState& state) { gate_ = state.state; }
  void take(const navvi_types::TrialState& state);
  void take_speed(double speed) { speed_ = speed; }
  [[nodiscard]] bool trial_runs() const {
    return trial_ == navvi_types::TrialState::State::running;
  }
  /// What the person is to do from now on.
  void take_order(const navvi_types::CueEvent& order);
  /// For the person to begin it.
  [[nodiscard]] bool trial_waits() const { return trial_ == navvi_types::TrialState::State::ready; }
  /// \param ros_time  s, of the event
  void take_event(const std::string& type, double ros_time);
  /// \param state  as in /diagnostics: works, missing, off
  void take_device(const std::string& name, const std::string& state, double time);

  /// \param input  where the stick comes from, as in /diagnostics
  void take_input(const std::string& input) { keyboard_ = input == "keyboard"; }
  /// The hands are on the arrow keys.
  [[nodiscard]] bool keyboard() const { return keyboard_; }

  /// \param ros_time  s, of the same clock as the events
  [[nodiscard]] Shown shown(double time, double ros_time) const;

 private:
  struct Said {
    navvi_types::CueKind kind;
    std::string text;
    double time;
  };
  struct Order {
    navvi_types::CueKind kind = navvi_types::CueKind::lesson;
    std::string text = {};  ///< empty: nothing is to be done
  };

  [[nodiscard]] std::string instruction(double time) const;
  void choose_banner(double time, Shown& shown) const;

  Words words_;
  bool keyboard_ = false;
  std::optional<navvi_types::Guidance> guidance_;
  std::optional<navvi_types::DriveState::State> gate_;
  std::optional<navvi_types::TrialState::State> trial_;
  std::optional<Said> last_;
  std::optional<Order> order_;  ///< nullopt: none has come yet
  std::string menu_;
  double speed_ = 0.0;
  std::optional<double> begun_, ended_;  ///< s, ROS time
  std::optional<double> silent_;         ///< since when nothing can be heard
};

}  // namespace navvi_rviz::status
