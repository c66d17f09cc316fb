#pragma once

#include <deque>
#include <utility>

#include "geometry.hpp"

namespace navvi_nav::guide {

/// How unstable the guide path is: metres of the path ahead that plans moved, per minute.
class PathInstability {
 public:
  /// m of the first 20 m of `old` from which `fresh` is more than half a metre away: the
  /// part of the route that a person has to unlearn.
  [[nodiscard]] static double moved(const Path& old, const Path& fresh);

  void add(double time, double metres);
  void reset() { moves_.clear(); }
  /// m/min, over the 60 s before `time`.
  [[nodiscard]] double per_minute(double time) const;

 private:
  std::deque<std::pair<double, double>> moves_;  // s, m
};

}  // namespace navvi_nav::guide
