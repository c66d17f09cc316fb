#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "cues/cue.hpp"
#include "cues/phrases.hpp"
#include "drive/buttons.hpp"

namespace navvi_feedback::lessons {

/// Tells the texts of a lesson, sentence by sentence, each when the one before it was heard. Their
/// {names} are those of drive::Button, filled with what the person presses for them, and those that
/// are given.
class Teller {
 public:
  using Fillings = std::map<std::string, std::string>;

  /// \param needed  the keys of all texts that will be told
  /// \throws navvi_config::ConfigError if a text is missing, or cannot be spoken
  Teller(cues::Phrases phrases, const drive::ButtonsConfig& buttons,
         const std::vector<std::string>& needed);

  /// Names that the device's buttons have: the pad's, or those of the keyboard.
  void hands(bool keyboard) { keyboard_ = keyboard; }
  /// Forgets what waits, and cuts what is spoken unless it is urgent.
  void tell(const std::string& key, const Fillings& fillings = {});
  /// After what waits.
  void then(const std::string& key, const Fillings& fillings = {});
  void forget() { waiting_.clear(); }
  /// A phrase of the guide as it is spoken in a session, after what waits.
  void then_phrase(CueKind kind, const cues::Fillings& fillings);
  /// Likewise, but as tell() does, and known by `key`; of the utterance its kind, fillings and
  /// goes_on count.
  void tell_phrase(const std::string& key, const cues::Utterance& words);

  [[nodiscard]] const cues::Phrases& phrases() const { return phrases_; }

  /// \param quiet  nothing is spoken or waits for it
  /// \return what is to be said now
  [[nodiscard]] std::vector<cues::Cue> update(bool quiet);
  [[nodiscard]] bool done() const { return waiting_.empty(); }

 private:
  void push(CueKind kind, const std::string& text, const std::string& key);
  [[nodiscard]] std::vector<std::string> sentences(const std::string& key,
                                                   const Fillings& fillings) const;

  cues::Phrases phrases_;
  drive::ButtonsConfig buttons_;
  bool keyboard_ = false;
  bool at_once_ = false;
  std::deque<cues::Cue> waiting_;
};

}  // namespace navvi_feedback::lessons
