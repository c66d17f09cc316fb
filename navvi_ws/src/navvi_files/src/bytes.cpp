#include "navvi_files/bytes.hpp"

#include <algorithm>
#include <cstring>

namespace navvi_files {

std::uint64_t hash_of(std::string_view bytes) {
  constexpr std::uint64_t kBasis = 0xCBF29CE484222325ull, kPrime = 0x100000001B3ull;
  std::uint64_t hash = kBasis;
  const std::uint64_t size = bytes.size();
  for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), sizeof hash))) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), std::min(bytes.size(), sizeof word));
    hash = (hash ^ word) * kPrime;
    hash ^= hash >> 32;
  }
  return (hash ^ size) * kPrime;
}

}  // namespace navvi_files
