#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <navvi_types/drive_state.hpp>
#include <navvi_types/guidance.hpp>
#include <navvi_types/scenario.hpp>
#include <navvi_types/trial.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/feedback_config.hpp"
#include "cues/asked.hpp"
#include "cues/cue.hpp"
#include "haptics/pattern.hpp"
#include "lead/course.hpp"
#include "lead/following.hpp"
#include "navvi_feedback/core/output.hpp"
#include "navvi_feedback/senses/devices.hpp"
#include "navvi_feedback/sounds/learnt.hpp"
#include "senses/senses.hpp"
#include "sounds/soundscape.hpp"

namespace navvi_feedback {
using navvi_types::Odometry;
using navvi_types::Proximity;
using navvi_types::Scenario;
using navvi_types::TrialRequest;
using senses::Devices;
}  // namespace navvi_feedback

namespace navvi_feedback::core {

/// All decisions of feedback_node: the command for the wheels, the motors of the pad, what is said
/// and what sounds.
/// Times are s of one clock that does not run backwards.
class Feedback {
 public:
  /// But for what the voice makes of the cues, and the motors of the rumble.
  struct Decided : Output {
    std::vector<cues::Cue> cues;              ///< to be spoken, most urgent first
    std::optional<haptics::Pattern> pattern;  ///< that `rumble` is part of
  };

  /// \param phrases  file of the spoken phrases
  /// \throws navvi_config::ConfigError if that file or the classes that are felt cannot be used
  Feedback(const FeedbackConfig& config, const std::filesystem::path& phrases);
  ~Feedback();

  void take(const Proximity& proximity, double time) { senses_.take(proximity, time); }
  void take(const Guidance& guidance, double time) { senses_.take(guidance, time); }
  void take(const DriveState& state, double /*time*/) { senses_.take(state); }
  void take(const TrialState& state, double time);
  void take(const Odometry& odometry, double time) { senses_.take(odometry, time); }
  void take(const Scenario& scenario, double time);
  /// From any source. \param goal  m, in map
  void take_goal(const Eigen::Vector2d& goal);
  /// A place to be remembered. \param at  m, in map
  void take_place(const Eigen::Vector2d& at) { shown_ = at; }
  void take(const Contact& contact) { senses_.take(contact); }
  /// What the person can set, by parameter.
  void take_settings(const std::map<std::string, std::string>& values);
  /// From now on, as far as the person can set it: touch, sounds and wording.
  void use(const FeedbackConfig& config);

  /// Call it at 50 Hz. \param voice_busy  something is being spoken or waits for it
  [[nodiscard]] Decided update(const Devices& devices, bool voice_busy, double time);
  /// As CuePolicy::note().
  void note(const std::vector<CueEvent>& events);

  /// What the person is to do now, as all of the picture shows it; nullopt: nothing
  [[nodiscard]] std::optional<cues::Cue> order() const;
  /// nullopt where turns have no sound
  [[nodiscard]] std::optional<sounds::Learnt> learnt() const;
  /// The latest guidance, however old.
  [[nodiscard]] const std::optional<Guidance>& guidance() const { return senses_.guidance(); }
  [[nodiscard]] bool guidance_fresh(double time) const { return senses_.guidance_fresh(time); }

 private:
  struct Deciders;

  [[nodiscard]] std::optional<Velocity> command(const Devices& devices, double dt);
  /// All that the decisions of this tick are made from.
  [[nodiscard]] Observation observe(const Devices& devices, bool voice_busy, double dt,
                                    double time);
  [[nodiscard]] double assist(std::optional<Velocity>& command, const Observation& now) const;
  [[nodiscard]] Lead leading(const Observation& now) const;
  void ask_side(Observation& now, double time, Output& out);
  /// Carries out what lesson and menu make of the buttons. \return what is left to be answered
  cues::Asked obey(const Observation& now, double dt, Output& out);
  /// \return the words of a choice that the planner has agreed to now
  std::optional<cues::Utterance> heed_planner(const Observation& now, double dt);
  /// \param at  m, in map; nullopt: it is not known \return what is told of it
  cues::Utterance remember(const std::optional<Eigen::Vector2d>& at, Output& out);
  /// To where the person is led now.
  [[nodiscard]] sounds::Soundscape::Steering lead(const Observation& now, double dt);
  [[nodiscard]] std::optional<double> off_course(const Observation& now) const;

  /// A goal of the menu that the planner has not answered yet.
  struct Chosen {
    Eigen::Vector2d goal;     ///< m, in map
    cues::Utterance words;    ///< that say so
    std::uint32_t plans = 0;  ///< of the planner, before
    double left = 0.0;        ///< s, to wait for it
  };

  FeedbackConfig config_;
  std::unique_ptr<Deciders> deciders_;
  senses::Senses senses_;
  lead::Pilot pilot_;
  lead::Following following_;  ///< what sounds all the time
  std::vector<std::string>
      begun_;  ///< texts of a lesson that began to be heard since the last update

  std::optional<Chosen> chosen_;
  std::optional<Eigen::Vector2d> shown_;  ///< m, in map: a place to be remembered
  std::optional<double> last_update_;
  drive::InputState last_hands_;
  std::optional<std::uint32_t> important_;  ///< the safety phrase that is being spoken
  Velocity commanded_;
  double idle_ = 0.0;  ///< s, since the person last drove, or had reason to
  std::optional<cues::Cue> lesson_;  ///< its last sentence, while one speaks
  bool felt_ = false;  ///< there were motors
  bool held_unarmed_ = false;
  bool pushed_disabled_ = false;
};

}  // namespace navvi_feedback::core
