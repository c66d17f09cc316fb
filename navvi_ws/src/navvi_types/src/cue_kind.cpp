#include "navvi_types/cue_kind.hpp"

#include <map>

namespace navvi_types {

std::vector<Content> contents() {
  std::vector<Content> all;
  for (const CueTraits& row : cue_table::kRows)
    for (std::size_t i = 0; i < row.about.size() && row.kind != CueKind::lesson; ++i)
      if (i == 0 || row.about.at(i) != About::none) all.emplace_back(row.kind, row.about.at(i));
  return all;
}

std::string to_string(const Content& content) {
  std::string word = traits(content.kind).word;
  const std::size_t star = word.find('*');
  if (star == std::string::npos) return word;
  if (content.about != About::none) return word.replace(star, 1, to_string(content.about));
  return word.size() == 1 ? "" : word.erase(star == 0 ? 0 : star - 1, 2);
}

template <>
std::optional<Content> from_word<Content>(const std::string& word) {
  static const std::map<std::string, Content> known = [] {
    std::map<std::string, Content> words;
    for (const CueTraits& row : cue_table::kRows) words.emplace(to_string(row.kind), row.kind);
    for (const Content& content : contents()) words.emplace(to_string(content), content);
    words.erase("");
    return words;
  }();
  const auto found = known.find(word);
  return found != known.end() ? std::optional(found->second) : std::nullopt;
}

}  // namespace navvi_types
