#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <navvi_types/cue_event.hpp>
#include <navvi_types/guidance.hpp>
#include <navvi_types/motion.hpp>
#include <navvi_types/thing.hpp>

#include "record/track.hpp"

namespace navvi_study::trial {

/// The hands on the stick.
struct Hands {
  std::int64_t stamp = 0;  ///< ns, ROS time
  double forward = 0.0;    ///< [-1, 1]
  double left = 0.0;
  bool asks = false;  ///< for the direction again
};

/// Makes the track of what other nodes report. Each row has the last report of each kind that is
/// not stamped later, whenever it came, so that a bag gives the same track as the live session.
class Tracker {
 public:
  /// \param odometry  in odom
  void take_odometry(const navvi_types::Odometry& odometry) { odometry_.add(odometry); }
  /// \param place  odometry, in map
  void observe(const navvi_types::Odometry& place) { places_.add(place); }
  void observe(const navvi_types::Guidance& guidance);
  void observe(const navvi_types::Proximity& proximity);
  void observe(const navvi_types::CueEvent& cue);
  void observe(const Hands& hands) { hands_.add(hands); }
  template <typename Other>
  void observe(const Other&) {}

  /// Rows are wanted from this ns of ROS time on.
  void start(std::int64_t stamp) { start_ = stamp; }
  /// The next rows, up to that ns of ROS time. What they are made of is forgotten.
  [[nodiscard]] record::Track rows_until(std::int64_t stamp);

 private:
  /// Reports of one kind in the order of their stamps.
  template <typename Report>
  class Held {
   public:
    void add(const Report& report) {
      if (!reports_.empty() && went_back(reports_.back().stamp, report.stamp)) reports_.clear();
      if (reports_.empty() || report.stamp >= reports_.back().stamp) reports_.push_back(report);
    }
    /// The last one that is not later; those before it are forgotten.
    [[nodiscard]] const Report* at(std::int64_t stamp) {
      while (reports_.size() > 1 && reports_[1].stamp <= stamp) reports_.pop_front();
      return reports_.empty() || reports_.front().stamp > stamp ? nullptr : &reports_.front();
    }
    /// The first one if it is not later, and no more.
    [[nodiscard]] std::optional<Report> next(std::int64_t stamp) {
      if (reports_.empty() || reports_.front().stamp > stamp) return std::nullopt;
      Report report = reports_.front();
      reports_.pop_front();
      return report;
    }

   private:
    std::deque<Report> reports_;
  };
  struct Near {
    std::int64_t stamp = 0;
    double gap = 0.0;
    std::optional<navvi_types::ThingClass> nearest;
  };
  struct Way {
    std::int64_t stamp = 0;
    navvi_types::Guidance::State state = {};
    std::optional<navvi_types::ThingClass> blocked_by;
    std::optional<double> steer;  ///< rad, clockwise from the nose
  };
  struct Motors {
    std::int64_t stamp = 0;
    double left = 0.0;
    double right = 0.0;
  };
  struct Begun {
    std::int64_t stamp = 0;
    navvi_types::Modality modality = {};
    std::string word;
  };

  /// The simulator was started anew.
  [[nodiscard]] static bool went_back(std::int64_t before, std::int64_t now) {
    return now < before - 1'000'000'000;
  }
  void follow(const navvi_types::Odometry& place);
  [[nodiscard]] record::TrackRow row_at(const navvi_types::Odometry& place);

  Held<navvi_types::Odometry> odometry_;
  Held<navvi_types::Odometry> places_;
  Held<Near> near_;
  Held<Way> ways_;
  Held<Motors> motors_;
  Held<Begun> begun_;
  Held<Hands> hands_;
  std::int64_t start_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t way_stamp_ = 0;    ///< ns, of the guidance that the course is from
  std::optional<double> course_;  ///< rad, in map, to where to steer
  double yaw_ = 0.0;              ///< rad, of the last place
  std::int64_t last_ = std::numeric_limits<std::int64_t>::min();  ///< ns, of the last place
};

}  // namespace navvi_study::trial
