#include "devices/latencies.hpp"

#include <algorithm>

namespace navvi_feedback::devices {

constexpr double kBin = 0.1;           // ms
constexpr std::size_t kBins = 10'001;  // the last for all that is longer

void Latencies::add(Chain chain, Clock::time_point cause) {
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - cause).count();
  const std::lock_guard lock(mutex_);
  Counts& counts = counts_.at(static_cast<std::size_t>(chain));
  counts.bins.resize(kBins);
  ++counts.bins[std::min(kBins - 1, static_cast<std::size_t>(std::max(0.0, ms) / kBin))];
  ++counts.count;
  counts.longest = std::max(counts.longest, ms);
}

void Latencies::clear() {
  const std::lock_guard lock(mutex_);
  counts_ = {};
}

Latencies::Figures Latencies::figures(Chain chain) const {
  const std::lock_guard lock(mutex_);
  const Counts& counts = counts_.at(static_cast<std::size_t>(chain));
  const auto quantile = [&](double share) {
    std::size_t bin = 0;
    for (double left = share * counts.count; bin < counts.bins.size(); ++bin)
      if ((left -= counts.bins[bin]) < 0.0) break;
    return std::min(kBin * static_cast<double>(bin + 1), counts.longest);
  };
  return {counts.count, quantile(0.5), quantile(0.99), counts.longest};
}

}  // namespace navvi_feedback::devices
