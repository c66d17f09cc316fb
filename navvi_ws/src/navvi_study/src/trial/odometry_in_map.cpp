#include "trial/odometry_in_map.hpp"

#include <algorithm>

namespace navvi_study::trial {

std::vector<Odometry> OdometryInMap::take(const Odometry& odometry) {
  if (!waiting_.empty() && odometry.stamp < waiting_.back().stamp) waiting_.clear();
  waiting_.push_back(odometry);
  return release();
}

std::vector<Odometry> OdometryInMap::take(const Correction& correction) {
  constexpr std::size_t kMostCorrections = 200;  // kept
  if (!corrections_.empty() && correction.stamp < corrections_.back().stamp) corrections_.clear();
  corrections_.push_back(correction);
  if (corrections_.size() > kMostCorrections) corrections_.pop_front();
  return release();
}

std::vector<Odometry> OdometryInMap::release() {
  // Then the last correction must do, as where a localizer tells one in seconds.
  constexpr std::size_t kMostWaiting = 100;
  constexpr std::int64_t kLongestWait = 200'000'000;  // ns
  std::vector<Odometry> reports;
  while (!waiting_.empty()) {
    Odometry report = waiting_.front();
    auto correction =
        std::find_if(corrections_.begin(), corrections_.end(),
                     [&](const Correction& one) { return one.stamp >= report.stamp; });
    if (correction == corrections_.end() && !corrections_.empty()) {
      if (waiting_.size() <= kMostWaiting && waiting_.back().stamp - report.stamp < kLongestWait)
        break;
      --correction;
    }
    if (correction != corrections_.end()) {
      report.pose.position = correction->odom.to_parent(report.pose.position);
      report.pose.yaw += correction->odom.yaw;
    }
    reports.push_back(report);
    waiting_.pop_front();
  }
  return reports;
}

}  // namespace navvi_study::trial
