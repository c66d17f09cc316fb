#pragma once

#include <optional>
#include <vector>

#include "navvi_nav/churn.hpp"
#include "navvi_nav/moving_thing.hpp"
#include "navvi_nav/stand_off.hpp"
#include "navvi_nav/status.hpp"

namespace navvi_nav {

struct CourseConfig {
  GuidanceConfig guidance;
  StandOffConfig stand_off;
  double off_path = 1.0;
  double robot_radius = 0.35;  ///< m, set from the mesh's

  void describe(navvi_config::Visitor& visit);
};

/// What a course is judged by.
struct Scene {
  double time = 0.0;          ///< s
  std::optional<Pose> robot;  ///< nullopt: not known
  double pace = 0.7;          ///< m/s, at which the robot follows when it does, > 0
  const Floor* floor = nullptr;
  const std::vector<MovingThing>& things;
  const std::vector<Cylinder>& obstacles;  ///< the same things

  [[nodiscard]] Space space() const { return {floor, &obstacles}; }
};

/// The path that is followed, what it is for, and whether what a search found replaces it.
class Course {
 public:
  explicit Course(const CourseConfig& config)
      : config_(config), guidance_(config.guidance), stand_off_(config.stand_off) {}

  /// Follows what a search found, or stays with the path that is followed if that still serves.
  /// \param plan  found, closed or aside
  void take(const Plan& plan, Reason reason, const Scene& scene, ReplanPolicy& policy);
  /// Hysteresis: a path that still serves stays, so that a person is not sent here and there. It
  /// serves, too, while only something far ahead closes the way, or something that moves on and
  /// would make the person turn back or go a long way round: that may have moved off by then.
  [[nodiscard]] bool keeps(const Plan& plan, Reason reason, const Scene& scene,
                           ReplanPolicy& policy);
  /// Goes along with the robot. \returns true if it has arrived at the goal
  [[nodiscard]] bool arrives(const Scene& scene);
  /// Sees what closes the only way, and whether it and the robot wait for each other.
  void watch(const Scene& scene, const ReplanPolicy& policy);
  /// Ground that the next search should leave free if there is no way to the goal; may be empty.
  [[nodiscard]] std::vector<Cylinder> ground_to_leave(const std::vector<MovingThing>& things);
  /// There is no path to follow.
  void drop() { guidance_.follow({}); }
  /// A new goal, or none.
  void forget();
  void reset_times();

  [[nodiscard]] bool following() const { return guidance_.following(); }
  [[nodiscard]] const Guidance& guidance() const { return guidance_; }
  /// True if only moving things close the path, and there is no other.
  [[nodiscard]] bool closed() const { return aim_ == Aim::closed || aim_ == Aim::waits; }
  /// Fills in what is known of the course. \pre following(), and the robot is known
  void tell(Status& status, const Scene& scene, const ReplanPolicy& policy) const;
  /// Fills in how restless it was, followed or not.
  void tell_unrest(Status& status, double time) const;

 private:
  /// What the path is.
  enum class Aim {
    goal,    ///< free, as far as is known
    closed,  ///< only moving things close it, and there is no other
    aside,   ///< away from the ground that a thing needs
    waits,   ///< as closed, while the robot waits aside
  };
  [[nodiscard]] bool is_aside(const Scene& scene) const;
  void change(const Plan& plan, Reason reason, const Scene& scene, ReplanPolicy& policy);

  CourseConfig config_;
  Guidance guidance_;
  Aim aim_ = Aim::goal;
  bool to_goal_ = true;  ///< and not aside
  StandOff stand_off_;
  std::optional<Way::Wait> blocker_;         ///< of the only way, if near
  std::optional<std::uint32_t> makes_room_;  ///< for which thing
  std::vector<Cylinder> ground_;             ///< that it needs, as of the last search
  unsigned reroutes_ = 0;
  Reason reroute_reason_ = Reason::none;
  double shortest_length_ = 0.0;
  double smoothing_price_ = 0.0;
  Churn churn_;
};

}  // namespace navvi_nav
