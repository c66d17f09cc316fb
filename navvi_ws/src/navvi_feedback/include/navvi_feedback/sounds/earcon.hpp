#pragma once

#include <Eigen/Core>
#include <navvi_types/signal.hpp>

namespace navvi_feedback::sounds {

using navvi_types::Earcon;

/// One short sound, to be played now.
struct Play {
  Earcon earcon = Earcon::turn;
  Eigen::Vector2d from = Eigen::Vector2d::UnitX();  ///< m, in base_link: where it comes from
  double volume = 1.0;                              ///< [0, 1]
};

}  // namespace navvi_feedback::sounds
