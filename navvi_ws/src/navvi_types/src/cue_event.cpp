#include "navvi_types/cue_event.hpp"

namespace navvi_types {
namespace {

const char* const kNearness = "rumble";  ///< of motors without a pattern

std::string word_of(const Spoken& spoken) {
  return spoken.kind == CueKind::lesson ? spoken.lesson : to_string(static_cast<Content>(spoken));
}
std::string word_of(const Felt& felt) {
  return felt.pattern ? to_string(*felt.pattern) : kNearness;
}
std::string word_of(Earcon earcon) { return to_string(earcon); }

}  // namespace

std::string CueEvent::word() const {
  return std::visit([](const auto& of) { return word_of(of); }, what);
}

std::optional<std::variant<Spoken, Felt, Earcon>> signal_of(Modality modality,
                                                            const std::string& word) {
  switch (modality) {
    case Modality::speech: {
      const auto content = from_word<Content>(word);
      return content ? Spoken(*content) : Spoken(CueKind::lesson, word);
    }
    case Modality::rumble: {
      const auto pattern = from_word<Pattern>(word);
      if (!pattern && word != kNearness) return std::nullopt;
      return Felt{pattern};
    }
    case Modality::sound:
      if (const auto earcon = from_word<Earcon>(word)) return *earcon;
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace navvi_types
