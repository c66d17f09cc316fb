#pragma once

#include <geometry_msgs/Transform.h>
#include <nav_msgs/Odometry.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Cue.h>
#include <navvi_msgs/DriveState.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/LinkState.h>
#include <navvi_msgs/Obstacles.h>
#include <navvi_msgs/Proximity.h>

#include <navvi_feedback/core/guide.hpp>
#include <navvi_files/cache.hpp>
#include <navvi_nav/lockstep/navigation.hpp>
#include <navvi_sim/live/session.hpp>
#include <navvi_sim/setup/course.hpp>
#include <optional>
#include <string>
#include <vector>

#include "navvi_people/loop/guided_person.hpp"
#include "navvi_people/loop/robot_senses.hpp"
#include "navvi_people/people/sighted_driver.hpp"
#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::loop {

/// The parameters of all nodes of a session with a simulated operator, each under its part's name.
struct ClosedLoopConfig {
  navvi_sim::setup::SimNodeConfig sim;
  navvi_nav::lockstep::NavigationConfig nav;
  navvi_feedback::core::GuideConfig feedback;
  people::SimulatedOperatorConfig person;
  navvi_perception::see::PerceptionConfig
      perception;  ///< used where sim's sensing is not the truth
  bool speech = true;
  std::string driver = "person";  ///< person or sighted

  /// As in live.launch: the simulated robot climbs neither steps nor ramps.
  ClosedLoopConfig();
  void describe(navvi_config::Visitor& visit);
};

/// A whole session, without ROS and without a clock: world -> navigation -> cues -> operator ->
/// stick -> wheels -> world. The parts are those that the nodes use, at the nodes' rates, and what
/// they tell each other are the nodes' messages. What differs: no message is late or lost but by
/// feedback/link, the simulator's map comes as the voxels that its message would show, a plan is
/// there at the next beat of navigation (50 ms), and a sentence takes as long as it is written (the
/// figures are in the .cpp). The same config gives the same session, bit for bit.
class ClosedLoop {
 public:
  /// What was told in one step, in the order of the loop. Contacts, proximity and obstacles are
  /// true; guidance and feedback get these or, by sim's parameter sensing, what the robot's sensors
  /// tell.
  struct Messages {
    nav_msgs::Odometry odometry;
    navvi_msgs::DriveState drive;
    std::optional<navvi_msgs::LinkState> link;
    std::vector<navvi_msgs::Contact> contacts;
    std::optional<navvi_msgs::Proximity> proximity;
    std::optional<navvi_msgs::Obstacles> obstacles;
    std::optional<navvi_msgs::Guidance> guidance;
    std::vector<navvi_msgs::Cue> cues;
    people::Felt motors;                ///< as they are
  };

  /// \param cache  of what is made of a world before anything moves, which must last as long;
  /// nullptr: nothing is kept
  /// \throws WorldError or ConfigError with a sentence
  ClosedLoop(const ClosedLoopConfig& config, const Spoken& spoken,
             const navvi_files::Cache* cache = nullptr);

  /// One step of the world, and whatever is due after it. \return false if the world has stopped
  /// because a number in it is not finite
  /// \throws std::runtime_error with a sentence if navigation rejects the map
  [[nodiscard]] bool step();

  /// s since the world began
  [[nodiscard]] double time() const { return session_.world().now().time; }
  /// s, the length of a step
  [[nodiscard]] double dt() const { return config_.sim.life.step; }
  /// True once navigation has been given the goal.
  [[nodiscard]] bool begun() const { return begun_; }
  [[nodiscard]] const ClosedLoopConfig& config() const { return config_; }
  [[nodiscard]] const navvi_sim::WorldDescription& world() const { return setting_.world; }
  [[nodiscard]] const navvi_sim::scenario::StartAndGoal& scenario() const {
    return setting_.course.ends;
  }
  [[nodiscard]] const navvi_sim::live::Session& session() const { return session_; }
  [[nodiscard]] const Messages& told() const { return published_; }
  [[nodiscard]] const people::SimulatedOperator& person() const { return guided_.person(); }
  [[nodiscard]] const people::StickAndButtons& hand() const { return hand_; }
  /// nullptr where the truth is told.
  [[nodiscard]] const RobotSenses* senses() const {
    return setting_.senses ? &*setting_.senses : nullptr;
  }
  /// What the sensors told in this step of what moves.
  [[nodiscard]] const std::optional<navvi_types::Obstacles>& perceived() const {
    return perceived_;
  }

 private:
  /// What is there before anything moves.
  struct Setting {
    navvi_sim::WorldDescription world;
    navvi_sim::setup::Course course;
    std::optional<RobotSenses> senses = {};  ///< where the truth is not told

    Setting(const ClosedLoopConfig& config, const navvi_files::Cache* cache);
  };

  [[nodiscard]] bool turn_wheels();
  void sense();
  void sense_by_robot();
  void sense_near(const navvi_types::Proximity& proximity);
  void navigate();
  void require_map() const;
  void feed_back();
  void operate();
  [[nodiscard]] navvi_safety::Instant instant() const { return {time(), time()}; }
  [[nodiscard]] ros::Time stamp() const { return ros::Time(time()); }
  /// base_link in map
  [[nodiscard]] geometry_msgs::Transform pose() const;

  ClosedLoopConfig config_;
  Setting setting_;
  navvi_sim::live::Session session_;
  navvi_safety::CommandGate gate_;
  navvi_nav::lockstep::Navigation navigation_;
  GuidedPerson guided_;
  std::optional<people::SightedDriver> sighted_;  ///< at the stick in the person's place
  people::Sight sight_;                           ///< as it was told last
  people::StickAndButtons hand_;
  std::uint32_t commands_ = 0;  ///< so far
  bool begun_ = false;
  Messages published_;
  std::optional<navvi_types::Obstacles> perceived_;
};

}  // namespace navvi_people::loop
