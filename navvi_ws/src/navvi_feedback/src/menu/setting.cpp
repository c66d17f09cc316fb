#include "menu/setting.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace navvi_feedback::menu {
namespace {

constexpr const char* kNoButton = "-1";

std::vector<std::string> range(double from, double to, double step) {
  std::vector<std::string> values;
  const int steps = static_cast<int>(std::lround((to - from) / step));
  for (int i = 0; i <= steps; ++i) {
    std::ostringstream text;
    text << from + i * step;
    values.push_back(text.str());
  }
  return values;
}

}  // namespace

const std::vector<Setting>& settings() {
  using Name = cues::SettingName;
  using sounds::Earcon;
  const std::vector<std::string> shares = range(0.1, 1.0, 0.1);
  const std::vector<std::string> off_on = {"false", "true"};
  // Up to the largest rate that espeak-ng speaks; that is no multiple of the step.
  static const std::vector<Setting> all = [&] {
    std::vector<std::string> rates = range(80.0, 440.0, 20.0);
    rates.push_back("449");
    return std::vector<Setting>{
        {Name::rate, "speaker/rate", rates},
        {Name::volume, "mixer/volume", shares},
        {Name::strength, "haptics/strength", shares, true},
        {Name::verbosity, "cues/wording/verbosity", {"brief", "normal", "full"}},
        {Name::touch, "haptics/near", off_on, true},
        {Name::way_words, "cues/wording/way", off_on},
        {Name::near_words, "cues/wording/near", off_on},
        {Name::lead, "lead", {"words", "ticks", "flow", "hand"}},
        {Name::shelf_sound, "sounds/shelf/on", off_on, false, Earcon::shelf_near},
        {Name::near_sound, "sounds/near/on", off_on, false, Earcon::worker_near},
        {Name::hit_sound, "sounds/hit/on", off_on, false, Earcon::hit_shelf},
        {Name::arrival_sound, "sounds/arrival/on", off_on, false, Earcon::arrived},
        {Name::beacon, "sounds/beacon/on", off_on, false, Earcon::beacon},
        {Name::hold, "drive/enable", {kNoButton, "9"}},
    };
  }();
  return all;
}

std::string Setting::step(const std::string& value, bool up) const {
  const auto at = std::find(values.begin(), values.end(), value);
  if (at != values.end()) {
    if (up) return std::next(at) == values.end() ? *at : *std::next(at);
    return at == values.begin() ? *at : *std::prev(at);
  }
  // A number of a file or an argument, that no step leads to.
  const double number = std::stod(value);
  const auto above = std::find_if(values.begin(), values.end(), [&](const std::string& step) {
    return std::stod(step) > number;
  });
  if (up) return above == values.end() ? values.back() : *above;
  return above == values.begin() ? values.front() : *std::prev(above);
}

cues::Utterance Setting::say(About entry, const std::string& value) const {
  cues::Utterance told{{CueKind::menu, entry}};
  told.fillings.setting = name;
  told.fillings.value = navvi_types::from_word<cues::SettingValue>(value);
  if (value == "false") told.fillings.value = cues::SettingValue::off;
  if (value == "true") told.fillings.value = cues::SettingValue::on;
  if (name == cues::SettingName::hold)
    told.fillings.value = value == kNoButton ? cues::SettingValue::off : cues::SettingValue::on;
  if (!told.fillings.value) {
    const double number = std::stod(value);
    const bool share = name != cues::SettingName::rate;
    told.fillings.number = static_cast<int>(std::lround(share ? 100.0 * number : number));
  }
  return told;
}

}  // namespace navvi_feedback::menu
