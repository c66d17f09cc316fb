#pragma once

#include <optional>
#include <vector>

#include "senses/observation.hpp"

namespace navvi_feedback::senses {

/// Keeps the latest message of each kind, and makes the observation of a tick of them. Times are s
/// of one clock that does not run backwards.
class Senses {
 public:
  /// \param stale  s; guidance, proximity or odometry older than this is lost
  explicit Senses(double stale) : stale_(stale) {}

  void take(const Proximity& proximity, double time) { nearby_ = {proximity.things, time}; }
  void take(const Guidance& guidance, double time);
  void take(const DriveState& state, double /*time*/);
  /// A trial_node that repeats its state, and then is silent while it records or holds the stick,
  /// does so no more.
  void take(const TrialState& state, double time);
  /// The last one holds, also where no other comes.
  void take(const LinkState& link, double time) { connection_ = {link, time}; }
  void take(const ZoneState& zone, double /*time*/) { zone_ = zone; }
  void take(const Odometry& odometry, double time) { motion_ = {odometry.velocity, time}; }
  void take(const Scenario& scenario, double /*time*/) { scenario_ = scenario; }
  void take(const Contact& contact, double /*time*/) { contacts_.push_back(contact); }

  /// \param devices  now
  /// \param dt  s, since the last observation
  /// \return all that messages and devices tell
  [[nodiscard]] Observation observe(const Devices& devices, double dt, double time);

  /// The latest, however old.
  [[nodiscard]] const std::optional<Guidance>& guidance() const { return guidance_.value; }
  [[nodiscard]] bool guidance_fresh(double time) const {
    return guidance_.link(time, stale_) == Link::alive;
  }
  /// s, by which guidance is ahead of the robot
  [[nodiscard]] double foresight() const {
    return connection_.value ? connection_.value->foresight : 0.0;
  }
  [[nodiscard]] const TrialState& trial() const { return trial_; }
  /// The stick is held, by a trial_node that lives.
  [[nodiscard]] bool holds(double time) const { return trial_.holds() && !record_lost(time); }

 private:
  /// The latest message of a kind, and when it came.
  template <typename T>
  struct Latest {
    std::optional<T> value;
    std::optional<double> time;

    [[nodiscard]] Link link(double now, double stale) const {
      if (!time) return Link::never;
      return now - *time <= stale ? Link::alive : Link::lost;
    }
  };

  [[nodiscard]] Links links(const Devices& devices, double time) const;
  [[nodiscard]] bool record_lost(double time) const;
  void locate(Observation& now) const;

  double stale_;
  Latest<std::vector<NearThing>> nearby_;
  Latest<Guidance> guidance_;
  Latest<Velocity> motion_;
  Latest<LinkState> connection_;
  ZoneState zone_;
  double turned_ = 0.0;  ///< rad, counter-clockwise, since that guidance
  std::optional<DriveState::State> gate_;
  DriveState::Assistance assistance_ = DriveState::Assistance::nothing;
  bool intruder_ = false;        ///< that gate ignores another node's commands
  bool emergency_stop_ = false;  ///< that gate knows of one
  TrialState trial_;
  std::optional<double> trial_time_;  ///< when it came
  bool trial_repeats_ = false;        ///< the same state has come again
  std::optional<Scenario> scenario_;
  bool slow_ = false;              ///< the connection
  std::vector<Contact> contacts_;  ///< since the last observation
  bool seen_hands_ = false;        ///< there were live ones
};

}  // namespace navvi_feedback::senses
