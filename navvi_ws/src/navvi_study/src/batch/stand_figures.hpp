#pragma once

#include <Eigen/Core>
#include <navvi_people/loop/closed_loop.hpp>
#include <optional>
#include <string>

#include "record/row.hpp"

namespace navvi_study::batch {

/// Judges where a person stood longest, and whether it was told why the stick moved nothing.
class StandFigures {
 public:
  void begin(const Eigen::Vector2d& place) { stay_ = place; }
  /// Call it at each step. \param time  s since the goal was set \param about  what is about
  void watch(const navvi_people::loop::ClosedLoop& loop, double time, const std::string& about);
  /// A sentence or a sound begins.
  void hear() { pushed_.reset(); }

  /// How often a stick was pushed in vain for 3 s without a word or a sound.
  [[nodiscard]] unsigned speechless() const { return speechless_; }
  /// Adds `still` s, the longest stay within 0.3 m, since `still_at` s, and `why`: what was about
  /// at its end.
  void add_to(record::Fields& row) const;

 private:
  void push(const navvi_people::loop::ClosedLoop& loop);

  std::optional<double> pushed_;  ///< s, since when in vain and in silence
  unsigned speechless_ = 0;
  Eigen::Vector2d stay_ = Eigen::Vector2d::Zero();
  double stay_since_ = 0.0;
  double still_ = 0.0;
  double still_at_ = 0.0;
  std::string why_;
};

}  // namespace navvi_study::batch
