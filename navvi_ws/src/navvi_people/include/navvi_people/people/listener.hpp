#pragma once

#include <filesystem>
#include <map>
#include <navvi_types/cue_kind.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "navvi_people/people/instruction.hpp"

namespace navvi_people::people {

using navvi_types::CueKind;

/// Understands whatever a catalogue of phrases can say, in each of its wordings, as a person does
/// who speaks its language: by the words that were heard and the kind of sentence that they make.
class Listener {
 public:
  /// \param phrases  file, as feedback_node's
  /// \throws navvi_config::ConfigError if it cannot be read
  explicit Listener(const std::filesystem::path& phrases);

  /// \param kind  of the cue; nullopt: told by the words
  /// \return one for each part of the sentence, in order; none for words that the catalogue lacks
  [[nodiscard]] std::vector<Instruction> understand(std::optional<CueKind> kind,
                                                    const std::string& text) const;

  /// Whether what was heard of a sentence is enough to let go of the stick.
  /// \param letters  heard so far
  [[nodiscard]] bool startles(CueKind kind, const std::string& text, double letters) const;

 private:
  using Words = std::vector<std::pair<std::string, std::string>>;  ///< word, its key

  [[nodiscard]] bool parse(CueKind kind, const std::string& text,
                           std::vector<Instruction>& heard) const;
  [[nodiscard]] bool parse(CueKind kind, const std::string& phrase, const std::string& text,
                           std::vector<Instruction>& heard) const;
  [[nodiscard]] Words possible(const std::string& placeholder) const;
  void fill(Instruction& told, const std::string& placeholder, const std::string& word,
            const std::string& number) const;

  std::multimap<CueKind, std::string> phrases_;  ///< by kind, in all wordings
  Words words_;
  std::string go_on_;
};

}  // namespace navvi_people::people
