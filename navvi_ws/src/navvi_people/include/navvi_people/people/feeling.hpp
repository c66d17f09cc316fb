#pragma once

#include <cstdint>
#include <deque>
#include <navvi_types/random.hpp>
#include <optional>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_people/people/heard.hpp"

namespace navvi_people::people {

using navvi_types::Random;

/// The skin of the hand.
struct FeelingConfig {
  bool faults = true;
  bool motors = true;
  double threshold = 0.05;                ///< weaker motors are not felt
  double onset = 0.45;                    ///< s, from a motor to the hand, the median
  double reading = 1.0;                   ///< s, from the end of a pattern to the hand, the median
  double spread = 0.15;                   ///< standard deviation of their logarithms
  double recognised = 0.98;               ///< share of patterns
  static constexpr double kStrong = 0.6;  ///< motors above this on both sides slow the hand

  void describe(navvi_config::Visitor& visit);
};

/// What a row of pulses means, by their number, length, force and side.
enum class Meaning : std::uint8_t { none, ready, begun, new_way, arrived, stuck, halt, stop, hit };

/// Feels forces, late, and takes rows of pulses for what was taught. It gets the time course of two
/// motors and nothing else: a row of pulses has no name.
class Feeling {
 public:
  Feeling(const FeelingConfig& config, std::uint64_t seed) : config_(config), random_(seed) {}

  void feel(const Felt& felt, double time);
  /// Of it, what is strong enough to be felt at all.
  [[nodiscard]] Felt felt_of(const Felt& felt) const;
  /// What is felt of it now: forces from some time ago, and what a row of pulses has just meant.
  struct Now {
    Felt force;
    Meaning meaning = Meaning::none;
  };
  [[nodiscard]] Now update(double time);

 private:
  struct Pulse {
    double begins = 0.0, ends = 0.0;  ///< s
    Felt force;
  };
  struct Change {
    double time = 0.0;  ///< s, when it is felt
    Felt force;
  };
  void edge(const Felt& felt, double time);
  [[nodiscard]] Meaning meaning(const std::vector<Pulse>& row) const;

  FeelingConfig config_;
  Random random_;
  Felt now_, last_;
  std::deque<Change> coming_;
  std::optional<Pulse> pulse_;
  std::vector<Pulse> row_;
  std::deque<std::pair<double, Meaning>> meant_;  ///< s, when the hands follow
};

}  // namespace navvi_people::people
