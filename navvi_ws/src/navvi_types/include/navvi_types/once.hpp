#pragma once

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace navvi_types {

/// Counts sentences by kind, so that a log tells each kind once: those that differ in their numbers
/// alone are of one kind.
class Once {
 public:
  struct Kind {
    std::string first;   ///< the sentence as it came first
    unsigned count = 0;  ///< so far
  };

  /// True if the sentence is the first of its kind. Beyond 100 kinds none is new.
  bool operator()(const std::string& sentence) {
    std::string key;
    std::copy_if(sentence.begin(), sentence.end(), std::back_inserter(key), [](unsigned char c) {
      return std::isdigit(c) == 0 && c != '.' && c != '-';
    });
    if (const auto known = kinds_.find(key); known != kinds_.end())
      return ++known->second.count, false;
    return kinds_.size() < kMost && kinds_.emplace(std::move(key), Kind{sentence, 1U}).second;
  }
  [[nodiscard]] const std::map<std::string, Kind>& kinds() const { return kinds_; }

 private:
  static constexpr std::size_t kMost = 100;
  std::map<std::string, Kind> kinds_;
};

}  // namespace navvi_types
