#include "drive/stick_age.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace navvi_feedback::drive {

void StickAge::add(double age, double time) {
  constexpr double kMedianOf = 5.0;  // s
  ages_.emplace_back(time, age);
  while (time - ages_.front().first > kMedianOf) ages_.pop_front();
}

StickAge::Late StickAge::late(double time) const {
  constexpr double kSlow = 0.3;     // s
  constexpr double kTooLate = 1.0;  // s
  constexpr double kSilent = 0.25;  // s, as a stick is lost that is silent for so long
  if (ages_.empty() || time - ages_.back().first > kSilent) return Late::no;
  const double age = ages_.back().second;
  if (!(std::abs(age) <= kTooLate)) return Late::too_late;
  return age > kSlow ? Late::slow : Late::no;
}

double StickAge::median() const {
  if (ages_.empty()) return 0.0;
  std::vector<double> ages;
  for (const auto& [time, age] : ages_) ages.push_back(age);
  const auto middle = ages.begin() + static_cast<std::ptrdiff_t>(ages.size() / 2);
  std::nth_element(ages.begin(), middle, ages.end());
  return *middle;
}

}  // namespace navvi_feedback::drive
