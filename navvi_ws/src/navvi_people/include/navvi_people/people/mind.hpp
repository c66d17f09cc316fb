#pragma once

#include <cstdint>
#include <navvi_types/random.hpp>
#include <optional>

#include "navvi_config/field.hpp"

namespace navvi_people::people {

using navvi_types::Random;

/// Of two turns told in quick succession the second may be lost, the more so by the quick.
struct MemoryConfig {
  bool faults = true;
  /// share of second turns that are lost, told at once after a first, at a stick of 0.8
  double lost = 0.1;
  static constexpr double kSpan = 3.0;  ///< s, after which a first turn is no longer in the way
};

class Memory {
 public:
  Memory(const MemoryConfig& config, std::uint64_t seed) : config_(config), random_(seed) {}
  /// A turn is told. \param speed  of the stick, liked, [0, 1] \return whether it is kept in mind
  [[nodiscard]] bool keeps(double speed, double time);

 private:
  MemoryConfig config_;
  Random random_;
  double told_ = -1e9;  ///< s
};

/// Distraction, and patience.
struct AttentionConfig {
  bool faults = true;
  double distractions = 0.2;   ///< 1/min, times that nothing is taken in
  double distracted = 1.5;     ///< s, each
  double patience = 12.0;      ///< s, of silence while driving before asking
  double idle_patience = 2.5;  ///< s, of silence while waiting before asking
  double gives_up = 240.0;     ///< s, of standing, and then gives up
};

class Attention {
 public:
  Attention(const AttentionConfig& config, std::uint64_t seed) : config_(config), random_(seed) {}
  /// \param moves  the hand drives
  void update(bool moves, double time, double dt);
  /// Takes nothing in.
  [[nodiscard]] bool elsewhere(double time) const { return time < elsewhere_until_; }
  [[nodiscard]] bool gave_up() const { return gave_up_; }

 private:
  AttentionConfig config_;
  Random random_;
  double elsewhere_until_ = -1e9;  ///< s
  std::optional<double> stands_;   ///< s, since when
  bool gave_up_ = false;
};

/// Practice makes quicker and more exact (the power law), and shows by what words deviate.
struct LearningConfig {
  bool on = true;
  int routes = 1;
  double rate = 0.15;  ///< exponent: reactions and errors are routes to the power of minus this
  /// of what words leave a turn short by, taken into the next
  static constexpr double kBiasRate = 0.2;

  void describe(navvi_config::Visitor& visit);
};

class Learning {
 public:
  explicit Learning(const LearningConfig& config) : config_(config) {}
  /// By which reactions and errors are multiplied.
  [[nodiscard]] double factor() const;
  /// A turn to an hour was made, clockwise rad, and then `rest` was still told.
  void turned(double angle, double rest);
  /// rad, to add to a turn of that sign
  [[nodiscard]] double bias() const { return bias_; }

 private:
  LearningConfig config_;
  double bias_ = 0.0;  ///< rad
};

}  // namespace navvi_people::people
