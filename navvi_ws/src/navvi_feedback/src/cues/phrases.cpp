#include "cues/phrases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>
#include <stdexcept>

#include "navvi_config/reader.hpp"

namespace navvi_feedback::cues {
namespace {

using navvi_config::ConfigError;

constexpr std::size_t kMaxBytes = 80;
constexpr std::size_t kMaxWord = 24;
/// m; beyond it a distance is not spoken exactly, so that its length is bounded.
constexpr double kFar = 9999.0;

const std::set<std::string> kPlaceholders = {"clock", "turn", "distance", "thing", "side", "where"};

constexpr std::array<const char*, 4> kSides = {"ahead", "left", "behind", "right"};

/// All classes that can be spoken of: no message holds the floor.
std::vector<const char*> things() {
  const auto all = names(ThingClass{});
  return {all.begin() + 1, all.end()};
}

std::set<std::string> word_keys() {
  std::set<std::string> keys = {"meter", "meters"};
  for (const char* thing : things()) keys.insert(thing);
  for (const char* side : kSides) {
    keys.insert(std::string("side_") + side);
    keys.insert(std::string("where_") + side);
  }
  for (int hour = 1; hour <= 12; ++hour) keys.insert("turn_" + std::to_string(hour));
  return keys;
}

std::set<std::string> kind_keys() {
  std::set<std::string> keys;
  for (const CueKind& kind : cue_kinds()) keys.insert(kind.kind);
  return keys;
}

/// Replaces each {name} by what `fill` returns for it. \throws std::invalid_argument on a brace
/// without a partner
template <typename Fill>
std::string fill_in(const std::string& text, const Fill& fill) {
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] != '{') {
      filled += text[at++];
      continue;
    }
    const std::size_t end = text.find('}', at);
    if (end == std::string::npos) throw std::invalid_argument("has a { without its }");
    filled += fill(text.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return filled;
}

std::string limits() {
  return "Spoken text holds only letters, digits and \" ,.'-\", at most 80 bytes, at most 24 a "
         "word.";
}

/// One section of the phrase file, key by key.
class Section {
 public:
  Section(const std::string& file, const YAML::Node& root, const std::string& name)
      : file_(file), name_(name), node_(root[name]) {
    if (!node_ || !node_.IsMap())
      throw ConfigError(file + ": the section \"" + name + "\" is missing or is no map.");
  }

  /// The texts of the section; every key is one of `allowed`, and none comes twice.
  [[nodiscard]] std::map<std::string, std::string> read(const std::set<std::string>& allowed) {
    std::map<std::string, std::string> texts;
    for (const auto& item : node_) {
      if (!item.first.IsScalar()) fail(item.first, "?", "is no word");
      const std::string key = item.first.Scalar();
      if (allowed.count(key) == 0) fail(item.first, key, "is not known");
      if (!item.second.IsScalar()) fail(item.second, key, "must be one text");
      if (!texts.emplace(key, item.second.Scalar()).second)
        fail(item.first, key, "stands there twice");
    }
    return texts;
  }

  [[noreturn]] void fail(const std::string& key, const std::string& why) const {
    fail(node_[key] ? node_[key] : node_, key, why);
  }

 private:
  [[noreturn]] void fail(const YAML::Node& at, const std::string& key,
                         const std::string& why) const {
    std::ostringstream sentence;
    sentence << file_ << ", line " << at.Mark().line + 1 << ": " << name_ << "/" << key << " "
             << why << ".";
    throw ConfigError(sentence.str());
  }

  std::string file_;
  std::string name_;
  YAML::Node node_;
};

/// The longest text that each placeholder may become, and the words it may become.
std::vector<std::string> possible(const std::string& placeholder,
                                  const std::map<std::string, std::string>& words) {
  if (placeholder == "clock") return {"12"};
  if (placeholder == "distance") return {"9999 " + words.at("meters"), "1 " + words.at("meter")};
  std::vector<std::string> texts;
  const auto add = [&](const std::string& prefix) {
    for (const auto& [key, word] : words)
      if (key.rfind(prefix, 0) == 0) texts.push_back(word);
  };
  if (placeholder == "thing") {
    for (const char* thing : things()) texts.push_back(words.at(thing));
  } else {
    add(placeholder + "_");
  }
  return texts;
}

/// Every filling of one placeholder is tried, with the longest of the others.
void check_phrase(const Section& section, const std::string& key, const std::string& text,
                  const std::map<std::string, std::string>& words) {
  std::set<std::string> used;
  try {
    fill_in(text, [&](const std::string& name) {
      if (kPlaceholders.count(name) == 0)
        section.fail(key, "has the unknown placeholder {" + name.substr(0, kMaxWord) + "}");
      used.insert(name);
      return std::string();
    });
  } catch (const std::invalid_argument& error) {
    section.fail(key, error.what());
  }
  const auto longest = [&](const std::string& name) {
    const auto texts = possible(name, words);
    return *std::max_element(texts.begin(), texts.end(),
                             [](const auto& a, const auto& b) { return a.size() < b.size(); });
  };
  if (used.empty() && !speakable(text)) section.fail(key, "cannot be spoken. " + limits());
  for (const std::string& tried : used)
    for (const std::string& value : possible(tried, words))
      if (!speakable(fill_in(text, [&](const std::string& name) {
            return name == tried ? value : longest(name);
          })))
        section.fail(key, "cannot be spoken when it is filled in. " + limits());
}

}  // namespace

bool speakable(const std::string& text) {
  if (text.empty() || text.size() > kMaxBytes) return false;
  std::size_t word = 0;
  bool letters = false;
  for (const char c : text) {
    const bool letter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (!letter && (c == '\0' || std::string(" ,.'-").find(c) == std::string::npos)) return false;
    word = c == ' ' ? 0 : word + 1;
    if (word > kMaxWord) return false;
    letters = letters || letter;
  }
  return letters;
}

Phrases::Phrases(const std::filesystem::path& file, DirectionWords directions) {
  const YAML::Node root = navvi_config::load_yaml(file);
  const std::string name = file.string();
  if (!root.IsMap()) throw ConfigError(name + ": it must be a map of sections.");
  for (const auto& item : root)
    if (const std::string key = item.first.Scalar();
        key != "phrases" && key != "left_right" && key != "words")
      throw ConfigError(name + ", line " + std::to_string(item.first.Mark().line + 1) +
                        ": there is no section \"" + key +
                        "\"; there are phrases, left_right and words.");

  Section words(name, root, "words");
  words_ = words.read(word_keys());
  for (const std::string& key : word_keys()) {
    if (words_.count(key) == 0) words.fail(key, "is missing");
    if (!speakable(words_[key])) words.fail(key, "cannot be spoken. " + limits());
  }

  Section phrases(name, root, "phrases");
  phrases_ = phrases.read(kind_keys());
  for (const CueKind& kind : cue_kinds())
    if (phrases_.count(kind.kind) == 0) phrases.fail(kind.kind, "is missing");
  for (const auto& [kind, text] : phrases_) check_phrase(phrases, kind, text, words_);

  Section left_right(name, root, "left_right");
  const auto instead = left_right.read(kind_keys());
  for (const auto& [kind, text] : instead) check_phrase(left_right, kind, text, words_);
  if (directions == DirectionWords::left_right)
    for (const auto& [kind, text] : instead) phrases_[kind] = text;
}

std::string Phrases::say(const std::string& kind, const Fillings& fillings) const {
  const auto phrase = phrases_.find(kind);
  if (phrase == phrases_.end()) throw std::logic_error("\"" + kind + "\" has no phrase.");
  return fill_in(phrase->second, [&](const std::string& name) { return filling(name, fillings); });
}

std::string Phrases::filling(const std::string& placeholder, const Fillings& fillings) const {
  const auto missing = [&] {
    return std::logic_error("A phrase wants {" + placeholder + "}, which was not given.");
  };
  if (placeholder == "distance") {
    if (!fillings.distance) throw missing();
    return distance(*fillings.distance);
  }
  if (placeholder == "thing") {
    if (!fillings.thing) throw missing();
    return words_.at(to_string(*fillings.thing));
  }
  if (placeholder == "side" || placeholder == "where") {
    if (!fillings.side) throw missing();
    return words_.at(placeholder + "_" + kSides.at(static_cast<std::size_t>(*fillings.side)));
  }
  if (!fillings.hour || *fillings.hour < 1 || *fillings.hour > 12) throw missing();
  const std::string hour = std::to_string(*fillings.hour);
  return placeholder == "clock" ? hour : words_.at("turn_" + hour);
}

std::string Phrases::distance(double metres) const {
  if (!std::isfinite(metres) || metres < 0.0)
    throw std::logic_error("A distance to be spoken is negative or no number.");
  const double rounded =
      metres < 1.75 ? std::max(0.5, std::round(metres * 2.0) / 2.0) : std::round(metres);
  std::array<char, 16> number{};
  const bool half = rounded != std::floor(rounded);
  std::snprintf(number.data(), number.size(), half ? "%.1f" : "%.0f", std::min(rounded, kFar));
  return std::string(number.data()) + " " + words_.at(rounded == 1.0 ? "meter" : "meters");
}

}  // namespace navvi_feedback::cues
