#pragma once

#include <map>

#include "cues/cue.hpp"

namespace navvi_feedback::cues {

/// When each kind of cue was last said.
class LastSaid {
 public:
  void note(CueKind kind, double time) { said_[kind] = time; }
  void forget(CueKind kind) { said_.erase(kind); }

  /// One of this kind now would come within its least interval.
  [[nodiscard]] bool too_soon(CueKind kind, double time) const {
    const auto said = said_.find(kind);
    return said != said_.end() && time - said->second < navvi_types::traits(kind).min_interval;
  }

 private:
  std::map<CueKind, double> said_;  ///< s
};

}  // namespace navvi_feedback::cues
