#include "batch/speech_figures.hpp"

#include <algorithm>

namespace navvi_study::batch {
namespace {

constexpr double kSame = 10.0;  // s; the same sentence again within it is a repeat
constexpr double kObey = 2.0;   // s, to hear a word to stop and let go of the stick

bool stops(const navvi_types::CueEvent& cue) {
  return family_of(*cue.kind()) == navvi_types::CueFamily::halt;
}

}  // namespace

void SpeechFigures::hear(const navvi_types::CueEvent& cue, bool asked, double time) {
  using navvi_types::CueStage;
  if (cue.modality() != navvi_types::Modality::speech) return;
  if (cue.stage == CueStage::ended || cue.stage == CueStage::cut) {
    if (speaks_since_) talk_ += time - *speaks_since_;
    speaks_since_.reset();
  }
  if (cue.stage != CueStage::started) return;
  speaks_since_ = time;
  ++cues_;
  words_ += 1 + static_cast<int>(std::count(cue.text.begin(), cue.text.end(), ' '));
  const auto last = last_said_.find(cue.text);
  if (!asked && last != last_said_.end() && time - last->second < kSame) ++repeats_;
  last_said_[cue.text] = time;
  const auto just_now = [&](std::optional<double> then) { return then && time - *then < kObey; };
  const auto ends = [&](const std::string& end) {
    return cue.text.size() > end.size() &&
           cue.text.compare(cue.text.size() - end.size(), end.size(), end) == 0;
  };
  const bool straight = cue.text.find("straight") != std::string::npos;
  const bool ahead = !straight && ends(" ahead") && cue.kind() != navvi_types::CueKind::start;
  if ((straight && just_now(ahead_)) || (ahead && just_now(straight_))) ++at_odds_;
  if (straight) straight_ = time;
  if (ahead) ahead_ = time;
  if (asked) return;
  // What is more urgent than to wait may well follow at once.
  if (waited_ && time - *waited_ < kObey && cue.priority < navvi_types::Priority::important)
    ++hasty_;
  waited_.reset();
  if (!stops(cue)) return;
  ++waits_;
  waited_ = time;
}

void SpeechFigures::add_to(record::Fields& row, double duration) const {
  const double minutes = std::max(duration, 1.0) / 60.0;
  row.set("cues", cues_ / minutes, 1).set("words", words_ / minutes, 1);
  row.set("talk", talk_ / std::max(duration, 1.0), 3);
  row.set("repeats", std::uint64_t(repeats_)).set("waits", std::uint64_t(waits_));
  row.set("hasty", std::uint64_t(hasty_)).set("at_odds", std::uint64_t(at_odds_));
}

}  // namespace navvi_study::batch
