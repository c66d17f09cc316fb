#include "people/instruction.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <regex>
#include <utility>
#include <vector>

namespace navvi_study::people {
namespace {

constexpr double kFoot = 0.3048;  // m

bool says(const std::string& text, const char* pattern) {
  return std::regex_search(text, std::regex(pattern));
}

std::optional<double> number_before(const std::string& text, const char* pattern) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(pattern))) return std::nullopt;
  return std::stod(match[1]);
}

Instruction::Side side_in(const std::string& text) {
  if (says(text, "\\bleft\\b")) return Instruction::Side::left;
  if (says(text, "\\bright\\b")) return Instruction::Side::right;
  if (says(text, "\\b(behind|rear)\\b")) return Instruction::Side::behind;
  if (says(text, "\\b(ahead|front)\\b")) return Instruction::Side::ahead;
  return Instruction::Side::none;
}

/// The hour that a direction means, by the clock or by left and right.
std::optional<int> hour_in(const std::string& text) {
  if (const auto hour = number_before(text, "\\b(\\d{1,2}) ?o.?clock"))
    return static_cast<int>(*hour);
  if (const auto degrees = number_before(text, "\\b(\\d{1,3}) degrees")) {
    const int hours = static_cast<int>(std::lround(*degrees / 30.0));
    return side_in(text) == Instruction::Side::left ? 12 - hours : hours;
  }
  static const std::vector<std::pair<const char*, int>> words = {
      {"slightly right", 1}, {"half right", 2}, {"sharp right", 4}, {"back right", 5},
      {"around", 6},         {"back left", 7},  {"sharp left", 8},  {"half left", 10},
      {"slightly left", 11}, {"right", 3},      {"left", 9}};
  for (const auto& [word, hour] : words)
    if (text.find(word) != std::string::npos) return hour;
  return std::nullopt;
}

}  // namespace

bool startles(const std::string& heard_so_far) {
  return says(heard_so_far, "^(hit|stuck|wait|stop)\\b");
}

Instruction understand(const std::string& spoken) {
  using Kind = Instruction::Kind;
  std::string text = spoken.substr(0, 200);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (text.rfind("go on, ", 0) == 0) text.erase(0, 7);
  Instruction heard;
  heard.side = side_in(text);
  if (says(text, "^press start")) {
    heard.kind = Kind::begin;
  } else if (says(text, "you have reached")) {
    heard.kind = Kind::arrived;
  } else if (says(text, "\\b(hit|stuck|touching|back away)\\b")) {
    heard.kind = Kind::bump;
  } else if (says(text,
                  "\\b(lost|disconnected|stopped|no route|no way|no map|out of "
                  "date|wait|refused|release)\\b")) {
    heard.kind = Kind::halt;
  } else if (says(text, "\\b(goal|destination)\\b")) {
    // As the crow flies: good to know, but no way to go.
  } else if (!says(text, "^make room") &&
             says(text,
                  "\\b(shelf|wall|box|pedestal|worker|forklift|robot|thing)\\b.*\\b(on the|"
                  "left|right|ahead|behind|front)\\b")) {
    heard.kind = Kind::near;
    heard.very_close = says(text, "very close");
  } else {
    const std::optional<int> hour = hour_in(text);
    heard.distance = number_before(text, "(\\d{1,4}(?:\\.\\d+)?) ?met");
    if (const auto feet = number_before(text, "(\\d{1,4}) f(?:oo|ee)t"))
      heard.distance = *feet * kFoot;
    if (says(text, "^a little (left|right)")) {
      heard.kind = Kind::turn;
      heard.hour = heard.side == Instruction::Side::left ? 11 : 1;
      heard.slight = true;
    } else if (says(text, "^(no turn, )?straight")) {
      // What comes then is said again at the corner.
      heard.kind = Kind::straight;
    } else if (says(text, "^in \\d") && hour) {
      heard.kind = Kind::turn_ahead;
      heard.hour = std::clamp(*hour, 1, 12);
    } else if (hour && *hour >= 1 && *hour <= 11) {
      heard.kind = Kind::turn;
      heard.hour = *hour;
    } else if (hour || says(text, "straight")) {
      heard.kind = Kind::straight;
    }
  }
  return heard;
}

}  // namespace navvi_study::people
