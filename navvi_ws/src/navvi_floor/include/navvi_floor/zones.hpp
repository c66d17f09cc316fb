#pragma once

#include <navvi_types/zone.hpp>
#include <string>
#include <vector>

#include "navvi_floor/geometry.hpp"
#include "navvi_floor/survey.hpp"

namespace navvi_floor {

/// A part of the floor with a rule of its own.
struct Zone {
  navvi_types::ZoneState::Kind kind = navvi_types::ZoneState::Kind::keep_out;
  std::string name;
  double speed = 0.0;          ///< m/s, the most in a slow zone; 0 in others
  std::vector<Point> corners;  ///< of a polygon

  [[nodiscard]] bool contains(Point point) const;
};

/// Where a robot may not drive, or only slowly, whatever its sensors see.
class Zones {
 public:
  Zones() = default;
  /// \param file  a YAML list of {name, kind: keep_out | slow | rack, corners: [x, y, x, y, ...] in
  /// m, in map, and speed, m/s, of a slow one; empty: there are none
  /// \throws navvi_config::ConfigError with file and line
  explicit Zones(const std::string& file);

  [[nodiscard]] bool empty() const { return zones_.empty(); }
  [[nodiscard]] const std::vector<Zone>& all() const { return zones_; }
  /// Makes obstacles of all cells that zones touch into which nobody may drive.
  void close(MapSurvey& survey) const;
  /// What is allowed to a robot there. Before a zone it is let drive so fast that it comes to rest
  /// with its hull at the border, or enters at the zone's speed; in one that it may not be in, it
  /// is let leave.
  /// \param yaw  rad \param radius  m, of the robot's hull
  [[nodiscard]] navvi_types::ZoneState at(Point robot, double yaw, double radius) const;

 private:
  std::vector<Zone> zones_;
};

}  // namespace navvi_floor
