#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

/// The words of an enumeration are the names of its values, which are those of the message's
/// constants, from 0 without gaps.
namespace navvi_types {

/// The name of a value, as GCC and Clang tell it ("... kValue = navvi_types::ThingClass::floor]");
/// of a number without one ("... (navvi_types::ThingClass)9]") that number.
template <auto kValue>
[[nodiscard]] constexpr auto name_of() {
  constexpr std::string_view told = __PRETTY_FUNCTION__;
  constexpr std::size_t begin = told.find_last_of(":)") + 1;
  std::array<char, told.size() - begin> name{};
  for (std::size_t i = 0; i + 1 < name.size(); ++i) name[i] = told[begin + i];
  return name;
}
template <auto kValue>
inline constexpr auto kName = name_of<kValue>();

template <typename Enum, std::size_t... kNumbers>
[[nodiscard]] constexpr auto names_from(std::index_sequence<kNumbers...> /*numbers*/) {
  constexpr std::size_t next = sizeof...(kNumbers);
  if constexpr (kName<static_cast<Enum>(next)>[0] > '9')
    return names_from<Enum>(std::make_index_sequence<next + 1>{});
  else
    return std::array<const char*, next>{kName<static_cast<Enum>(kNumbers)>.data()...};
}
/// All of them.
template <typename Enum, typename = std::enable_if_t<std::is_enum_v<Enum>>>
[[nodiscard]] constexpr auto names(Enum /*any*/) {
  return names_from<Enum>(std::index_sequence<>{});
}

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
