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
#include "cues/cue.hpp"
#include "drive/buttons.hpp"
#include "drive/drive.hpp"
#include "haptics/haptics.hpp"
#include "haptics/pattern.hpp"
#include "navvi_feedback/cues/link.hpp"
#include "navvi_feedback/drive/input_state.hpp"
#include "navvi_feedback/sounds/earcon.hpp"
#include "navvi_feedback/sounds/learnt.hpp"

namespace navvi_feedback {
using navvi_types::Contact;
using navvi_types::DriveState;
using navvi_types::Guidance;
using navvi_types::Odometry;
using navvi_types::Proximity;
using navvi_types::Scenario;
using navvi_types::TrialRequest;
using navvi_types::TrialState;
}  // namespace navvi_feedback

namespace navvi_feedback::core {

struct NearNow;
struct SoundsNow;

/// All decisions of feedback_node: the command for the wheels, the motors of the pad, what is said
/// and what sounds.
/// Times are s of one clock that does not run backwards.
class Feedback {
 public:
  /// The hands, and the state of the devices.
  struct Input {
    drive::InputState hands;
    bool keyboard = false;  ///< the hands are on the arrow keys
    cues::Link audio = cues::Link::alive;
    bool sounds = true;                       ///< short sounds can be heard
    bool motors = true;                       ///< false if our own pad is not connected
    bool felt = true;                         ///< there are motors that somebody feels
    std::string pad;                          ///< what identifies the motors, without spaces
    bool voice_busy = false;                  ///< something is being spoken or waits for it
    std::optional<navvi_types::Pose2> robot;  ///< base_link in map, if known
    std::vector<drive::Button> asked;  ///< by other means than the hands, since the last update
    std::vector<CueKind> notices;      ///< as Situation::notices
    std::string person;                ///< whose settings are used, if anybody's
  };
  struct Output {
    std::optional<Velocity> command;  ///< nullopt: nothing is sent
    double share = 1.0;  ///< [0, 1], of the person's speed that assistance lets through
    haptics::Rumble rumble;
    std::optional<haptics::Pattern> pattern;  ///< that `rumble` is part of
    bool alarm_begins = false;                ///< the motors begin to report that there is no sound
    std::vector<cues::Cue> cues;              ///< to be spoken, most urgent first
    std::vector<sounds::Play> plays;          ///< to be played now
    std::optional<TrialRequest::Kind> request;
    std::optional<Eigen::Vector2d> goal;  ///< m, in map, that the person has chosen
    std::string change;  ///< that the person has made, such as "speaker/rate:=240"; empty: none
    bool lesson_over = false;           ///< of FeedbackConfig::lesson
    std::string record;                 ///< how it went so far, as a table in CSV
    std::vector<std::string> settings;  ///< that it has found, such as haptics/enabled:=true
  };

  /// \param phrases  file of the spoken phrases
  /// \throws navvi_config::ConfigError if that file or the classes that are felt cannot be used
  Feedback(const FeedbackConfig& config, const std::filesystem::path& phrases);
  ~Feedback();

  void take(const Proximity& proximity, double time) { nearby_ = {proximity.things, time}; }
  void take(const Guidance& guidance, double time) {
    guidance_ = {guidance, time};
    turned_ = 0.0;
  }
  void take(const DriveState& state, double /*time*/) {
    gate_ = state.state;
    intruder_ = !state.intruder.empty();
  }
  /// A trial_node that repeats its state, and then is silent while a trial runs, records no more.
  void take(const TrialState& state, double time);
  void take(const Odometry& odometry, double time) { motion_ = {odometry.velocity, time}; }
  void take(const Scenario& scenario, double time);
  /// From any source. \param goal  m, in map
  void take_goal(const Eigen::Vector2d& goal);
  void take(const Contact& contact) { contacts_.push_back(contact); }
  /// What another program wants to be felt, until it is stale.
  void take(const haptics::Rumble& others, double time) { others_ = {others, time}; }
  /// What the person can set, by parameter.
  void take_settings(const std::map<std::string, std::string>& values);
  /// From now on, as far as the person can set it: touch, sounds and wording.
  void use(const FeedbackConfig& config);

  /// Call it at 50 Hz.
  [[nodiscard]] Output update(const Input& input, double time);
  /// As CuePolicy::note().
  void note(const std::vector<CueEvent>& events);

  /// nullopt where turns have no sound
  [[nodiscard]] std::optional<sounds::Learnt> learnt() const;
  /// The latest guidance, however old.
  [[nodiscard]] const std::optional<Guidance>& guidance() const { return guidance_.value; }
  [[nodiscard]] bool guidance_fresh(double time) const {
    return guidance_.link(time, config_.stale) == cues::Link::alive;
  }

 private:
  /// The latest message of a kind, and when it came.
  template <typename T>
  struct Latest {
    std::optional<T> value;
    std::optional<double> time;

    [[nodiscard]] cues::Link link(double now, double stale) const {
      if (!time) return cues::Link::never;
      return now - *time <= stale ? cues::Link::alive : cues::Link::lost;
    }
  };

  struct Deciders;

  [[nodiscard]] std::optional<Velocity> command(const drive::InputState& hands, double dt);
  [[nodiscard]] double assist(std::optional<Velocity>& command, double time) const;
  /// \param pressed  loses what is for the lesson alone
  void teach(const Input& input, std::vector<drive::Button>& pressed, double time);
  /// Carries out what the menu makes of the buttons. \return its answer
  std::optional<cues::Utterance> obey(const std::vector<drive::Button>& pressed,
                                      const std::string& pad, Output& out);
  [[nodiscard]] cues::Situation situation(const Input& input,
                                          const std::vector<drive::Button>& pressed,
                                          const std::optional<cues::Utterance>& answer,
                                          double time) const;
  [[nodiscard]] cues::Link pad_link(const drive::InputState& hands) const;
  /// rad, clockwise from the nose to where to steer, if the person is to be told.
  [[nodiscard]] std::optional<double> off_course(double time) const;
  [[nodiscard]] NearNow near_now(double time) const;
  [[nodiscard]] SoundsNow sounds_now(const Input& input, double time) const;

  FeedbackConfig config_;
  std::unique_ptr<Deciders> deciders_;
  std::vector<std::string>
      begun_;  ///< texts of a lesson that began to be heard since the last update

  Latest<std::vector<NearThing>> nearby_;
  Latest<Guidance> guidance_;
  Latest<haptics::Rumble> others_;
  std::optional<DriveState::State> gate_;
  bool intruder_ = false;  ///< that gate ignores another node's commands
  TrialState trial_;
  std::optional<double> trial_time_;  ///< when it came
  bool trial_repeats_ = false;        ///< the same state has come again
  std::optional<Scenario> scenario_;
  Latest<Velocity> motion_;
  double turned_ = 0.0;            ///< rad, counter-clockwise, since that guidance
  std::vector<Contact> contacts_;  ///< since the last update

  std::optional<double> last_update_;
  drive::InputState last_hands_;
  bool seen_hands_ = false;
  std::optional<std::uint32_t> important_;  ///< the safety phrase that is being spoken
  Velocity commanded_;
  double idle_ = 0.0;  ///< s, since the person last drove, or had reason to
  bool held_unarmed_ = false;
};

}  // namespace navvi_feedback::core
