#include "node/beat.hpp"

#include <algorithm>

namespace navvi_feedback::node {

bool Beat::becomes_late(double time) {
  const double between = last_ < 0.0 ? 0.0 : time - last_;
  last_ = time;
  longest_ = std::max(longest_, between);
  if (between >= late_) late_beats_.push_back(time);
  while (!late_beats_.empty() && time - late_beats_.front() > kWindow) late_beats_.pop_front();
  if (told_ || late_beats_.size() < kMany) return false;
  told_ = true;
  return true;
}

}  // namespace navvi_feedback::node
