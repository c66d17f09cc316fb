#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace navvi_files {

/// FNV-1a (Fowler, Noll and Vo, 1991) over words of 8 bytes, folded after each, the last word
/// filled up with zeros, then over the number of bytes. Any change within one word changes it.
[[nodiscard]] std::uint64_t hash_of(std::string_view bytes);

/// Appends values as this machine holds them: for another process of the same build.
class ByteWriter {
 public:
  /// \param values  numbers, texts, and vectors of what may be copied as bytes
  template <typename... Values>
  void put(const Values&... values) {
    (add(values), ...);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  template <typename Value>
  void add(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>) {
      append(&value, 1);
    } else {
      add(value.size());
      append(value.data(), value.size());
    }
  }
  template <typename Item>
  void append(const Item* items, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Item>);
    bytes_.append(reinterpret_cast<const char*>(items), count * sizeof(Item));
  }

  std::string bytes_;
};

/// Takes them back in the same order, from bytes that such a writer wrote: see Cache.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <typename... Values>
  void get(Values&... values) {
    (take(values), ...);
  }

 private:
  template <typename Value>
  void take(Value& value) {
    if constexpr (std::is_arithmetic_v<Value>) {
      copy(&value, 1);
    } else {
      std::size_t size = 0;
      take(size);
      value.resize(size);
      copy(value.data(), size);
    }
  }
  template <typename Item>
  void copy(Item* items, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Item>);
    left_.remove_prefix(left_.copy(reinterpret_cast<char*>(items), count * sizeof(Item)));
  }

  std::string_view left_;
};

}  // namespace navvi_files
