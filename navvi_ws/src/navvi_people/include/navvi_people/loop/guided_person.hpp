#pragma once

#include <geometry_msgs/Transform.h>
#include <navvi_msgs/Cue.h>

#include <memory>
#include <navvi_feedback/core/guide.hpp>
#include <optional>
#include <string>
#include <vector>

#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::loop {

/// What guides say and persons understand, read once for any number of trials.
struct Spoken {
  std::string file;
  std::shared_ptr<const navvi_feedback::cues::Phrases> phrases;
  people::Listener listener;

  /// \param phrases  file of the spoken phrases \throws ConfigError
  explicit Spoken(const std::string& phrases);
};

/// A guide, and the person that it guides: what the one plays the other hears and feels.
class GuidedPerson {
 public:
  /// \param speech  false: nothing is spoken
  /// \throws ConfigError
  /// \param occasion  as of `SimulatedOperator`
  GuidedPerson(const navvi_feedback::core::GuideConfig& guide,
               const people::SimulatedOperatorConfig& person, int occasion, bool speech,
               const Spoken& spoken);

  void take(const navvi_feedback::core::Guide::Message& message, double time) {
    guide_.take(message, time);
  }

  /// What is played at one instant.
  struct Played {
    std::vector<navvi_msgs::Cue> cues;
    people::Felt motors;
    bool motors_due = false;  ///< they are felt from now on
  };
  struct Command {
    navvi_types::Velocity velocity;
    double lag = 0.0;  ///< s, of a simulated connection: the age of what it answers
  };
  /// \param hand  on the stick \param robot  base_link in map \return nullopt: nothing is sent
  std::optional<Command> feed_back(const people::StickAndButtons& hand,
                                   const geometry_msgs::Transform& robot, double time);
  [[nodiscard]] const Played& played() const { return played_; }

  /// The person hears and feels what was played. \return the stick
  [[nodiscard]] people::StickAndButtons act(double time, double dt);

  [[nodiscard]] const people::SimulatedOperator& person() const { return person_; }

 private:
  navvi_feedback::core::Guide guide_;
  people::SimulatedOperator person_;
  bool speech_;
  bool heard_;                 ///< there is something to hear
  double speaks_until_ = 0.0;  ///< s
  Played played_;
};

}  // namespace navvi_people::loop
