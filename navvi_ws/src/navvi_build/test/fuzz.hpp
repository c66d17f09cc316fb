#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "temp_folder.hpp"

namespace navvi_test {

/// Damages bytes, each time otherwise, and the same way for the same seed.
class Mutator {
 public:
  Mutator(std::vector<std::string> corpus, unsigned seed)
      : corpus_(std::move(corpus)), random_(seed) {}

  std::string next() {
    std::string bytes = corpus_[below(corpus_.size())];
    for (std::size_t i = 1 + below(4); i > 0; --i) damage(bytes);
    return bytes;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  void damage(std::string& bytes) {
    static const std::vector<std::string> kTokens{
        "nan", "-inf", "-1", "1e308", "-1e-308", "99999999999999999999", "2147483648", "0", "",
        " ", "\n", std::string(1, '\0'), "\xff\xfe", "\xc3", "%s", "{", "}", "[", "]", "<", ">", "</",
        "\"", "'", ":", "&", "&amp;", "*a", "../", "/", "!!binary ", "- ", "#", "~", ".nan"};
    const std::size_t at = below(bytes.size() + 1);
    const std::size_t size = std::min(below(bytes.size() - at + 1), std::size_t{1} << below(13));
    const std::string& token = kTokens[below(kTokens.size())];
    switch (below(8)) {
      case 0:  // a byte
        if (at < bytes.size()) bytes[at] = static_cast<char>(random_());
        break;
      case 1:
        bytes.erase(at, size);
        break;
      case 2:  // twice, or many times
        for (std::size_t i = 0, times = 1U << below(4); i < times; ++i)
          bytes.insert(at, bytes.substr(at, size));
        break;
      case 3:
        bytes.insert(at, token);
        break;
      case 4: {  // another number
        const auto is_number = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; };
        const auto begin = std::find_if(bytes.begin() + static_cast<long>(at), bytes.end(), is_number);
        bytes.replace(begin, std::find_if_not(begin, bytes.end(), is_number), token);
        break;
      }
      case 5:  // a whole number of 1, 2, 4 or 8 bytes
        for (std::size_t i = at; i < std::min(bytes.size(), at + (1U << below(4))); ++i)
          bytes[i] = token.size() % 2 == 0 ? '\xff' : '\x7f';
        break;
      case 6: {  // the end of another one
        const std::string& other = corpus_[below(corpus_.size())];
        bytes = bytes.substr(0, at) + other.substr(below(other.size() + 1));
        break;
      }
      default:
        bytes.resize(at);
    }
  }

  std::vector<std::string> corpus_;
  std::mt19937_64 random_;
};

/// Gives damaged bytes to a reader: each is read, or refused by sentences fit for a terminal. A reader that crashes, hangs or
/// throws anything else fails. $NAVVI_FUZZ has how many (a few without it) and, after a space, the number of the first.
/// \param corpus  what is whole
inline void fuzz_bytes(const std::vector<std::string>& corpus,
                       const std::function<void(const std::string& bytes)>& read) {
  const char* const given = std::getenv("NAVVI_FUZZ");
  char* more = nullptr;
  const unsigned long rounds = given == nullptr ? 300 : std::strtoul(given, &more, 10);
  const unsigned long first = more == nullptr ? 0 : std::strtoul(more, nullptr, 10);
  for (unsigned long seed = first; seed < first + rounds; ++seed) {
    testing::Test::RecordProperty("last", static_cast<int>(seed));
    try {
      read(Mutator(corpus, static_cast<unsigned>(seed)).next());
    } catch (const std::runtime_error& refusal) {
      const std::string sentence = refusal.what();
      const auto is_control = [](unsigned char c) { return (c < ' ' && c != '\n') || c == 0x7f; };
      EXPECT_FALSE(sentence.empty()) << "number " << seed;
      EXPECT_TRUE(std::none_of(sentence.begin(), sentence.end(), is_control))
          << "number " << seed << ": " << sentence;
      EXPECT_LT(sentence.size(), 10000U) << "number " << seed;
    } catch (const std::exception& other) {
      ADD_FAILURE() << "number " << seed << " throws " << typeid(other).name() << ": " << other.what();
    }
    if (testing::Test::HasFailure()) return;
  }
}

/// Likewise, damaged files. \param name  of the file \param read  its path is given
inline void fuzz(const std::vector<std::string>& corpus, const std::string& name,
                 const std::function<void(const std::string& path)>& read) {
  fuzz_bytes(corpus, [&](const std::string& bytes) {
    const TempFolder folder;
    read(folder.write(name, bytes));
  });
}

}  // namespace navvi_test
