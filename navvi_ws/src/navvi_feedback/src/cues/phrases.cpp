#include "cues/phrases.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>

#include "navvi_config/cited.hpp"
#include "navvi_config/reader.hpp"

namespace navvi_feedback::cues {
namespace {

using navvi_config::ConfigError;
using namespace navvi_types;

constexpr int kMostPlaces = 999;          // of one name that are told by number

const std::set<std::string> kPlaceholders = {
    "direction", "way",   "distance", "thing", "a_thing", "side", "where", "place",
    "setting",   "value", "person",   "stick", "push",    "more", "less",  "begin"};
/// Words for the hands: one for those on a pad, one for those on the keys.
const std::set<std::string> kHands = {"stick", "push", "more", "less", "begin"};
/// Phrases whose {place} may have a name of its own: those of the menu.
const std::set<std::string> kNaming = {"menu_place", "goal_chosen", "goal_sure", "place_saved",
                                       "press_pick", "press_drop", "press_scan",
                                       "zone_keep_out", "zone_slow", "zone_rack"};

constexpr std::array<const char*, 3> kDirections = {"clock", "left_right", "degrees"};

/// All classes that can be spoken of: no message holds the floor.
std::vector<const char*> things() {
  const auto all = names(ThingClass{});
  return {all.begin() + 1, all.end()};
}

std::set<std::string> word_keys() {
  std::set<std::string> keys = {"meter", "meters", "foot", "feet", "percent"};
  for (const char* thing : things()) keys.insert({thing, std::string("a_") + thing});
  for (const std::string& hands : kHands) keys.insert({"pad_" + hands, "key_" + hands});
  for (const char* side : names(Side{})) {
    keys.insert(std::string("side_") + side);
    keys.insert(std::string("where_") + side);
  }
  for (const char* place : names(PlaceName{})) keys.insert(std::string("place_") + place);
  for (const char* setting : names(SettingName{})) keys.insert(std::string("setting_") + setting);
  for (const char* value : names(SettingValue{})) keys.insert(std::string("value_") + value);
  for (const char* wording : kDirections)
    for (int hour = 1; hour <= 12; ++hour)
      keys.insert(std::string(wording) + "_" + std::to_string(hour));
  return keys;
}

/// What the picture shows; navvi_rviz reads it, too.
const std::set<std::string> kPicture = [] {
  std::istringstream words(
      "drive drive_no_sound no_sound to_go begin end repeat goal around chase top forward rviz "
      "settings vision down up choose back key plate_goal vision_high_contrast "
      "vision_yellow_on_black vision_large vision_color_blind vision_paper");
  return std::set<std::string>(std::istream_iterator<std::string>(words), {});
}();

/// A phrase stands under its content, or under the kind for all that this may be about.
bool may_be_general(const Content& content) {
  return traits(content.kind).about.front() != About::none;
}

std::set<std::string> phrase_keys() {
  std::set<std::string> keys;
  for (const Content& content : navvi_types::contents())
    keys.insert({to_string(content), to_string(content.kind)});
  keys.erase("");  // of a kind that is nothing but what it is about
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

class Section {
 public:
  Section(const std::string& file, const YAML::Node& root, const std::string& name)
      : file_(file), name_(name), node_(root[name]) {
    if (!node_ || !node_.IsMap())
      throw ConfigError(file + ": the section \"" + name + "\" is missing or is not a map.");
  }

  /// The texts of the section; every key is one of `allowed`, if that is given, and none comes
  /// twice.
  [[nodiscard]] std::map<std::string, std::string> read(
      const std::optional<std::set<std::string>>& allowed) {
    std::map<std::string, std::string> texts;
    for (const auto& item : node_) {
      if (!item.first.IsScalar()) fail(item.first, "?", "is not a word");
      const std::string key = item.first.Scalar();
      if (allowed && allowed->count(key) == 0) fail(item.first, key, "is not known");
      if (!item.second.IsScalar()) fail(item.second, key, "must be one text");
      if (!texts.emplace(key, item.second.Scalar()).second)
        fail(item.first, key, "is defined twice");
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
    sentence << file_ << ", line " << at.Mark().line + 1 << ": " << name_ << "/" << navvi_config::cited(key) << " "
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
  if (placeholder == "distance")
    return {"9999 " + words.at("meters"), "1 " + words.at("meter"), "9999 " + words.at("feet"),
            "1 " + words.at("foot")};
  std::vector<std::string> texts;
  const auto add = [&](const std::string& prefix) {
    for (const auto& [key, word] : words)
      if (key.rfind(prefix, 0) == 0) texts.push_back(word);
  };
  if (placeholder == "thing" || placeholder == "a_thing") {
    const std::string article = placeholder == "thing" ? "" : "a_";
    for (const char* thing : things()) texts.push_back(words.at(article + thing));
  } else if (kHands.count(placeholder) > 0) {
    texts = {words.at("pad_" + placeholder), words.at("key_" + placeholder)};
  } else if (placeholder == "direction" || placeholder == "way") {
    for (const char* wording : kDirections) add(std::string(wording) + "_");
  } else {
    add(placeholder + "_");
  }
  if (placeholder == "person") texts = {std::string(kMaxWord, 'a')};
  if (placeholder == "value") texts.push_back("999 " + words.at("percent"));
  if (placeholder == "place")
    for (std::string& text : texts) text += " 999";
  return texts;
}

/// Every filling of one placeholder is tried, with the longest of the others.
void check_phrase(const Section& section, const std::string& key, const std::string& text,
                  const std::map<std::string, std::string>& words) {
  std::set<std::string> used;
  try {
    fill_in(text, [&](const std::string& name) {
      if (kPlaceholders.count(name) == 0)
        section.fail(key, "has the unknown placeholder {" + navvi_config::cited(name) + "}");
      used.insert(name);
      return std::string();
    });
  } catch (const std::invalid_argument& error) {
    section.fail(key, error.what());
  }
  const auto texts_of = [&](const std::string& name) {
    std::vector<std::string> texts = possible(name, words);
    if (name == "place" && kNaming.count(key) > 0)
      for (const std::size_t first : {kMaxNameWord, kMaxName - 1 - kMaxNameWord})
        texts.push_back(std::string(first, 'a') + " " + std::string(kMaxName - 1 - first, 'a'));
    return texts;
  };
  const auto longest = [&](const std::string& name) {
    const auto texts = texts_of(name);
    return *std::max_element(texts.begin(), texts.end(),
                             [](const auto& a, const auto& b) { return a.size() < b.size(); });
  };
  if (used.empty() && !speakable(text)) section.fail(key, "cannot be spoken. " + limits());
  for (const std::string& tried : used)
    for (const std::string& value : texts_of(tried))
      if (!speakable(fill_in(text, [&](const std::string& name) {
            return name == tried ? value : longest(name);
          })))
        section.fail(key, "cannot be spoken when it is filled in. " + limits());
}

/// Sections whose phrases stand in for those of the section phrases.
constexpr const char* kInstead[] = {"again", "clock", "brief", "full"};

void check_sections(const std::string& name, const YAML::Node& root) {
  if (!root.IsMap()) throw ConfigError(name + ": it must be a map of sections.");
  static const std::set<std::string> sections = {"voice", "phrases", "again",   "clock",  "brief",
                                                 "full",  "words",   "picture", "lessons"};
  for (const auto& item : root)
    if (const std::string key = item.first.Scalar(); sections.count(key) == 0)
      throw ConfigError(
          name + ", line " + std::to_string(item.first.Mark().line + 1) +
          ": there is no section \"" + navvi_config::cited(key) +
          "\"; there are voice, phrases, again, clock, brief, full, words, picture and lessons.");
}

/// Whatever leads on may have to end a wait.
void check_ends_of_waits(const std::string& name, const YAML::Node& root,
                         const std::map<std::string, std::map<Content, std::string>>& phrases,
                         const std::map<std::string, std::string>& words) {
  for (const auto& [which, texts] : phrases)
    for (const auto& [content, text] : texts)
      for (const auto& ends : phrases)
        if (const auto go_on = ends.second.find(CueKind::go_on);
            is_way(family_of(content.kind)) && go_on != ends.second.end())
          check_phrase(Section(name, root, which), to_string(content), go_on->second + ", " + text,
                       words);
}

}  // namespace

Phrases::Phrases(const std::filesystem::path& file, const WordingConfig& wording)
    : wording_(wording) {
  const YAML::Node root = navvi_config::load_yaml(file);
  const std::string name = file.string();
  check_sections(name, root);
  if (!root["voice"] || !root["voice"].IsScalar())
    throw ConfigError(name + ": \"voice\" is missing or not a text; it names an espeak-ng voice.");
  voice_ = root["voice"].Scalar();

  Section words(name, root, "words");
  words_ = words.read(word_keys());
  for (const std::string& key : word_keys()) {
    if (words_.count(key) == 0) words.fail(key, "is missing");
    if (!speakable(words_[key])) words.fail(key, "cannot be spoken. " + limits());
  }

  Section picture(name, root, "picture");
  picture_ = picture.read(kPicture);
  for (const std::string& key : kPicture)
    if (picture_.count(key) == 0) picture.fail(key, "is missing");

  lessons_ = Section(name, root, "lessons").read(std::nullopt);

  Section phrases(name, root, "phrases");
  const auto read_phrases = [&](Section& section, const std::string& which) {
    for (const auto& [key, text] : section.read(phrase_keys())) {
      check_phrase(section, key, text, words_);
      phrases_[which].emplace(*navvi_types::from_word<Content>(key), text);
    }
  };
  read_phrases(phrases, "phrases");
  const std::map<Content, std::string>& usual = phrases_["phrases"];
  for (const Content& content : navvi_types::contents())
    if (usual.count(content) == 0 && !(may_be_general(content) && usual.count(content.kind) > 0))
      phrases.fail(to_string(content), "is missing");

  for (const char* which : kInstead) {
    Section section(name, root, which);
    read_phrases(section, which);
  }

  check_ends_of_waits(name, root, phrases_, words_);
}

std::string Phrases::say(const Content& content, const Fillings& fillings, bool again) const {
  for (const std::string& section :
       {std::string("again"), wording_.verbosity, wording_.directions, std::string("phrases")}) {
    if (section == "again" && !again) continue;
    const auto phrases = phrases_.find(section);
    if (phrases == phrases_.end()) continue;
    auto phrase = phrases->second.find(content);
    if (phrase == phrases->second.end() && may_be_general(content))
      phrase = phrases->second.find(content.kind);
    if (phrase != phrases->second.end())
      return fill_in(phrase->second,
                     [&](const std::string& name) { return filling(name, fillings); });
  }
  throw std::logic_error("\"" + to_string(content) + "\" has no phrase.");
}

std::string Phrases::filling(const std::string& placeholder, const Fillings& fillings) const {
  const auto missing = [&] {
    return std::logic_error("A phrase wants {" + placeholder + "}, which was not given.");
  };
  const auto given = [&](const auto& value) {
    if (!value) throw missing();
    return *value;
  };
  const auto word = [&](const std::string& kind, auto value) {
    return words_.at(kind + navvi_types::to_string(value));
  };
  if (placeholder == "distance") return distance(given(fillings.distance));
  if (placeholder == "thing") return word("", given(fillings.thing));
  if (placeholder == "a_thing") return word("a_", given(fillings.thing));
  if (kHands.count(placeholder) > 0)
    return words_.at((fillings.keys ? "key_" : "pad_") + placeholder);
  if (placeholder == "side" || placeholder == "where")
    return word(placeholder + "_", given(fillings.side));
  if (placeholder == "place" && !fillings.place_name.empty()) {
    if (!is_place_name(fillings.place_name)) throw missing();
    return fillings.place_name;
  }
  if (placeholder == "place") {
    const std::string place = word("place_", given(fillings.place));
    const std::string number = std::to_string(std::min(fillings.number, kMostPlaces));
    return fillings.number > 0 ? place + " " + number : place;
  }
  if (placeholder == "person") {
    std::string spoken = fillings.person;
    std::replace(spoken.begin(), spoken.end(), '_', ' ');
    if (!speakable(spoken)) throw missing();
    return spoken;
  }
  if (placeholder == "setting") return word("setting_", given(fillings.setting));
  if (placeholder == "value" && fillings.value) return word("value_", *fillings.value);
  if (placeholder == "value") {
    const std::string number = std::to_string(std::clamp(fillings.number, 0, kMostPlaces));
    const bool share = given(fillings.setting) != SettingName::rate;
    return share ? number + " " + words_.at("percent") : number;
  }
  if (!fillings.hour || *fillings.hour < 1 || *fillings.hour > 12) throw missing();
  if (placeholder == "way") return way(*fillings.hour);
  return words_.at(wording_.directions + "_" + std::to_string(*fillings.hour));
}

std::string Phrases::way(int hour) const {
  return words_.at((hour == 12 ? "left_right" : wording_.directions) + "_" + std::to_string(hour));
}

std::string Phrases::distance(double metres) const {
  if (!std::isfinite(metres) || metres < 0.0)
    throw std::logic_error("A distance to be spoken is negative or not a number.");
  const auto length = navvi_types::spoken_length(metres, wording_.units);
  return length.number + " " + words_.at(length.unit);
}

}  // namespace navvi_feedback::cues
