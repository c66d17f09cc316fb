#include "navvi_people/people/listener.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <navvi_config/reader.hpp>
#include <regex>
#include <set>

namespace navvi_people::people {
namespace {

constexpr double kFoot = 0.3048;  // m

std::string literal(const std::string& text) {
  static const std::regex special(R"([.^$|()\[\]{}*+?\\])");
  return std::regex_replace(text, special, R"(\$&)");
}

}  // namespace

Listener::Listener(const std::filesystem::path& phrases) {
  const YAML::Node root = navvi_config::load_yaml(phrases);
  for (const char* section : {"phrases", "again", "clock", "brief", "full"})
    for (const auto& item : root[section])
      if (const auto kind = navvi_types::from_word<CueKind>(item.first.Scalar()))
        phrases_.emplace(*kind, item.second.Scalar());
  for (const auto& item : root["words"])
    words_.emplace_back(item.second.Scalar(), item.first.Scalar());
  const auto go_on = phrases_.find(CueKind::go_on);
  if (go_on != phrases_.end()) go_on_ = go_on->second;
}

std::vector<Instruction> Listener::understand(std::optional<CueKind> kind,
                                              const std::string& text) const {
  std::vector<Instruction> heard;
  if (kind) {
    (void)parse(*kind, text, heard);
    return heard;
  }
  for (auto known = phrases_.begin(); known != phrases_.end();
       known = phrases_.upper_bound(known->first))
    if (heard.clear(); parse(known->first, text, heard) && heard.front().asks != Ask::nothing)
      break;
  return heard;
}

bool Listener::startles(CueKind kind, const std::string& text, double letters) const {
  using Family = navvi_types::CueFamily;
  const Family family = family_of(kind);
  const bool stops = family == Family::halt || family == Family::hit || family == Family::stuck;
  return stops && letters >= static_cast<double>(std::min(text.find_first_of(" ,"), text.size()));
}

bool Listener::parse(CueKind kind, const std::string& text, std::vector<Instruction>& heard) const {
  const std::string go_on = go_on_ + ", ";
  const bool goes_on = text.rfind(go_on, 0) == 0;
  const std::string told = goes_on ? text.substr(go_on.size()) : text;
  const auto [begin, end] = phrases_.equal_range(kind);
  const bool known = std::any_of(
      begin, end, [&](const auto& phrase) { return parse(kind, phrase.second, told, heard); });
  if (known && goes_on) heard.front().goes_on = true;
  return known;
}

bool Listener::parse(CueKind kind, const std::string& phrase, const std::string& text,
                     std::vector<Instruction>& heard) const {
  static const std::regex placeholder(R"(\{(\w+)\})");
  std::string pattern;
  std::vector<std::string> slots;
  std::size_t at = 0;
  for (std::sregex_iterator slot(phrase.begin(), phrase.end(), placeholder), none; slot != none;
       ++slot) {
    const auto begin = static_cast<std::size_t>(slot->position());
    pattern += literal(phrase.substr(at, begin - at));
    at = begin + static_cast<std::size_t>(slot->length());
    slots.push_back((*slot)[1]);
    const bool numbered = slots.back() == "distance";
    pattern += numbered ? R"((\d+(?:\.\d+)?) ()" : "()(";
    const char* bar = "";
    for (const auto& [word, key] : possible(slots.back())) {
      pattern += bar + literal(word);
      bar = "|";
    }
    pattern += slots.back() == "place" ? R"()(?: \d+)?)" : ")";
  }
  pattern += literal(phrase.substr(at)) + "(?:, (.*))?";
  std::smatch match;
  if (!std::regex_match(text, match, std::regex(pattern))) return false;
  Instruction told;
  told.asks = traits(kind).ask;
  for (std::size_t i = 0; i < slots.size(); ++i)
    fill(told, slots[i], match[2 * i + 2], match[2 * i + 1]);
  told.slight = kind == CueKind::slight;
  told.very_close = family_of(kind) == navvi_types::CueFamily::close;
  if (told.slight) told.hour = told.side == Instruction::Side::left ? 11 : 1;
  if (told.asks == Ask::turn && told.hour == 12) told.asks = Ask::go;
  // What comes after it is told again at the corner.
  if (told.asks == Ask::go) told.hour = 12;
  std::vector<Instruction> parts = {told};
  const std::string rest = match[match.size() - 1];
  static constexpr std::array kWay = {
      CueKind::direction, CueKind::slight,    CueKind::straight,          CueKind::turn_ahead,
      CueKind::around,    CueKind::goal_info, CueKind::goal_info_distance};
  const bool known = rest.empty() || std::any_of(kWay.begin(), kWay.end(), [&](CueKind more) {
                       return parse(more, rest, parts);
                     });
  if (known) heard.insert(heard.end(), parts.begin(), parts.end());
  return known;
}

Listener::Words Listener::possible(const std::string& placeholder) const {
  static const std::map<std::string, std::set<std::string>> prefixes = {
      {"direction", {"clock_", "left_right_", "degrees_"}},
      {"way", {"clock_", "left_right_", "degrees_"}},
      {"distance", {"meter", "meters", "foot", "feet"}},
      {"side", {"side_"}},
      {"where", {"where_"}},
      {"place", {"place_"}}};
  const auto wanted = prefixes.find(placeholder);
  Words words;
  for (const auto& [word, key] : words_) {
    const std::string& name = key;
    const bool fits =
        wanted == prefixes.end() ||
        std::any_of(wanted->second.begin(), wanted->second.end(),
                    [&](const std::string& start) { return name.rfind(start, 0) == 0; });
    if (fits) words.emplace_back(word, key);
  }
  return words;
}

void Listener::fill(Instruction& told, const std::string& placeholder, const std::string& word,
                    const std::string& number) const {
  using Side = Instruction::Side;
  static const std::map<std::string, Side> sides = {{"ahead", Side::ahead},
                                                    {"left", Side::left},
                                                    {"behind", Side::behind},
                                                    {"right", Side::right}};
  const Words words = possible(placeholder);
  const auto known = std::find_if(words.begin(), words.end(),
                                  [&](const auto& entry) { return entry.first == word; });
  if (known == words.end()) return;
  const std::string& key = known->second;
  const std::string end = key.substr(key.rfind('_') + 1);
  if (placeholder == "direction" || placeholder == "way") told.hour = std::stoi(end);
  if (placeholder == "side" || placeholder == "where") told.side = sides.at(end);
  if (placeholder == "distance")
    told.distance = std::stod(number) * (key.front() == 'f' ? kFoot : 1.0);
}

}  // namespace navvi_people::people
