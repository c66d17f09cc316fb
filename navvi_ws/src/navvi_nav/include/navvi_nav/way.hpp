#pragma once

#include <limits>
#include <navvi_config/field.hpp>
#include <optional>
#include <vector>

#include "navvi_nav/geometry.hpp"

namespace navvi_nav {

struct WayConfig {
  double robot_radius = 0.35;  ///< m, set from the mesh's
  double tolerance = 0.05;
  double look_ahead = 12.0;
  double standing_speed = 0.2;
  double foresight = 6.0;
  double pause = 5.0;

  void describe(navvi_config::Visitor& visit);
};

/// How moving things leave a path, told by their velocities.
struct Way {
  enum class State {
    free,    ///< nothing cuts it
    clears,  ///< all that cuts it crosses it or goes on ahead, and has left it soon
    comes,  ///< something that moves, or only pauses, keeps cutting it, such as what comes along it
    stands,  ///< something that stands cuts it
  };
  State state = State::free;
  double at = 0.0;        ///< m, along the path to the first cut; 0 if free
  double meets_in = 0.0;  ///< s, until the robot and what comes meet at the earliest
  /// s, until who goes on at the pace, or a little later, runs into something; infinite: into none
  double hits_in = std::numeric_limits<double>::infinity();
  bool hits_waiting = false;  ///< something that moves runs into who waits here
  /// What moves and is run into by who goes on. None if something runs into who waits here sooner.
  struct Wait {
    std::uint32_t by = 0;
    double at = 0.0;         ///< m, along the path to where
    double clears_in = 0.0;  ///< s, until it has left the path; -1: nobody knows
  };
  std::optional<Wait> wait;
};

/// Looks along a path that begins at the robot. Things are taken to keep their velocity for
/// `foresight`, which for a few seconds is hard to beat (Schoeller, Aravantinos, Lay and Knoll,
/// "What the Constant Velocity Model Can Teach Us About Pedestrian Motion Prediction", 2020).
class WayAhead {
 public:
  explicit WayAhead(const WayConfig& config) : config_(config) {}

  /// \param pace  m/s, at which the robot follows, > 0
  [[nodiscard]] Way judge(const Path& path, const std::vector<Cylinder>& obstacles,
                          double pace) const;
  /// Where what comes along the path, or runs into who waits here, will be until it meets the
  /// robot, as more cylinders of it: a new path must not lead there either.
  [[nodiscard]] std::vector<Cylinder> foreseen(const Path& path,
                                               const std::vector<Cylinder>& obstacles,
                                               double pace) const;
  struct Cut {
    std::uint32_t by = 0;
    double at = 0.0;  ///< m, along the path
  };
  /// Where a robot on the first look_ahead m would first touch something as it stands now; what it
  /// touches already is touched where the path leads nearer to it.
  [[nodiscard]] std::optional<Cut> first_cut(const Path& path,
                                             const std::vector<Cylinder>& obstacles) const;
  /// True if a robot at `place` would touch a cylinder now.
  [[nodiscard]] bool taken(Point place, const std::vector<Cylinder>& obstacles) const;

 private:
  struct Meeting;
  struct Thing;
  [[nodiscard]] double room(const Cylinder& obstacle) const;
  [[nodiscard]] std::optional<double> cut_at(const Path& path, Point center, double room) const;
  [[nodiscard]] std::optional<double> cut_at(const Path& path, const Thing& thing,
                                             double later) const;
  [[nodiscard]] Meeting meet(const Path& path, const Thing& thing, double pace) const;

  WayConfig config_;
};

}  // namespace navvi_nav
