#pragma once

#include <filesystem>
#include <map>
#include <navvi_types/names.hpp>
#include <navvi_types/spoken.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cues/cue.hpp"
#include "cues/cue_config.hpp"
#include "cues/side.hpp"
#include "types.hpp"

namespace navvi_feedback::cues {

using navvi_types::is_place_name;
using navvi_types::speakable;

/// Where a person can go: the parts of the world as in navvi_types::Place, the task's goal, the
/// last ones, and those that they had remembered.
enum class PlaceName { dock, aisle, cross_aisle, room, task, last, remembered };

/// What a person can set while driving, and to what, besides numbers.
enum class SettingName {
  rate,
  volume,
  strength,
  verbosity,
  touch,
  way_words,
  near_words,
  lead,
  shelf_sound,
  near_sound,
  hit_sound,
  arrival_sound,
  beacon,
  hold,
};
enum class SettingValue { off, on, brief, normal, full, words, ticks, flow, hand };

/// What is put into a phrase: numbers, words of fixed sets, and names that a PersonFile or a file
/// of places may hold.
struct Fillings {
  std::optional<int> hour = {};         ///< 1..12
  std::optional<double> distance = {};  ///< m, >= 0
  std::optional<ThingClass> thing = {};
  std::optional<Side> side = {};
  std::optional<PlaceName> place = {};
  int number = 0;  ///< of the place, 0: none is said; or that the setting has
  std::optional<SettingName> setting = {};
  std::optional<SettingValue> value = {};  ///< of the setting, where that is no number
  std::string person = {};                 ///< letters, digits, - and _, at most 24
  std::string place_name = {};             ///< said instead of `place`, as is_place_name() allows
  bool keys = false;                       ///< the hands are on the keyboard
};

/// A cue that is not worded yet.
struct Utterance : Content {
  Fillings fillings = {};
  std::optional<Priority> priority = {};     ///< instead of the kind's own
  bool asked = false;                        ///< by the person: said however often
  std::vector<Utterance> also = {};          ///< in the same sentence, as far as there is room
  bool goes_on = false;                      ///< begins with the phrase go_on; of the way alone
  std::optional<Eigen::Vector2d> from = {};  ///< m, in base_link: its sound comes first, from there
};
using Utterances = std::vector<Utterance>;

/// The spoken sentences of one language (safety rule 4): templates from a file with numbers, and
/// words from the same file, put in. No text of any message can reach the voice.
///
/// The placeholders stand at the top of config/phrases/en.yaml.
class Phrases {
 public:
  /// \param file  with the sections voice, phrases, words, picture, lessons; in clock, brief and
  /// full stand phrases that are said instead where that wording is wanted, brief and full before
  /// clock, and in again what is said instead of the same words once more \throws
  /// navvi_config::ConfigError with file, line and key if the file is missing or no YAML, if a
  /// Content has no phrase or a word is missing, if a key or placeholder is unknown, or if a text,
  /// filled in any way, and after the phrase go_on if it is of the way, would not be speakable().
  explicit Phrases(const std::filesystem::path& file, const WordingConfig& wording = {});

  /// \throws std::logic_error for a lesson, a filling that the phrase needs and that is
  /// missing or not finite: a mistake in the program, as the file was checked when it was read
  /// \param again  what it has for what was just said, if it has
  [[nodiscard]] std::string say(const Content& content, const Fillings& fillings = {},
                                bool again = false) const;

  void use(const WordingConfig& wording) { wording_ = wording; }
  [[nodiscard]] const WordingConfig& wording() const { return wording_; }

  /// What {way} says. \param hour  1..12
  [[nodiscard]] std::string way(int hour) const;
  /// A length with its unit, as `navvi_types::spoken_length` rounds it. \param metres  m, finite,
  /// >= 0
  [[nodiscard]] std::string distance(double metres) const;

  /// The voice of espeak-ng that speaks this language.
  [[nodiscard]] const std::string& voice() const { return voice_; }
  /// What the picture shows, by key.
  [[nodiscard]] const std::map<std::string, std::string>& picture() const { return picture_; }
  /// What is told in lessons, by key; whoever tells it checks it.
  [[nodiscard]] const std::map<std::string, std::string>& lessons() const { return lessons_; }

 private:
  [[nodiscard]] std::string filling(const std::string& placeholder, const Fillings& fillings) const;

  WordingConfig wording_;
  std::string voice_;
  std::map<std::string, std::map<Content, std::string>> phrases_;  ///< by section
  std::map<std::string, std::string> words_;
  std::map<std::string, std::string> picture_;
  std::map<std::string, std::string> lessons_;
};

}  // namespace navvi_feedback::cues
