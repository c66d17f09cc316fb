#pragma once

#include <Eigen/Core>
#include <any>
#include <filesystem>
#include <map>
#include <memory>
#include <navvi_config/field.hpp>
#include <navvi_types/cue_event.hpp>
#include <navvi_types/drive_state.hpp>
#include <navvi_types/guidance.hpp>
#include <navvi_types/link_state.hpp>
#include <navvi_types/motion.hpp>
#include <navvi_types/scenario.hpp>
#include <navvi_types/thing.hpp>
#include <navvi_types/trial.hpp>
#include <navvi_types/zone.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "navvi_feedback/cues/voice_order.hpp"
#include "navvi_feedback/haptics/rumble.hpp"
#include "navvi_feedback/menu/places_file.hpp"
#include "navvi_feedback/senses/devices.hpp"
#include "navvi_feedback/sounds/earcon.hpp"
#include "navvi_feedback/sounds/learnt.hpp"

namespace navvi_feedback::core {

using senses::Devices;

/// The parameters of feedback_node's core.
class GuideConfig {
 public:
  GuideConfig();

  void describe(navvi_config::Visitor& visit);
  [[nodiscard]] bool has_sounds() const;
  /// The way of leading. \param audible  there is something to hear
  [[nodiscard]] std::string lead(bool audible) const;

  /// Known to this package alone.
  struct Values;
  [[nodiscard]] Values* operator->();
  [[nodiscard]] const Values* operator->() const;

 private:
  std::any values_;
};

/// What goes to the wheels, to the person and to other nodes after one beat.
struct Output {
  std::optional<navvi_types::Velocity> command;  ///< nullopt: nothing is sent
  double lag = 0.0;  ///< s, of a simulated connection: the age of what the command answers
  /// m, in map, where the robot will stand if the stick is let go now; nullopt without a delay
  std::optional<Eigen::Vector2d> stops_at;

  haptics::Rumble rumble;                     ///< of the motors, now
  bool rumble_due = false;                    ///< other drivers are to be sent it
  bool rumble_moved = false;                  ///< and it has changed
  std::optional<navvi_types::CueEvent> felt;  ///< worth a row of the record
  haptics::Rumble flow;    ///< shares of both ears of the sound that lasts, as lead::flow_of()
  double flow_gain = 0.0;  ///< [0, 1]
  std::optional<navvi_types::CueEvent> flowed;  ///< worth a row of the record

  bool alarm_begins = false;  ///< the motors begin to report that there is no sound

  cues::VoiceOrder voice;
  bool answers = false;                     ///< a button's question among the words
  std::vector<navvi_types::CueEvent> said;  ///< of the words, in order
  std::vector<sounds::Play> plays;          ///< short sounds that begin now

  std::optional<navvi_types::TrialRequest::Kind> request;
  std::optional<Eigen::Vector2d> goal;    ///< m, in map, that the person has chosen
  std::optional<menu::NamedPlace> place;  ///< to be remembered
  std::string change;  ///< that the person has made, such as "speaker/rate:=240"; empty: none

  bool lesson_over = false;
  std::string record;                 ///< how the lesson went so far, as a table in CSV
  std::vector<std::string> settings;  ///< that it has found, such as haptics/enabled:=true
};

/// Of a file, read once for any number of guides. \throws navvi_config::ConfigError
[[nodiscard]] std::shared_ptr<const cues::Phrases> read_phrases(const std::filesystem::path& file);

/// The core of feedback_node without devices and without a clock: values and a time go in, orders
/// to devices come out. feedback_node and the closed loop run this same class. Times are s of one
/// clock that does not run backwards; places are m, in map.
class Guide {
 public:
  /// \throws navvi_config::ConfigError if the classes that are felt cannot be used
  Guide(const GuideConfig& config, const cues::Phrases& phrases);
  ~Guide();

  using Message = std::variant<navvi_types::Proximity, navvi_types::Guidance,
                               navvi_types::DriveState, navvi_types::TrialState,
                               navvi_types::Odometry, navvi_types::Scenario, navvi_types::Contact,
                               navvi_types::LinkState, navvi_types::ZoneState>;
  void take(const Message& message, double time);
  /// From any source. \param goal  m, in map
  void take_goal(const Eigen::Vector2d& goal);
  /// A place to be remembered, as a click in RViz names it. \param at  m, in map
  void take_place(const Eigen::Vector2d& at);
  /// Values of the parameters that the menu offers.
  void offer(const std::map<std::string, std::string>& values);
  /// From now on, as far as a person can set it: touch, sounds and wording.
  void use(const GuideConfig& config);

  /// To be said once, with the next beat.
  void announce(const navvi_types::Content& content);
  /// The trial is over. \param words  that say so, unless the arrival does
  void end_trial(std::optional<navvi_types::Content> words);

  /// One beat, at 50 Hz.
  /// \return nullopt while messages that have waited for a halted program are still to be taken
  [[nodiscard]] std::optional<Output> update(const Devices& devices, double time);
  /// The session ends: announces it if a trial runs. \return whether a beat is due for it
  [[nodiscard]] bool end_session();
  /// The voice, or a pattern of the motors, is to come to its end before the session does.
  [[nodiscard]] bool has_last_words() const;
  /// A beat for these alone: the wheels get nothing, nor the motors anything else.
  [[nodiscard]] Output hear_out(const Devices& devices, double time);
  /// Ends all words.
  [[nodiscard]] Output finish(const Devices& devices);

  /// Numbered for the record: a sound that was played.
  [[nodiscard]] navvi_types::CueEvent event_of(const sounds::Play& play);

  /// What the person is to do now, for the picture: it holds until there is another; nullopt:
  /// nothing
  [[nodiscard]] std::optional<navvi_types::CueEvent> order() const;
  /// nullopt where turns have no sound
  [[nodiscard]] std::optional<sounds::Learnt> learnt() const;
  /// The latest, however old.
  [[nodiscard]] const std::optional<navvi_types::Guidance>& guidance() const;
  [[nodiscard]] bool guidance_fresh(double time) const;

  /// Known to this package alone.
  struct Parts;
  [[nodiscard]] const Parts& parts() const { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace navvi_feedback::core
