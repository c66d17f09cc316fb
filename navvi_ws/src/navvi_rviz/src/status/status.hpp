#pragma once

#include <cmath>
#include <filesystem>
#include <map>
#include <navvi_types/cue_event.hpp>
#include <navvi_types/cue_kind.hpp>
#include <navvi_types/drive_state.hpp>
#include <navvi_types/guidance.hpp>
#include <navvi_types/thing.hpp>
#include <navvi_types/trial.hpp>
#include <optional>
#include <string>
#include <utility>

namespace navvi_rviz::status {

/// The words of the picture, as the phrase file of the session has them.
class Words {
 public:
  Words() = default;
  /// \throws navvi_config::ConfigError if it cannot be read
  /// \param units  of lengths: meters or feet
  explicit Words(const std::filesystem::path& phrases, std::string units = "meters");

  /// \param key  section and key, such as "picture/wait"; empty: the file lacks it
  [[nodiscard]] std::string of(const std::string& key) const;
  /// What is said of this kind of cue, where nothing else is put into it.
  /// \param keyboard  the hands are on the arrow keys
  [[nodiscard]] std::string said(navvi_types::CueKind kind, bool keyboard) const;

  [[nodiscard]] std::optional<navvi_types::ThingClass> mover_in(const std::string& text) const;

  /// What is left to the goal, rounded as the voice does.
  /// \param metres  finite, >= 0
  [[nodiscard]] std::string to_go(double metres) const;

 private:
  std::string units_;
  std::map<std::string, std::string> texts_;
};

/// What a person reads at a glance.
struct Shown {
  enum class Tone { calm, wait, alarm, good };

  std::string banner = {};  ///< what matters most now, such as "stop, worker ahead"; empty: nothing
  Tone tone = Tone::calm;   ///< of the banner
  std::optional<navvi_types::ThingClass> mover = {};  ///< what the banner warns of, if that moves
  std::string instruction = {};      ///< what the guide said last; of the way: as it is now
  std::string menu = {};             ///< what the spoken menu offers; empty while it is closed
  std::string distance = {};         ///< left to the goal along the path; empty: not known
  std::optional<double> speed = {};  ///< m/s, >= 0; nullopt: not known
  std::optional<double> clock = {};  ///< s, since the trial began
  bool sound = true;                 ///< false: nothing can be heard
};

/// Turns what the nodes tell into words, in the language of the session. Times are s of one clock
/// that does not run backwards.
class Status {
 public:
  void use(const Words& words) { words_ = words; }
  [[nodiscard]] const Words& words() const { return words_; }
  void take(const navvi_types::CueEvent& cue, double time);
  void take(const navvi_types::Guidance& guidance, double time);
  /// The latest.
  [[nodiscard]] const std::optional<navvi_types::Guidance>& guidance() const { return guidance_; }
  void take(const navvi_types::DriveState& state) { gate_ = state.state; }
  void take(const navvi_types::TrialState& state);
  void take_speed(double speed, double time) { speed_ = {std::abs(speed), time}; }
  [[nodiscard]] bool trial_runs() const {
    return trial_ == navvi_types::TrialState::State::running;
  }
  /// What the person is to do from now on.
  void take_order(const navvi_types::CueEvent& order);
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
  std::optional<std::pair<double, double>> speed_;  ///< m/s, and when it came
  double guided_ = 0.0;                             ///< when the guidance came
  std::optional<double> begun_, ended_;             ///< s, ROS time
  std::optional<double> silent_;                    ///< since when nothing can be heard
};

/// Keeps each banner, and each while without one, for 0.35 s: what is large and bright must not
/// flash more than three times a second (WCAG 2, 2.3.1).
class SteadyBanner {
 public:
  /// \param time  s, never less than before
  /// \return what is shown, with the banner that holds
  [[nodiscard]] Shown hold(Shown shown, double time);

 private:
  std::optional<Shown> last_;
  double since_ = 0.0;  ///< s, when its banner began
};

}  // namespace navvi_rviz::status
