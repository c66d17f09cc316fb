#pragma once

#include <cmath>
#include <limits>
#include <navvi_config/field.hpp>
#include <optional>
#include <vector>

#include "geometry.hpp"

namespace navvi_nav::guide {

struct ConflictForecastConfig {
  double robot_radius = 0.35;  ///< m, set from the mesh's
  /// m, how far an obstacle may reach into the path's room
  static constexpr double kTolerance = 0.05;
  double look_ahead = 12.0;
  /// s, a thing that leaves the path within this time, keeping its velocity, only crosses
  static constexpr double kForesight = 6.0;
  /// s, a thing that moved and has stood for less, or for less than it takes to get there, may
  /// drive on
  static constexpr double kPause = 5.0;
  /// s, an obstacle that will cut the path within this time counts as cutting it
  static constexpr double kNoticeTime = 1.0;
  static constexpr double kLateTime = 1.0;  ///< s, how late the robot may be against its pace
  /// m, least gap from a waiting robot to a thing that passes it
  static constexpr double kStopRoom = 0.1;
  /// m, least gap between a driving robot and an obstacle
  static constexpr double kElbowRoom = 0.2;

  void describe(navvi_config::Visitor& visit);
};

/// What blocks a path.
struct Blocker {
  std::uint32_t by = 0;                       ///< id of the obstacle
  double at = 0.0;                            ///< m, along the path to where
  std::optional<double> time_to_clear = 0.0;  ///< s, until it has left the path; nullopt: unknown
};

/// What obstacles will do to the robot on a path, by their velocities.
struct Conflict {
  enum class State {
    clear,       ///< nothing cuts the path
    crossing,    ///< all that cuts it crosses it or drives on ahead, and has left it soon
    oncoming,    ///< a moving or pausing obstacle keeps cutting it, such as one that comes along it
    stationary,  ///< a standing obstacle cuts it
  };
  State state = State::clear;
  double at = 0.0;               ///< m, along the path to the first cut; 0 if clear
  double time_to_meeting = 0.0;  ///< s, until robot and oncoming obstacle meet at the earliest
  /// s, time to collision if the robot keeps its pace (now or up to late_time late); infinite if
  /// none
  double time_to_collision = std::numeric_limits<double>::infinity();
  bool hits_waiting = false;  ///< a moving obstacle will hit the robot if it waits here
  /// The moving obstacle to wait for. Empty if waiting here would be hit sooner than driving on.
  std::optional<Blocker> wait_for;
  struct Cut {
    std::uint32_t by = 0;
    double at = 0.0;  ///< m, along the path
  };
  /// Where a robot on the first look_ahead m would first touch an obstacle as it stands now; one
  /// that it touches already is touched where the path leads nearer to it.
  std::optional<Cut> cut;
  /// True if a robot at the next way-point would touch an obstacle now, within look_ahead.
  bool waypoint_taken = false;

  /// True if an obstacle will hit the robot if it waits, but none if it drives on.
  [[nodiscard]] bool hits_only_waiting() const {
    return hits_waiting && !std::isfinite(time_to_collision);
  }
  /// True if neither driving on nor waiting is safe.
  [[nodiscard]] bool hits_either_way() const {
    return hits_waiting && std::isfinite(time_to_collision);
  }
};

/// Looks along a path that begins at the robot. Obstacles are taken to keep their velocity for
/// `foresight`, which for a few seconds is hard to beat (Schoeller, Aravantinos, Lay and Knoll,
/// "What the Constant Velocity Model Can Teach Us About Pedestrian Motion Prediction", 2020).
class ConflictForecast {
 public:
  explicit ConflictForecast(const ConflictForecastConfig& config) : config_(config) {}

  /// \param path  from the robot over the next way-point to the goal; may be empty
  /// \param pace  m/s, at which the robot follows, > 0
  [[nodiscard]] Conflict forecast(const Path& path, const std::vector<Cylinder>& obstacles,
                                  double pace) const;
  /// Where obstacles that come along the path, or hit a robot that waits here, will be until they
  /// meet the robot, as more cylinders of them: a new path must not lead there either.
  [[nodiscard]] std::vector<Cylinder> predicted(const Path& path,
                                                const std::vector<Cylinder>& obstacles,
                                                double pace) const;

 private:
  struct Encounter;
  struct Thing;
  [[nodiscard]] double room(const Cylinder& obstacle) const;
  [[nodiscard]] bool must_be_evaded(const Encounter& one) const;
  [[nodiscard]] std::optional<double> cut_at(const Path& path, Point center, double room) const;
  [[nodiscard]] std::optional<double> cut_at(const Path& path, const Thing& thing,
                                             double later) const;
  [[nodiscard]] bool taken(Point place, const std::vector<Cylinder>& obstacles) const;
  [[nodiscard]] Encounter encounter(const Path& path, const Thing& thing, double pace) const;
  [[nodiscard]] Encounter standing(const Thing& thing, double cut, double pace) const;

  ConflictForecastConfig config_;
};

}  // namespace navvi_nav::guide
