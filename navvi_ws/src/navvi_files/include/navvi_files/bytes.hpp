#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace navvi_files {

/// FNV-1a (Fowler, Noll and Vo, 1991) over words of 8 bytes, folded after each, the last word
/// filled up with zeros, then over the number of bytes. Any change within one word changes it.
[[nodiscard]] std::uint64_t hash_of(std::string_view bytes);

/// Appends numbers as this machine holds them: for another process of the same build.
class ByteWriter {
 public:
  template <typename Number>
  void put(Number number) {
    static_assert(std::is_arithmetic_v<Number>);
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void put(std::string_view text) {
    put(std::uint64_t{text.size()});
    bytes_.append(text);
  }
  template <typename Number>
  void put(const std::vector<Number>& numbers) {
    static_assert(std::is_arithmetic_v<Number>);
    put(std::string_view(reinterpret_cast<const char*>(numbers.data()),
                         numbers.size() * sizeof(Number)));
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Takes them back in the same order. After the first that is not there all are zero or empty.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <typename Number>
  [[nodiscard]] Number get() {
    static_assert(std::is_arithmetic_v<Number>);
    Number number{};
    const std::string_view bytes = cut(sizeof number);
    if (!bytes.empty()) std::memcpy(&number, bytes.data(), sizeof number);
    return number;
  }
  [[nodiscard]] std::string_view get_text() { return cut(get<std::uint64_t>()); }
  template <typename Number>
  [[nodiscard]] std::vector<Number> get_all() {
    static_assert(std::is_arithmetic_v<Number>);
    const std::string_view bytes = get_text();
    std::vector<Number> numbers(bytes.size() / sizeof(Number));
    if (!numbers.empty())
      std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
    return numbers;
  }
  /// True if all that was asked for was there, and nothing is left.
  [[nodiscard]] bool ends_well() const { return good_ && left_.empty(); }
  /// False once something was asked for that is not there.
  [[nodiscard]] bool good() const { return good_; }

 private:
  [[nodiscard]] std::string_view cut(std::uint64_t size) {
    good_ = good_ && size <= left_.size();
    if (!good_) return {};
    const std::string_view out = left_.substr(0, size);
    left_.remove_prefix(size);
    return out;
  }

  std::string_view left_;
  bool good_ = true;
};

}  // namespace navvi_files
