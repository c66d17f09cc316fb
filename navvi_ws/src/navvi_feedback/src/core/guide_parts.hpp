#pragma once

#include <cstdint>
#include <navvi_types/stall_guard.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/auditory_display.hpp"
#include "core/guide_config.hpp"
#include "core/haptic_display.hpp"
#include "core/side_question.hpp"
#include "cues/cue_policy.hpp"
#include "cues/cue_queue.hpp"
#include "haptics/rumble_output.hpp"
#include "lead/course.hpp"
#include "lead/following.hpp"
#include "lessons/teacher.hpp"
#include "link/delay_line.hpp"
#include "menu/menu.hpp"
#include "senses/foresight.hpp"
#include "senses/senses.hpp"
#include "types.hpp"

namespace navvi_feedback::core {

/// All that decides on the person's side, in the order of a beat.
struct Guide::Parts {
  Parts(const GuideConfig::Values& config, cues::Phrases worded);

  template <typename Message>
  void take(const Message& message, double time) {
    senses.take(message, time);
  }
  void take(const TrialState& state, double time);
  void take(const Scenario& scenario, double time);

  [[nodiscard]] Output update(const Devices& devices, double time);
  [[nodiscard]] std::optional<Velocity> command(const Devices& devices, double dt,
                                                double time);
  /// All that the decisions of this beat are made from.
  [[nodiscard]] Observation observe(const Devices& devices, double dt, double time);
  [[nodiscard]] Lead leading(const Observation& now) const;
  void ask_side(Observation& now, double time, Output& out);
  /// Slows a command by the delay of the connection and by what leads.
  void limit(Velocity& command, const Observation& now) const;
  /// Carries out what lesson and menu make of the buttons. \return what is left to be answered
  cues::Asked obey(const Observation& now, double dt, Output& out);
  /// \return the words of a choice that the planner has agreed to now
  std::optional<cues::Utterance> heed_planner(const Observation& now, double dt);
  /// \param at  m, in map; nullopt: it is not known \return what is told of it
  cues::Utterance remember(const std::optional<Eigen::Vector2d>& at, Output& out);
  /// To where the person is led now.
  [[nodiscard]] AuditoryDisplay::Steering steering(const Observation& now, double dt);
  [[nodiscard]] std::optional<double> off_course(const Observation& now) const;
  /// \param pattern  that the rumble is part of
  void move_motors(std::optional<haptics::Pattern> pattern, const Devices& devices, double time,
                   Output& out);
  /// Sends words to the voice, and keeps what became of them.
  void say(const cues::CueQueue::Step& step, const Devices& devices, Output& out);

  /// A simulated connection, and what is under way on it.
  struct Wire {
    /// What the robot's side reports.
    struct Report {
      std::optional<Message> message;  ///< nullopt: its place
      std::optional<navvi_types::Pose2> robot;
    };
    struct Sent {
      Velocity command;
      double seen = 0.0;  ///< s, when the last of the reports that it answers was sent
    };

    explicit Wire(const link::LinkConfig& config)
        : down(config, 1, 1 + std::variant_size_v<Message>), up(config, 2, 0) {}

    link::DelayLine<Report> down;
    link::DelayLine<Sent> up;
    std::optional<navvi_types::Pose2> robot;
    std::optional<double> seen;
  };
  void receive(Devices& devices, double time);
  void send(Output& out, double time);

  /// A goal of the menu that the planner has not answered yet.
  struct Chosen {
    Eigen::Vector2d goal;     ///< m, in map
    cues::Utterance words;    ///< that say so
    std::uint32_t plans = 0;  ///< of the planner, before
    double left = 0.0;        ///< s, to wait for it
  };

  GuideConfig::Values config;
  navvi_types::StallGuard stall;
  std::optional<Wire> wire;
  senses::Senses senses;
  senses::Foresight foresight;
  drive::Drive drive;
  drive::Buttons buttons;
  HapticDisplay touch;
  AuditoryDisplay sounds;
  cues::Phrases phrases;
  cues::CuePolicy policy;
  cues::CueQueue queue;
  cues::HeardWords heard_words;
  SideQuestion side;
  menu::Menu menu;
  lessons::Teacher teacher;
  lead::Pilot pilot;
  lead::Following following;  ///< what sounds all the time
  haptics::RumbleOutput rumble_output, felt_output, flow_output;

  std::vector<Content> news;       ///< not said yet
  std::vector<cues::Cue> decided;  ///< at the last beat, to be spoken, most urgent first
  std::vector<CueEvent> words;     ///< what became of these and earlier ones, heard or not
  std::vector<std::string> begun;  ///< texts of a lesson that began to be heard since then
  std::optional<Chosen> chosen;
  std::optional<Eigen::Vector2d> shown;  ///< m, in map: a place to be remembered
  std::optional<double> last_update;
  drive::InputState last_hands;
  std::optional<std::uint32_t> important;  ///< the safety phrase that is being spoken
  Velocity commanded;
  double idle = 0.0;                ///< s, since the person last drove, or had reason to
  std::optional<cues::Cue> lesson;  ///< its last sentence, while one speaks
  std::optional<bool> feels;        ///< motors, at the last beat; nullopt: there were none yet
  bool held_unarmed = false;
  bool pushed_disabled = false;
  bool runs = false;               ///< a trial
  bool last_words = false;         ///< it has ended, which is told
  std::uint32_t rumbles = 0;       ///< so far, as are
  std::uint32_t sounds_begun = 0;
};

}  // namespace navvi_feedback::core
