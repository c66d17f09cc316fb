#pragma once

#include <optional>
#include <string>
#include <utility>

namespace navvi_types {

/// Why a message is dropped, as the end of a sentence: "its frame_id is empty".
struct Refusal {
  std::string why;
};

/// A message's value, or why there is none.
template <typename T>
class Checked : public std::optional<T> {
 public:
  using std::optional<T>::optional;
  Checked(Refusal refusal) : why_(std::move(refusal.why)) {}

  /// Empty where there is a value.
  [[nodiscard]] const std::string& why() const { return why_; }

 private:
  std::string why_;
};

template <typename T>
[[nodiscard]] std::string why_not(const Checked<T>& read) {
  return read.why();
}
template <typename T>
[[nodiscard]] std::string why_not(const std::optional<T>&) {
  return "a value in it is not finite or out of range";
}

}  // namespace navvi_types
