#pragma once

#include <optional>

#include "cues/cue_config.hpp"
#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Tells a person whose robot is held fast what holds it, and where it is free.
class Stuck {
 public:
  explicit Stuck(const CuePolicyConfig& config) : config_(config) {}

  /// \param follows  the person is led along a path, so that the free way nearest to it is named
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] Utterances update(const Observation& now, bool follows, double time);

 private:
  [[nodiscard]] Utterance words(const Observation& now, bool follows) const;

  CuePolicyConfig config_;
  std::optional<double> since_;  ///< s, commanded without moving
  std::optional<double> said_;   ///< s
};

}  // namespace navvi_feedback::cues
