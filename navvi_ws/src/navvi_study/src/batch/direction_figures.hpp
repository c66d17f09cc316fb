#pragma once

#include <Eigen/Core>
#include <navvi_people/loop/closed_loop.hpp>
#include <navvi_types/cue_event.hpp>
#include <optional>

#include "record/row.hpp"

namespace navvi_study::batch {

/// Judges whether the directions that are spoken agree with one another.
class DirectionFigures {
 public:
  /// A sentence begins. \param driven  m, so far
  void hear(const navvi_people::loop::ClosedLoop& loop, const navvi_types::CueEvent& cue,
            double driven);

  /// Adds `turns`, changes of the announced hour a minute over `duration` s; `flips`, how often a
  /// direction contradicted the one just before; `misled`, how often the turn that was ordered was
  /// not the one announced for that corner; `reversed`, how often a direction led 4 hours or more
  /// elsewhere than one within 4 s before, no corner and no new route being told.
  void add_to(record::Fields& row, double duration) const;

 private:
  /// A direction that was spoken, and where.
  struct Said {
    int hour = 12;
    double course = 0.0;  ///< rad, in map
    double time = 0.0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
  };

  void compare(const Said& now, bool corner, bool new_way);

  std::optional<Said> said_;
  std::optional<int> announced_;  ///< hour of the turn that comes
  double announced_until_ = 0.0;  ///< m driven, where its corner is passed
  unsigned turns_ = 0;
  unsigned flips_ = 0;
  unsigned misled_ = 0;
  unsigned reversed_ = 0;
};

}  // namespace navvi_study::batch
