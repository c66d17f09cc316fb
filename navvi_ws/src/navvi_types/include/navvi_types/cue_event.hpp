#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "navvi_types/cue_kind.hpp"
#include "navvi_types/names.hpp"
#include "navvi_types/signal.hpp"

namespace navvi_types {

enum class CueStage : std::uint8_t { queued, started, ended, cut, dropped };

enum class Modality : std::uint8_t { speech, rumble, sound };

/// A sentence.
struct Spoken : Content {
  // NOLINTNEXTLINE(google-explicit-constructor): a kind alone is a sentence of the guide
  Spoken(CueKind of = CueKind::lesson) : Content(of) {}
  // NOLINTNEXTLINE(google-explicit-constructor): so is a content
  Spoken(const Content& of, std::string key = {}) : Content(of), lesson(std::move(key)) {}
  std::string lesson;  ///< key of the text, where the kind is a lesson's
};
/// A change of the motors.
struct Felt {
  std::optional<Pattern> pattern = {};  ///< nullopt: what is near
};

/// One moment in the life of a message that is spoken, felt, or a short sound.
struct CueEvent {
  std::uint32_t id = 0;  ///< the same through the cue's life, 1 for the first, no gaps
  CueStage stage = CueStage::queued;
  std::variant<Spoken, Felt, Earcon> what = {};  ///< in the order of Modality
  std::string text = {};                         ///< as spoken; else empty
  Priority priority = Priority::text;
  double left = 0.0;  ///< motor command, or share of a sound from the left, [0, 1]; 0 for speech
  double right = 0.0;
  std::int64_t stamp = 0;  ///< ns, ROS time

  [[nodiscard]] Modality modality() const { return static_cast<Modality>(what.index()); }
  /// nullptr for what is not spoken
  [[nodiscard]] const Spoken* spoken() const { return std::get_if<Spoken>(&what); }
  /// nullopt for what is not spoken
  [[nodiscard]] std::optional<Content> content() const {
    return spoken() != nullptr ? std::optional<Content>(*spoken()) : std::nullopt;
  }
  [[nodiscard]] std::optional<CueKind> kind() const {
    return spoken() != nullptr ? std::optional(spoken()->kind) : std::nullopt;
  }
  /// In messages and records: the kind, a lesson's key, the pattern or "rumble", or the sound.
  [[nodiscard]] std::string word() const;
  /// It tells how what lasts has changed, and begins nothing.
  [[nodiscard]] bool lasts() const {
    const auto* const felt = std::get_if<Felt>(&what);
    const auto* const earcon = std::get_if<Earcon>(&what);
    return (felt != nullptr && !felt->pattern) || (earcon != nullptr && *earcon == Earcon::flow);
  }
};

/// The inverse of CueEvent::word(). \return nullopt for a word that no pattern or sound has
[[nodiscard]] std::optional<std::variant<Spoken, Felt, Earcon>> signal_of(Modality modality,
                                                                          const std::string& word);

}  // namespace navvi_types
