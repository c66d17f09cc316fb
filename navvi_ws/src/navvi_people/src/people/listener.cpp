#include "navvi_people/people/listener.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <navvi_config/reader.hpp>
#include <navvi_types/spoken.hpp>

namespace navvi_people::people {
namespace {

std::string first_of(const std::string& text) {
  return text.substr(0, std::min(text.find_first_of(" ,"), text.size()));
}

bool starts(std::string_view text, std::string_view with) {
  return text.substr(0, with.size()) == with;
}

/// Letters of a number such as 12 or 1.5 at the beginning.
std::size_t digits(std::string_view text) {
  const auto run = [&](std::size_t at) {
    while (at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0) ++at;
    return at;
  };
  const std::size_t whole = run(0);
  if (whole == 0 || whole >= text.size() || text[whole] != '.') return whole;
  const std::size_t all = run(whole + 1);
  return all > whole + 1 ? all : whole;
}

/// What a word, by its key, adds.
void fill(Instruction& told, const std::string& placeholder, const std::string& key,
          std::string_view number) {
  using Side = Instruction::Side;
  static const std::map<std::string, Side> sides = {{"ahead", Side::ahead},
                                                    {"left", Side::left},
                                                    {"behind", Side::behind},
                                                    {"right", Side::right}};
  const std::string end = key.substr(key.rfind('_') + 1);
  if (placeholder == "direction" || placeholder == "way") told.hour = std::stoi(end);
  if (placeholder == "side" || placeholder == "where") told.side = sides.at(end);
  if (placeholder == "distance")
    told.distance = std::stod(std::string(number)) * (key.front() == 'f' ? navvi_types::kFoot : 1.0);
}

/// What its kind makes of it.
void conclude(Instruction& told, CueKind kind) {
  told.asks = traits(kind).ask;
  told.slight = kind == CueKind::slight;
  told.very_close = kind == CueKind::close;
  told.holds = family_of(kind) == navvi_types::CueFamily::halt;
  if (told.slight) told.hour = told.side == Instruction::Side::left ? 11 : 1;
  if (told.asks == Ask::turn && told.hour == 12) told.asks = Ask::go;
  // What comes after it is told again at the corner.
  if (told.asks == Ask::go) told.hour = 12;
}

}  // namespace

Instruction mirrored(Instruction told) {
  using Side = Instruction::Side;
  told.hour = told.hour == 12 ? 12 : 12 - told.hour;
  if (told.side == Side::left || told.side == Side::right)
    told.side = told.side == Side::left ? Side::right : Side::left;
  return told;
}

Listener::Listener(const std::filesystem::path& phrases) {
  using Family = navvi_types::CueFamily;
  const YAML::Node root = navvi_config::load_yaml(phrases);
  for (const auto& item : root["words"])
    words_.emplace_back(item.second.Scalar(), item.first.Scalar());
  for (const char* section : {"phrases", "again", "clock", "brief", "full"})
    for (const auto& item : root[section]) {
      const auto content = navvi_types::from_word<navvi_types::Content>(item.first.Scalar());
      if (!content) continue;
      const CueKind kind = content->kind;
      const std::string text = item.second.Scalar();
      add(kind, text);
      const Family family = family_of(kind);
      if (family == Family::halt) holding_.insert(first_of(text));
      if (family == Family::halt || kind == CueKind::collision || family == Family::stuck)
        startling_.insert(first_of(text));
      if (kind == CueKind::go_on && go_on_.empty()) go_on_ = text;
    }
}

void Listener::add(CueKind kind, const std::string& phrase) {
  Phrase made{kind, {}};
  std::size_t at = 0;
  while (at < phrase.size()) {
    const std::size_t open = std::min(phrase.find('{', at), phrase.size());
    if (open > at) made.pieces.push_back({phrase.substr(at, open - at), {}, {}});
    if (open == phrase.size()) break;
    const std::size_t close = phrase.find('}', open);
    const std::string slot = phrase.substr(open + 1, close - open - 1);
    made.pieces.push_back({{}, slot, possible(slot)});
    at = close + 1;
  }
  phrases_[kind].push_back(std::move(made));
}

std::vector<Instruction> Listener::understand(CueKind kind, const std::string& text) const {
  std::vector<Instruction> heard;
  (void)parse(kind, text, heard);
  return heard;
}

std::vector<Instruction> Listener::understand(const std::string& text) const {
  std::vector<Instruction> heard;
  for (const auto& [kind, phrases] : phrases_)
    if (traits(kind).ask != Ask::nothing && parse(kind, text, heard)) break;
  return heard;
}

Listener::FirstWord Listener::first_word(const std::string& text, double letters) const {
  const std::string word = first_of(text);
  if (letters < static_cast<double>(word.size())) return {};
  return {startling_.count(word) > 0, holding_.count(word) > 0};
}

bool Listener::parse(CueKind kind, std::string_view text, std::vector<Instruction>& heard) const {
  const std::string go_on = go_on_ + ", ";
  const bool goes_on = starts(text, go_on);
  const std::string_view told = goes_on ? text.substr(go_on.size()) : text;
  const auto phrases = phrases_.find(kind);
  if (phrases == phrases_.end()) return false;
  const bool known =
      std::any_of(phrases->second.begin(), phrases->second.end(),
                  [&](const Phrase& phrase) { return match(phrase, 0, told, {}, heard); });
  if (known && goes_on) heard.front().goes_on = true;
  return known;
}

bool Listener::match(const Phrase& phrase, std::size_t piece, std::string_view text,
                     Instruction told, std::vector<Instruction>& heard) const {
  if (piece == phrase.pieces.size()) {
    conclude(told, phrase.kind);
    std::vector<Instruction> parts = {told};
    if (!text.empty() && !(starts(text, ", ") && follow_up(text.substr(2), parts))) return false;
    heard.insert(heard.end(), parts.begin(), parts.end());
    return true;
  }
  const Piece& next = phrase.pieces[piece];
  if (next.slot.empty())
    return starts(text, next.literal) &&
           match(phrase, piece + 1, text.substr(next.literal.size()), told, heard);
  // A place may have any name.
  if (next.slot == "place" && piece + 1 < phrase.pieces.size()) {
    const std::size_t end = text.find(phrase.pieces[piece + 1].literal);
    if (end != text.npos && match(phrase, piece + 1, text.substr(end), told, heard)) return true;
  }
  const std::size_t number = next.slot == "distance" ? digits(text) : 0;
  if (next.slot == "distance" && (number == 0 || text.substr(number, 1) != " ")) return false;
  const std::string_view words = number > 0 ? text.substr(number + 1) : text;
  return std::any_of(next.words.begin(), next.words.end(), [&](const auto& word) {
    if (!starts(words, word.first)) return false;
    std::string_view rest = words.substr(word.first.size());
    if (next.slot == "place" && starts(rest, " ")) {
      const std::size_t length = digits(rest.substr(1));
      if (length > 0) rest = rest.substr(1 + length);
    }
    Instruction more = told;
    fill(more, next.slot, word.second, text.substr(0, number));
    return match(phrase, piece + 1, rest, more, heard);
  });
}

bool Listener::follow_up(std::string_view rest, std::vector<Instruction>& heard) const {
  static constexpr std::array kWay = {CueKind::direction,  CueKind::slight, CueKind::straight,
                                      CueKind::turn_ahead, CueKind::around, CueKind::goal_info};
  return std::any_of(kWay.begin(), kWay.end(),
                     [&](CueKind more) { return parse(more, rest, heard); });
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

}  // namespace navvi_people::people
