#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

// FNV-1a of 64 bits (Fowler, Noll and Vo, 1991). A hash begins with kHashBasis and goes through one
// of these for each value. Over words it is quicker than over bytes, and gives other numbers.

namespace navvi_sim {

constexpr std::uint64_t kHashBasis = 0xCBF29CE484222325ull;

/// One step for a whole word.
[[nodiscard]] inline std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  return (hash ^ word) * 0x100000001B3ull;
}

/// One step for the bits of a number.
[[nodiscard]] inline std::uint64_t mix(std::uint64_t hash, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return mix(hash, bits);
}

/// One step for each byte, as FNV-1a is published.
[[nodiscard]] inline std::uint64_t mix_bytes(std::uint64_t hash, const void* data,
                                             std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) hash = mix(hash, std::uint64_t{bytes[i]});
  return hash;
}

}  // namespace navvi_sim
