#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

/// The words of an enumeration: `names(Enum)` beside it returns them in the order of its values,
/// which are those of the message's constants, from 0 without gaps.
namespace navvi_types {

/// Lower-case word, as in messages and journals: "pallet_robot", "no_route", ...
template <typename Enum>
[[nodiscard]] constexpr auto to_string(Enum value) -> std::decay_t<decltype(names(value)[0])> {
  return names(value)[static_cast<std::size_t>(value)];
}

/// nullopt for a word that names none.
template <typename Enum>
[[nodiscard]] std::optional<Enum> from_word(const std::string& word) {
  constexpr auto words = names(Enum{});
  for (std::size_t i = 0; i < words.size(); ++i)
    if (word == words[i]) return static_cast<Enum>(i);
  return std::nullopt;
}

/// nullopt for a number that stands for none.
template <typename Enum>
[[nodiscard]] constexpr std::optional<Enum> from_number(std::uint8_t number) {
  if (number >= names(Enum{}).size()) return std::nullopt;
  return static_cast<Enum>(number);
}

}  // namespace navvi_types
