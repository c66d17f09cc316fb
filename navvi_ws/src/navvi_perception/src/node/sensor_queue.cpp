#include "node/sensor_queue.hpp"

#include <cmath>
#include <navvi_types/subscribe.hpp>
#include <utility>

namespace navvi_perception::node {

std::string SensorQueue::push(Waiting one) {
  constexpr double kAhead = 0.2;  // s, that a stamp may lie in the future
  const double age = (one.came - one.header.stamp).toSec();
  if (age < -kAhead)
    return "its stamp is " + std::to_string(-age) +
           " s ahead of this clock: keep all computers' clocks together";
  if (age > kOld)
    return "its stamp is " + std::to_string(age) +
           " s old: a delay on the way, or clocks that differ";
  one.header.frame_id = navvi_types::without_slash(one.header.frame_id);
  std::string why;
  if (waiting_.size() == kMost) {
    why = why_not_placed(waiting_.front().header);
    waiting_.pop_front();
  }
  waiting_.push_back(std::move(one));
  return why;
}

std::optional<SensorQueue::Next> SensorQueue::next(const ros::Time& now) {
  constexpr double kPatience = 0.2;   // s, that a scan waits for the place of its last ray
  constexpr double kRounding = 1e-3;  // s, of the stamps of transforms
  if (waiting_.empty()) return std::nullopt;
  const Waiting& first = waiting_.front();
  const double waited = std::abs((now - first.came).toSec());
  const bool placed = is_placed(first.header, 0.0);
  if (!placed && waited <= kOld) return std::nullopt;
  const bool whole = first.sweep == 0.0 || is_placed(first.header, first.sweep + kRounding);
  if (placed && !whole && waited < kPatience) return std::nullopt;
  Next out{first, whole, placed ? "" : why_not_placed(first.header)};
  waiting_.pop_front();
  return out;
}

bool SensorQueue::is_placed(const std_msgs::Header& header, double later) const {
  const ros::Time time = header.stamp + ros::Duration(later);
  return transforms_.canTransform(map_frame_, header.frame_id, time) &&
         transforms_.canTransform(map_frame_, base_frame_, time);
}

std::string SensorQueue::why_not_placed(const std_msgs::Header& header) const {
  std::string why;
  if (transforms_.canTransform(map_frame_, header.frame_id, header.stamp, &why))
    (void)transforms_.canTransform(map_frame_, base_frame_, header.stamp, &why);
  return "no transform leads from frame '" + header.frame_id + "' and from '" + base_frame_ +
         "' to '" + map_frame_ + "' in time: " + why;
}

}  // namespace navvi_perception::node
