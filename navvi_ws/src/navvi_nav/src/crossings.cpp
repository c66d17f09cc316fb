#include "navvi_nav/crossings.hpp"

#include <algorithm>
#include <utility>

namespace navvi_nav {

void Crossings::sort_out(std::size_t polygons) {
  first_.resize(polygons, -1);
  next_.resize(crossings_.size());
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    int& first = first_[static_cast<std::size_t>(crossings_[i].polygon)];
    next_[i] = std::exchange(first, static_cast<int>(i));
  }
}

const std::vector<Crossing>& Crossings::take(int polygon) {
  around_.clear();
  for (int i = std::exchange(first_[static_cast<std::size_t>(polygon)], -1); i >= 0;
       i = next_[static_cast<std::size_t>(i)])
    around_.push_back(crossings_[static_cast<std::size_t>(i)]);
  std::sort(around_.begin(), around_.end(), [](const Crossing& a, const Crossing& b) {
    return a.side != b.side ? a.side < b.side : a.along < b.along;
  });
  return around_;
}

}  // namespace navvi_nav
