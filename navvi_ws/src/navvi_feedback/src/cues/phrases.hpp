#pragma once

#include <filesystem>
#include <map>
#include <navvi_types/thing.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cues/side.hpp"
#include "navvi_feedback/cues/cue.hpp"
#include "navvi_feedback/cues/cue_config.hpp"

namespace navvi_feedback {
using navvi_types::ThingClass;
}  // namespace navvi_feedback

namespace navvi_feedback::cues {

/// What is put into a phrase: numbers, and words of fixed sets.
struct Fillings {
  std::optional<int> hour = {};         ///< 1..12
  std::optional<double> distance = {};  ///< m, >= 0
  std::optional<ThingClass> thing = {};
  std::optional<Side> side = {};
};

/// A cue that is not worded yet.
struct Utterance {
  std::string kind = {};
  Fillings fillings = {};
  std::optional<Priority> priority = {};  ///< instead of the kind's own
  bool asked = false;                     ///< by the person: said however often
  std::vector<Fillings> also = {};        ///< the same is said of these, as far as there is room
  bool goes_on = false;                   ///< begins with the phrase go_on
};

/// The spoken sentences of one language (safety rule 4): templates from a file with numbers, and
/// words from the same file, put in. No text of any message can reach the voice.
///
/// Placeholders: {clock} an hour, {turn} its wording by left and right, {distance} a distance with
/// its unit, {thing} a thing's noun, {side} "left", {where} "on the left". What is spoken holds
/// only [A-Za-z0-9 ,.'-], at most 80 bytes, at most 24 bytes a word.
class Phrases {
 public:
  /// \throws navvi_config::ConfigError with file, line and key if the file is missing or no YAML,
  /// if a kind of cue_kinds() has no phrase or a word is missing, if a key or placeholder is
  /// unknown, or if a text, filled in any way, would break the limits above.
  explicit Phrases(const std::filesystem::path& file,
                   DirectionWords directions = DirectionWords::clock);

  /// \throws std::logic_error for an unknown kind, a filling that the phrase needs and that is
  /// missing or not finite: a mistake in the program, as the file was checked when it was read
  [[nodiscard]] std::string say(const std::string& kind, const Fillings& fillings = {}) const;

  /// A distance with its unit: whole metres from 2 m on, halves below, never less than half a
  /// metre, "1 meter" in the singular. \param metres  m, finite, >= 0
  [[nodiscard]] std::string distance(double metres) const;

 private:
  [[nodiscard]] std::string filling(const std::string& placeholder, const Fillings& fillings) const;

  std::map<std::string, std::string> phrases_;
  std::map<std::string, std::string> words_;
};

/// True if `text` may be spoken: not empty and within the limits of Phrases.
[[nodiscard]] bool speakable(const std::string& text);

}  // namespace navvi_feedback::cues
