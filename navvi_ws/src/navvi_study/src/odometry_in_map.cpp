#include "navvi_study/odometry_in_map.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_study {
namespace {

constexpr std::size_t kMostWaiting = 100;      // reports; then the last correction must do
constexpr std::size_t kMostCorrections = 200;  // kept

}  // namespace

std::vector<OdometryReport> OdometryInMap::take(const OdometryReport& odometry) {
  waiting_.push_back(odometry);
  return release();
}

std::vector<OdometryReport> OdometryInMap::take(const Correction& correction) {
  if (!corrections_.empty() && correction.stamp < corrections_.back().stamp) corrections_.clear();
  corrections_.push_back(correction);
  if (corrections_.size() > kMostCorrections) corrections_.pop_front();
  return release();
}

std::vector<OdometryReport> OdometryInMap::release() {
  std::vector<OdometryReport> reports;
  while (!waiting_.empty()) {
    OdometryReport report = waiting_.front();
    auto correction =
        std::find_if(corrections_.begin(), corrections_.end(),
                     [&](const Correction& one) { return one.stamp >= report.stamp; });
    if (correction == corrections_.end() && !corrections_.empty()) {
      if (waiting_.size() <= kMostWaiting) break;
      --correction;
    }
    if (correction != corrections_.end()) {
      const double c = std::cos(correction->yaw), s = std::sin(correction->yaw);
      const Point2 at = report.position;
      report.position = {correction->origin.x + c * at.x - s * at.y,
                         correction->origin.y + s * at.x + c * at.y};
    }
    reports.push_back(report);
    waiting_.pop_front();
  }
  return reports;
}

}  // namespace navvi_study
