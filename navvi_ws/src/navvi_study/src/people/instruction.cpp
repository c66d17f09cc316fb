#include "people/instruction.hpp"

#include <algorithm>
#include <cctype>
#include <regex>

namespace navvi_study::people {
namespace {

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

}  // namespace

bool startles(const std::string& heard_so_far) {
  return says(heard_so_far, "^(hit|stuck|wait|stop)\\b");
}

Instruction understand(const std::string& spoken) {
  using Kind = Instruction::Kind;
  std::string text = spoken.substr(0, 200);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  Instruction heard;
  heard.side = side_in(text);
  if (says(text, "you have reached")) {
    heard.kind = Kind::arrived;
  } else if (says(text, "\\b(hit|stuck|touching|back away)\\b")) {
    heard.kind = Kind::bump;
  } else if (says(text,
                  "\\b(lost|disconnected|stopped|no route|no way|no map|out of "
                  "date|wait|refused|release)\\b")) {
    heard.kind = Kind::halt;
  } else if (says(text, "\\b(goal|destination)\\b")) {
    // As the crow flies: good to know, but no way to go.
  } else if (says(text,
                  "\\b(shelf|wall|box|pedestal|worker|forklift|robot|thing)\\b.*\\b(on the|"
                  "left|right|ahead|behind|front)\\b")) {
    heard.kind = Kind::near;
    heard.very_close = says(text, "very close");
  } else {
    const auto hour = number_before(text, "\\b(\\d{1,2}) ?o.?clock");
    heard.distance = number_before(text, "(\\d{1,4}(?:\\.\\d+)?) ?met");
    if (says(text, "^in \\d") && hour) {
      heard.kind = Kind::turn_ahead;
      heard.hour = static_cast<int>(std::clamp(*hour, 1.0, 12.0));
    } else if (hour && *hour >= 1.0 && *hour <= 11.0) {
      heard.kind = Kind::turn;
      heard.hour = static_cast<int>(*hour);
    } else if (hour || says(text, "straight")) {
      heard.kind = Kind::straight;
    }
  }
  return heard;
}

}  // namespace navvi_study::people
