#pragma once

#include <map>

#include "cues/cue.hpp"

namespace navvi_feedback::cues {

/// When each content was last said.
class LastSaid {
 public:
  void note(const Content& content, double time) { said_[content] = time; }
  void forget(const Content& content) { said_.erase(content); }

  /// It would come within its least interval now.
  [[nodiscard]] bool too_soon(const Content& content, double time) const {
    const auto said = said_.find(content);
    return said != said_.end() && time - said->second < traits(content.kind).min_interval;
  }

 private:
  std::map<Content, double> said_;  ///< s
};

}  // namespace navvi_feedback::cues
