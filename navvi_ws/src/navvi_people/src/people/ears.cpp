#include "navvi_people/people/ears.hpp"

namespace navvi_people::people {
namespace {

/// \return the first, taken out, if it is due
template <typename Item>
std::optional<Item> take_due(std::deque<Item>& items, double time) {
  if (items.empty() || items.front().time > time) return std::nullopt;
  std::optional<Item> due = items.front();
  items.pop_front();
  return due;
}

}  // namespace

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
