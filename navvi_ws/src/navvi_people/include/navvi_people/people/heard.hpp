#pragma once

#include <cstdint>
#include <navvi_types/cue_event.hpp>
#include <optional>
#include <string>
#include <variant>

namespace navvi_people {
using navvi_types::CueEvent;
using navvi_types::Earcon;
}  // namespace navvi_people

namespace navvi_people::people {

/// A moment of a spoken sentence. What kind of cue it is, an ear cannot tell.
struct Speech {
  enum class Moment : std::uint8_t { begins, ends, breaks_off };
  std::uint32_t id = 0;  ///< the same through the sentence
  Moment moment = Moment::begins;
  std::string text = {};  ///< where it begins
};

/// A short sound begins.
struct Sound {
  Earcon earcon = Earcon::turn;  ///< as it sounds
  double left = 0.0;             ///< share from each side, [0, 1]
  double right = 0.0;
};

/// All that an ear gets.
using Heard = std::variant<Speech, Sound>;

/// All that a hand gets: the motors, each [0, 1], from now on.
struct Felt {
  double left = 0.0;
  double right = 0.0;
};

/// What is played of a cue; nullopt: nothing that is heard.
[[nodiscard]] std::optional<Heard> heard(const CueEvent& cue);

}  // namespace navvi_people::people
