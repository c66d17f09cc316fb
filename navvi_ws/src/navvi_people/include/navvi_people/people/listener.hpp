#pragma once

#include <filesystem>
#include <map>
#include <navvi_types/cue_kind.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace navvi_people::people {

using navvi_types::Ask;
using navvi_types::CueKind;

/// What a listener makes of a spoken sentence.
struct Instruction {
  enum class Side { none, left, right, ahead, behind };

  Ask asks = Ask::nothing;
  int hour = 12;                   ///< 1 to 12
  std::optional<double> distance;  ///< m
  Side side = Side::none;
  bool very_close = false;  ///< of what is near
  bool slight = false;      ///< a turn of less than half an hour
  bool goes_on = false;     ///< after "go on"
  bool holds = false;       ///< until "go on"
};

/// Left for right.
[[nodiscard]] Instruction mirrored(Instruction told);

/// Understands all that a catalogue of phrases can say, in each of its wordings, as a person does
/// who speaks its language: by the words alone.
class Listener {
 public:
  /// \param phrases  file, as feedback_node's
  /// \throws navvi_config::ConfigError if it cannot be read
  explicit Listener(const std::filesystem::path& phrases);

  /// \return one for each part of the sentence, in order; none for words that ask for nothing, or
  /// that the catalogue lacks
  [[nodiscard]] std::vector<Instruction> understand(const std::string& text) const;
  /// The same of a sentence whose kind is known, for those who judge what was said.
  [[nodiscard]] std::vector<Instruction> understand(CueKind kind, const std::string& text) const;

  /// What the first word of a sentence is enough for.
  struct FirstWord {
    bool startles = false;  ///< lets go of the stick
    bool holds = false;     ///< until "go on"
  };
  /// \param letters  heard so far
  [[nodiscard]] FirstWord first_word(const std::string& text, double letters) const;

 private:
  using Words = std::vector<std::pair<std::string, std::string>>;  ///< word, its key
  /// A literal, or a place for one of several words.
  struct Piece {
    std::string literal;
    std::string slot;  ///< name of the placeholder; empty: a literal
    Words words;       ///< that may stand in it
  };
  struct Phrase {
    CueKind kind;
    std::vector<Piece> pieces;
  };

  void add(CueKind kind, const std::string& phrase);
  [[nodiscard]] bool parse(CueKind kind, std::string_view text,
                           std::vector<Instruction>& heard) const;
  [[nodiscard]] bool match(const Phrase& phrase, std::size_t piece, std::string_view text,
                           Instruction told, std::vector<Instruction>& heard) const;
  [[nodiscard]] bool follow_up(std::string_view rest, std::vector<Instruction>& heard) const;
  [[nodiscard]] Words possible(const std::string& placeholder) const;

  std::map<CueKind, std::vector<Phrase>> phrases_;  ///< in all wordings
  Words words_;
  std::string go_on_;
  std::set<std::string> startling_, holding_;  ///< first words
};

}  // namespace navvi_people::people
