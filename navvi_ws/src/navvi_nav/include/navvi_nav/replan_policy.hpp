#pragma once

#include <navvi_config/field.hpp>
#include <optional>
#include <set>
#include <vector>

#include "navvi_nav/guidance_enums.hpp"
#include "navvi_nav/hold.hpp"
#include "navvi_nav/interest.hpp"
#include "navvi_nav/way.hpp"

namespace navvi_nav {

struct ReplanPolicyConfig {
  double period = 2.0;
  double slow_speed = 0.1;
  double slow_time = 1.0;
  double near_range = 3.0;
  double min_interval = 0.5;
  bool only_if_it_matters = true;
  double stray = 0.5;
  double gain = 0.1;
  double gain_length = 0.5;
  double gain_back = 4.0;
  WayConfig way;
  HoldConfig hold;

  void describe(navvi_config::Visitor& visit);
};

/// What the policy looks at.
struct ReplanInput {
  double time = 0.0;  ///< s
  bool has_goal = false;
  bool new_goal = false;     ///< not planned for yet
  bool map_changed = false;  ///< since the last plan
  double speed = 0.0;        ///< m/s, forward
  double pace = 0.7;         ///< m/s, at which the robot follows when it does, > 0
  Pose robot;
  Path remaining;            ///< from the robot over the next way-point to the goal; may be empty
  double path_offset = 0.0;  ///< m, from the robot to its path
  bool closed = false;       ///< the path is known to be cut and there was no other
  std::vector<Cylinder> obstacles;
};

/// Says when to plan again, and why (R-NAV-9).
class ReplanPolicy {
 public:
  explicit ReplanPolicy(const ReplanPolicyConfig& config)
      : config_(config), ahead_(config.way), hold_(config.hold) {}

  /// The most telling reason to plan now, or none. A reason that is returned counts as acted on.
  [[nodiscard]] std::optional<Reason> update(const ReplanInput& input);
  /// Forgets all times, after the clock jumped.
  void reset();
  /// False if the path that is being followed should stay: the new one is not shorter by enough.
  [[nodiscard]] bool worth_changing(Reason reason, const Path& followed, const Path& fresh) const;
  /// True if the path that is followed should stay although moving things cut it: see Hold::keeps.
  [[nodiscard]] bool holds(double time, const Path& followed, const Path& fresh,
                           const std::vector<Cylinder>& obstacles, double pace);
  /// True if a robot on some point of the first `look_ahead` m would touch a cylinder.
  [[nodiscard]] bool blocked(const Path& path, const std::vector<Cylinder>& obstacles) const {
    return ahead_.first_cut(path, obstacles).has_value();
  }
  /// What closes `path`, where there is no other, if that is near or comes along it; clears_in is
  /// -1: nobody knows.
  [[nodiscard]] std::optional<Way::Wait> closed_by(const Path& path,
                                                   const std::vector<Cylinder>& obstacles) const;
  /// The path that is followed from now on was chosen because of what moves.
  void chose(double time) { hold_.chose(time); }
  /// What crosses right before the robot and is waited for. As of the last update.
  [[nodiscard]] std::optional<Way::Wait> waits_for() const { return wait_; }
  /// True if something moves into who waits here, and into nobody who goes on. As of the last
  /// update.
  [[nodiscard]] bool chases() const { return way_.hits_waiting && !std::isfinite(way_.hits_in); }
  /// See WayAhead::foreseen; none where nothing is held.
  [[nodiscard]] std::vector<Cylinder> foreseen(const Path& path,
                                               const std::vector<Cylinder>& obstacles,
                                               double pace) const;

 private:
  [[nodiscard]] std::optional<Reason> choose(const ReplanInput& input, bool slow, bool waits);
  [[nodiscard]] bool note_near(const ReplanInput& input);
  [[nodiscard]] bool matters(const ReplanInput& input) const;
  [[nodiscard]] double worthwhile(double followed) const {
    return followed * (1.0 - config_.gain) - config_.gain_length;
  }

  ReplanPolicyConfig config_;
  WayAhead ahead_;
  Hold hold_;
  Interest interest_;
  Way way_;
  std::optional<Way::Wait> wait_;
  double wait_time_ = 0.0;  // s, when it was last seen
  std::optional<double> last_plan_;
  std::optional<double> last_slow_;
  std::optional<double> slow_since_;
  std::set<std::uint32_t> near_;
  bool near_pending_ = false;
};

}  // namespace navvi_nav
