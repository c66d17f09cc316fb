#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace navvi_types {

/// SplitMix64 (Steele, Lea and Flood, 2014): the same numbers from the same seed with every
/// compiler and standard library, which std's distributions do not promise.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1.0p-53);
  }
  /// In [0, count); count > 0. The bias is below count / 2^64.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
  /// A generator with this seed continues this one.
  [[nodiscard]] std::uint64_t state() const { return state_; }
  /// Into an order drawn at random (Fisher and Yates, 1938).
  template <typename Item>
  void shuffle(std::vector<Item>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  /// Of mean 0 and standard deviation 1 (Box and Muller, 1958); two draws each.
  double normal() {
    constexpr double kTwoPi = 6.28318530717958647693;
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return radius * std::cos(uniform(0.0, kTwoPi));
  }
  /// \param sigma  standard deviation of its logarithm
  double lognormal(double median, double sigma) { return median * std::exp(sigma * normal()); }

 private:
  std::uint64_t state_;
};

}  // namespace navvi_types
