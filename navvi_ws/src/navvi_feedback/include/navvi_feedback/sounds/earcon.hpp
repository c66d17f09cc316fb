#pragma once

#include <Eigen/Core>
#include <array>
#include <navvi_types/names.hpp>

namespace navvi_feedback::sounds {

/// Short sounds, each recognisably its own.
enum class Earcon {
  turn,       ///< the heading is off, to that side; the faster, the less
  turn_stop,  ///< no further
  on_course,  ///< straight on
  hit_shelf,  ///< or a wall
  hit_obstacle,
  shelf_near,  ///< or a wall
  shelf_close,
  worker_near,
  worker_close,
  forklift_near,
  forklift_close,
  pallet_robot_near,
  pallet_robot_close,
  thing_near,  ///< anything else
  thing_close,
  arrived,
  beacon,      ///< from the next way-point; the faster, the nearer
  sonar,       ///< from the nearest thing; likewise
  turn_click,  ///< as turn, while words are spoken: short, and above them
};
/// As recorded.
[[nodiscard]] constexpr std::array<const char*, 19> names(Earcon) {
  return {"turn",
          "turn_stop",
          "on_course",
          "hit_shelf",
          "hit_obstacle",
          "shelf_near",
          "shelf_close",
          "worker_near",
          "worker_close",
          "forklift_near",
          "forklift_close",
          "pallet_robot_near",
          "pallet_robot_close",
          "thing_near",
          "thing_close",
          "arrived",
          "beacon",
          "sonar",
          "turn_click"};
}

/// One short sound, to be played now.
struct Play {
  Earcon earcon = Earcon::turn;
  Eigen::Vector2d from = Eigen::Vector2d::UnitX();  ///< m, in base_link: where it comes from
  double volume = 1.0;                              ///< [0, 1]
};

}  // namespace navvi_feedback::sounds
