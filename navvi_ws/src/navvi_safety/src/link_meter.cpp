#include "navvi_safety/link_meter.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace navvi_safety {

constexpr double kWindow = 5.0;   // s
constexpr double kSlow = 0.3;     // s later than usual
constexpr double kTooLate = 1.0;  // s, likewise

void LinkMeter::add(double age, std::uint32_t seq, double time) {
  late_ = lateness(age);
  // The person's side was started anew.
  if (!arrivals_.empty() && seq <= arrivals_.back().seq) arrivals_.clear();
  arrivals_.push_back({time, std::max(0.0, age), seq});
  while (time - arrivals_.front().time > kWindow) arrivals_.pop_front();
}

LinkMeter::Late LinkMeter::lateness(double age) const {
  if (arrivals_.empty()) return Late::no;
  const double later = age - percentile(0.5);
  return later > kTooLate ? Late::too_late : later > kSlow ? Late::slow : Late::no;
}

navvi_types::LinkState LinkMeter::state(std::int64_t stamp) const {
  navvi_types::LinkState state;
  state.late = late_;
  state.stamp = stamp;
  if (arrivals_.empty()) return state;
  state.round_trip = percentile(0.5);
  state.round_trip_99 = percentile(0.99);
  for (std::size_t i = 1; i < arrivals_.size(); ++i)
    state.jitter += std::abs(arrivals_[i].age - arrivals_[i - 1].age);
  if (arrivals_.size() > 1) state.jitter /= static_cast<double>(arrivals_.size() - 1);
  const double sent = arrivals_.back().seq - arrivals_.front().seq + 1.0;
  state.loss = 1.0 - static_cast<double>(arrivals_.size()) / sent;
  return state;
}

double LinkMeter::percentile(double share) const {
  std::vector<double> ages;
  for (const Arrival& arrival : arrivals_) ages.push_back(arrival.age);
  const auto at = ages.begin() + static_cast<std::ptrdiff_t>(
                                     share * static_cast<double>(ages.size() - 1));
  std::nth_element(ages.begin(), at, ages.end());
  return *at;
}

}  // namespace navvi_safety
