#include "trial/odometry_in_map.hpp"

#include <algorithm>

namespace navvi_study::trial {

std::vector<Odometry> OdometryInMap::take(const Odometry& odometry) {
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
  constexpr std::size_t kMostWaiting = 100;  // reports; then the last correction must do
  std::vector<Odometry> reports;
  while (!waiting_.empty()) {
    Odometry report = waiting_.front();
    auto correction =
        std::find_if(corrections_.begin(), corrections_.end(),
                     [&](const Correction& one) { return one.stamp >= report.stamp; });
    if (correction == corrections_.end() && !corrections_.empty()) {
      if (waiting_.size() <= kMostWaiting) break;
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
