#include "navvi_people/people/ears.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_people::people {
namespace {

constexpr double kTogether = 0.15;  // s, within which one sound masks another
constexpr double kAside = 0.3;      // of both sides: more to one is from there
constexpr double kBurst = 1.0;      // s, of noise, the mean

/// \return the first, taken out, if it is due
template <typename Item>
std::optional<Item> take_due(std::deque<Item>& items, double time) {
  if (items.empty() || items.front().time > time) return std::nullopt;
  std::optional<Item> due = items.front();
  items.pop_front();
  return due;
}

}  // namespace

std::optional<Heard> heard(const CueEvent& cue) {
  using navvi_types::CueStage;
  using Moment = Speech::Moment;
  if (const auto* const earcon = std::get_if<Earcon>(&cue.what))
    return Sound{*earcon, cue.left, cue.right};
  if (cue.modality() != navvi_types::Modality::speech) return std::nullopt;
  switch (cue.stage) {
    case CueStage::started:
      return Speech{cue.id, Moment::begins, cue.text};
    case CueStage::ended:
      return Speech{cue.id, Moment::ends};
    case CueStage::cut:
      return Speech{cue.id, Moment::breaks_off};
    case CueStage::queued:
    case CueStage::dropped:
      break;
  }
  return std::nullopt;
}

void HearingConfig::describe(navvi_config::Visitor& visit) {
  visit(faults, "faults", navvi_config::Any{}, "",
        "false: nothing is missed or mistaken, and reactions are all alike");
  visit(words, "words", navvi_config::Any{}, "", "hears speech");
  visit(sounds, "sounds", navvi_config::Any{}, "", "hears sounds");
  visit(noise, "noise", navvi_config::Range{0.0, 0.95}, "",
        "share of sentences, short sounds and of the time of long ones that noise covers");
}

std::optional<Hearing::Sentence> Hearing::words(const std::string& text, double lasted) {
  const double rate = static_cast<double>(text.size()) / std::max(0.1, lasted);
  const double lost = std::clamp(rate / config_.fastest_speech - 1.0, 0.0, 1.0);
  const bool missed = random_.chance(1.0 - (1.0 - config_.missed_words) * (1.0 - lost) *
                                                (1.0 - config_.noise));
  const bool other_side = random_.chance(config_.mirrored);
  const bool other_hour = random_.chance(config_.misheard);
  const int hours = random_.chance(0.5) ? 1 : -1;
  const double reaction = random_.lognormal(config_.word_reaction, config_.word_spread);
  if (!config_.words) return std::nullopt;
  if (!config_.faults) return Sentence{config_.word_reaction, false, 0};
  if (missed) return std::nullopt;
  return Sentence{reaction, other_side, other_hour ? hours : 0};
}

std::vector<Instruction> Hearing::as_heard(const Sentence& sentence,
                                           std::vector<Instruction> told) {
  for (Instruction& part : told) {
    if (sentence.hours_off != 0 && part.asks == Ask::turn && !part.slight) {
      part.hour = 1 + (part.hour - 1 + sentence.hours_off + 12) % 12;
      if (part.hour == 12) part.asks = Ask::go;
    }
    if (sentence.mirrored) part = people::mirrored(part);
  }
  return told;
}

std::optional<Hearing::Tone> Hearing::sound(const Sound& sound, bool over_words, double time) {
  using Side = Instruction::Side;
  const bool covered = over_words || time - last_sound_ < kTogether;
  last_sound_ = time;
  const double missed =
      1.0 - (1.0 - config_.missed_sounds) * (covered ? 1.0 - config_.masked : 1.0) *
                (1.0 - config_.noise);
  const bool lost = random_.chance(missed);
  const bool other_side = random_.chance(config_.mirrored);
  const double reaction = random_.lognormal(config_.sound_reaction, config_.sound_spread);
  if (!config_.sounds || (config_.faults && lost)) return std::nullopt;
  const double lean = sound.left - sound.right;
  const bool aside = std::abs(lean) > kAside * (sound.left + sound.right);
  const bool left = (lean > 0.0) != (config_.faults && other_side);
  return Tone{!aside ? Side::ahead
              : left ? Side::left
                     : Side::right,
              config_.faults ? reaction : config_.sound_reaction};
}

bool Hearing::covered(double dt) {
  if (!config_.sounds) return true;
  if (config_.noise <= 0.0) return false;
  const double begins = config_.noise / (1.0 - config_.noise);
  covered_ = random_.chance((covered_ ? 1.0 : begins) * dt / kBurst) != covered_;
  return covered_;
}

void Ears::begins(const Speech& speech, const Belief& at, double time) {
  begun_[speech.id] = {speech.text, at, time, time};
}

const Sentence* Ears::ends(std::uint32_t id, bool elsewhere, double time) {
  const auto found = begun_.find(id);
  if (found == begun_.end()) return nullptr;
  Sentence sentence = found->second;
  begun_.erase(found);
  const auto ear = hearing_.words(sentence.text, time - sentence.begun);
  if (!ear || elsewhere) return nullptr;
  sentence.time = time + ear->reaction;
  sentence.parts = Hearing::as_heard(*ear, listener_.understand(sentence.text));
  understood_.push_back(sentence);
  return &understood_.back();
}

void Ears::sounds(const Sound& sound, bool elsewhere, double time) {
  const auto tone = hearing_.sound(sound, !begun_.empty(), time);
  if (tone && !elsewhere) tones_.push_back({sound.earcon, tone->side, time + tone->reaction});
}

std::vector<std::uint32_t> Ears::without_end(double time) const {
  std::vector<std::uint32_t> over;
  for (const auto& [id, sentence] : begun_) {
    const double length = 1.0 + static_cast<double>(sentence.text.size()) / kLettersPerSecond;
    if (time - sentence.begun > length) over.push_back(id);
  }
  return over;
}

std::optional<Sentence> Ears::next_sentence(double time) { return take_due(understood_, time); }

std::optional<Tone> Ears::next_tone(double time) { return take_due(tones_, time); }

}  // namespace navvi_people::people
