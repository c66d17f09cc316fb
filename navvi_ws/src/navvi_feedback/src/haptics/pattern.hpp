#pragma once

#include <navvi_types/signal.hpp>
#include <optional>

#include "haptics/haptics.hpp"

namespace navvi_feedback::haptics {

using navvi_types::Pattern;

/// Plays one pattern at a time, instead of what is felt continuously, so that it stands out.
class PatternPlayer {
 public:
  /// Begins at once, unless a more urgent one plays.
  /// \param side  the motors that take part
  /// \param taps  of an answer
  void begin(Pattern pattern, Zone side = Zone::center, int taps = 0);
  void stop() { playing_.reset(); }

  /// \param dt  s since the last call, >= 0
  /// \return what the motors do now; nullopt: none plays
  [[nodiscard]] std::optional<Rumble> update(double dt);
  [[nodiscard]] std::optional<Pattern> playing() const { return playing_; }

 private:
  std::optional<Pattern> playing_;
  Zone side_ = Zone::center;
  int taps_ = 0;
  double since_ = 0.0;  ///< s
};

}  // namespace navvi_feedback::haptics
