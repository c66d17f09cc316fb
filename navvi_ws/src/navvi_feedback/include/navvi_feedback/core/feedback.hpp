#pragma once

#include <optional>
#include <string>
#include <vector>

#include "navvi_feedback/cues/cue_policy.hpp"
#include "navvi_feedback/drive/drive.hpp"
#include "navvi_feedback/drive/input_state.hpp"
#include "navvi_feedback/haptics/haptics.hpp"

namespace navvi_feedback {
using navvi_types::Odometry;
using navvi_types::Proximity;
}  // namespace navvi_feedback

namespace navvi_feedback::core {

struct FeedbackConfig {
  double stale = 1.0;  ///< s
  drive::DriveConfig drive;
  haptics::HapticsConfig haptics;
  cues::CuePolicyConfig cues;

  void describe(navvi_config::Visitor& visit);
};

/// What feedback_node decides, and nothing of how it is sent: what the stick asks of the wheels,
/// what the motors do, and what is said. Times are s of one clock that does not run backwards.
class Feedback {
 public:
  /// The hands, and what the devices tell of themselves.
  struct Input {
    drive::InputState hands;
    cues::Link audio = cues::Link::alive;
    bool motors = true;                ///< false where our own pad is not connected
    bool voice_busy = false;           ///< something is being spoken or waits for it
    std::optional<double> goal_angle;  ///< rad, clockwise from the nose to the goal, if known
    std::vector<std::string> notices;  ///< as Situation::notices
  };
  struct Output {
    std::optional<Velocity> command;  ///< nullopt: nothing is to be sent
    haptics::Rumble rumble;
    bool alarm_begins = false;    ///< from now on the motors say that nothing can be heard
    std::vector<cues::Cue> cues;  ///< decided now, most urgent first
  };

  /// \throws navvi_config::ConfigError as Haptics does
  Feedback(const FeedbackConfig& config, cues::Phrases phrases);

  void take(const Proximity& proximity, double time) { nearby_ = {proximity.things, time}; }
  void take(const Guidance& guidance, double time) { guidance_ = {guidance, time}; }
  void take(const DriveState& state, double /*time*/) { gate_ = state.state; }
  void take(const Odometry& odometry, double time) { motion_ = {odometry.velocity, time}; }
  void take(const Contact& contact) { contacts_.push_back(contact); }

  /// Call it at 50 Hz.
  [[nodiscard]] Output update(const Input& input, double time);
  /// As CuePolicy::note().
  void note(const std::vector<CueEvent>& events) { policy_.note(events); }

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

    [[nodiscard]] cues::Link link(double at, double stale) const {
      return cues::link_state(time, at, stale);
    }
  };

  [[nodiscard]] std::optional<Velocity> drive(const drive::InputState& hands, double dt);
  [[nodiscard]] haptics::Rumble feel(double time, double dt);
  [[nodiscard]] bool alarm_begins(const Input& input, double time);
  [[nodiscard]] cues::Situation situation(const Input& input, double time) const;
  [[nodiscard]] cues::Link pad_link(const drive::InputState& hands) const;

  FeedbackConfig config_;
  drive::Drive drive_;
  haptics::Haptics haptics_;
  cues::CuePolicy policy_;

  Latest<std::vector<NearThing>> nearby_;
  Latest<Guidance> guidance_;
  std::optional<DriveState::State> gate_;
  Latest<Velocity> motion_;
  std::vector<Contact> contacts_;  ///< since the last update

  std::optional<double> last_update_;
  drive::InputState last_hands_;
  bool seen_hands_ = false;
  std::optional<double> alarm_since_;  ///< s, while nothing can be heard
  Velocity commanded_;
  bool held_unarmed_ = false;
};

}  // namespace navvi_feedback::core
