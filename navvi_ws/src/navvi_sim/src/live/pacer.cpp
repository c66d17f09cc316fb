#include "live/pacer.hpp"

#include <cmath>

namespace navvi_sim::live {

int Pacer::due(double wall) {
  if (!started_ || wall < origin_) {
    started_ = true;
    origin_ = wall;
    steps_ = 0;
    return 0;
  }
  const long target = static_cast<long>(std::floor((wall - origin_) / wall_step_ + 1e-9));
  const long missing = target - steps_;
  steps_ = target;
  if (missing <= max_steps_) return static_cast<int>(missing);
  dropped_ += missing - max_steps_;
  return max_steps_;
}

}  // namespace navvi_sim::live
