#include "lessons/teller.hpp"

#include <cctype>

#include "navvi_config/reader.hpp"

namespace navvi_feedback::lessons {
namespace {

constexpr double kPatience = 20.0;  // s

std::string replaced(std::string text, const std::string& name, const std::string& value) {
  const std::string place = "{" + name + "}";
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place))
    text.replace(at, place.size(), value);
  return text;
}

}  // namespace

Teller::Teller(cues::Phrases phrases, const drive::ButtonsConfig& buttons,
               const std::vector<std::string>& needed)
    : phrases_(std::move(phrases)), buttons_(buttons) {
  for (const std::string& key : needed) {
    if (phrases_.lessons().count(key) == 0)
      throw navvi_config::ConfigError("the phrase file lacks lessons/" + key + ".");
    for (const bool keyboard : {false, true}) {
      keyboard_ = keyboard;
      for (const std::string& sentence :
           sentences(key, {{"count", "99"}, {"all", "99"}, {"way", "text"}, {"text", "text"}}))
        if (!cues::speakable(sentence))
          throw navvi_config::ConfigError("the phrase file's lessons/" + key +
                                          " cannot be spoken: \"" + sentence +
                                          "\"; allowed are 80 bytes a sentence.");
    }
  }
}

std::vector<std::string> Teller::sentences(const std::string& key, const Fillings& fillings) const {
  const auto by_keys = phrases_.lessons().find(key + "_keys");
  std::string text = keyboard_ && by_keys != phrases_.lessons().end() ? by_keys->second
                                                                      : phrases_.lessons().at(key);
  // Each stands in the picture by itself, in the letters of the guide's own phrases.
  for (std::size_t at = text.find(". "); at != std::string::npos; at = text.find(". ", at + 2))
    if (at + 3 < text.size() && std::islower(static_cast<unsigned char>(text[at + 3])) != 0)
      text[at + 2] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[at + 2])));
  for (std::size_t i = 0; i < drive::kButtons; ++i) {
    const auto name = phrases_.lessons().find((keyboard_ ? "key_" : "pad_") +
                                              std::to_string(buttons_.index.at(i)));
    text = replaced(text, navvi_types::names(drive::Button{}).at(i),
                    name == phrases_.lessons().end() ? "-" : name->second);
  }
  for (const auto& [name, value] : fillings) text = replaced(text, name, value);
  std::vector<std::string> result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(". ", begin), text.size());
    // Of what no button does help tells nothing.
    if (key != "help" || text.compare(begin, 2, "- ") != 0)
      result.push_back(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return result;
}

void Teller::then(const std::string& key, const Fillings& fillings) {
  for (const std::string& sentence : sentences(key, fillings)) push(CueKind::lesson, sentence, key);
}

void Teller::tell(const std::string& key, const Fillings& fillings) {
  waiting_.clear();
  then(key, fillings);
  at_once_ = !waiting_.empty();
}

void Teller::then_phrase(CueKind kind, const cues::Fillings& fillings) {
  push(kind, phrases_.say(kind, fillings), to_string(kind));
}

void Teller::tell_phrase(const std::string& key, const cues::Utterance& words) {
  cues::Fillings fillings = words.fillings;
  fillings.keys = keyboard_;
  const std::string begin = words.goes_on ? phrases_.say(CueKind::go_on) + ", " : "";
  waiting_.clear();
  push(CueKind::lesson, begin + phrases_.say(words.kind, fillings), key);
  at_once_ = true;
}

void Teller::push(CueKind kind, const std::string& text, const std::string& key) {
  cues::Cue cue{kind, text, Priority::message, kPatience};
  cue.asked = true;
  cue.lesson = key;
  waiting_.push_back(cue);
}

std::vector<cues::Cue> Teller::update(bool quiet) {
  if (waiting_.empty() || !(quiet || at_once_)) return {};
  at_once_ = false;
  const cues::Cue next = waiting_.front();
  waiting_.pop_front();
  return {next};
}

}  // namespace navvi_feedback::lessons
