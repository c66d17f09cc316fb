#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

namespace navvi_feedback {

/// What a thing is to the person who drives (R-SIM-4).
enum class ThingClass { shelf, wall, box, pedestal, worker, forklift, pallet_robot, other };

/// Lower-case name as in the messages: "shelf", "pallet_robot", ...
[[nodiscard]] const char* to_string(ThingClass thing_class);
/// nullopt for a word that is no class.
[[nodiscard]] std::optional<ThingClass> thing_class_from(const std::string& word);

/// One thing near the robot, as navvi_msgs/ProximityThing. Every number is finite.
struct Nearby {
  ThingClass thing_class = ThingClass::other;
  std::uint32_t id = 0;
  double gap = 0.0;                                   ///< m, hull to surface; <= 0 when touching
  Eigen::Vector2d nearest = Eigen::Vector2d::Zero();  ///< m, of its surface, in base_link
  bool moving = false;
};

/// The quarter round the robot, each 90 degrees wide and centred on its axis.
enum class Side { ahead, left, behind, right };

/// \param point  m, in base_link (x forward, y left). The robot's own centre counts as ahead.
[[nodiscard]] Side side_of(const Eigen::Vector2d& point);

}  // namespace navvi_feedback
