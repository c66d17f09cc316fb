#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "navvi_feedback/sounds/earcon.hpp"
#include "types.hpp"

namespace navvi_feedback::cues {

using Family = navvi_types::CueFamily;

/// One spoken message, before it is spoken.
struct Cue : Content {
  std::string text = {};  ///< as spoken
  Priority priority = Priority::text;
  double max_age = 2.0;                    ///< s after which it is dropped if it has not begun
  std::optional<sounds::Play> sound = {};  ///< played instead of the words
  bool asked = false;                      ///< the answer to a button
  bool goes_on = false;                    ///< it ends a wait: "go on", and where to
  bool felt = false;                       ///< only: its words were said just now
  /// Each sounds before one of the parts of the words, which commas separate.
  std::vector<sounds::Play> scan = {};
  std::string lesson = {};  ///< key of the text, where a lesson says it

  [[nodiscard]] std::string word() const {
    return kind == CueKind::lesson ? lesson : to_string(static_cast<Content>(*this));
  }
};

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
