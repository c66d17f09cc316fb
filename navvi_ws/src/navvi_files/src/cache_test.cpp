#include "navvi_files/cache.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <utility>
#include <vector>

#include "navvi_files/bytes.hpp"
#include "temp_folder.hpp"

namespace navvi_files {
namespace {

namespace fs = std::filesystem;

class CacheIn : public testing::Test {
 protected:
  [[nodiscard]] Cache cache(std::uintmax_t megabytes = 16, const std::string& build = "one") const {
    return Cache({folder_, megabytes, build});
  }
  [[nodiscard]] std::vector<fs::path> files() const { return folder_.files(); }
  [[nodiscard]] std::uintmax_t bytes() const {
    std::uintmax_t sum = 0;
    for (const fs::path& file : files()) sum += fs::file_size(file);
    return sum;
  }
  static void write(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
  }

  navvi_test::TempFolder folder_;
};

TEST_F(CacheIn, gives_back_what_was_kept_to_another_process_of_the_same_build_alone) {
  const std::string result("\0mesh\xff", 6);
  EXPECT_FALSE(cache().find("hall"));
  cache().keep("hall", result);
  EXPECT_EQ(cache().find("hall"), result);
  EXPECT_FALSE(cache().find("hall 2"));
  EXPECT_FALSE(cache(16, "another").find("hall"));
  cache().keep("hall", "newer");
  EXPECT_EQ(cache().find("hall"), "newer");
}

TEST_F(CacheIn, takes_no_damaged_file_and_replaces_it) {
  cache().keep("hall", "a mesh of some bytes");
  const fs::path file = files().at(0);
  const std::string good = read_file(file).value();
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x80);
    write(file, bad);
    EXPECT_FALSE(cache().find("hall")) << "byte " << at;
    write(file, good.substr(0, at));
    EXPECT_FALSE(cache().find("hall")) << "cut after " << at;
  }
  write(file, good + "x");
  EXPECT_FALSE(cache().find("hall"));
  cache().keep("hall", "a mesh of some bytes");
  EXPECT_EQ(cache().find("hall"), "a mesh of some bytes");
}

TEST_F(CacheIn, takes_no_file_that_was_kept_under_another_key) {
  cache().keep("hall", "of the hall");
  const fs::path hall = files().at(0);
  const std::string of_hall = read_file(hall).value();
  cache().keep("yard", "of the yard");
  for (const fs::path& file : files()) write(file, of_hall);
  EXPECT_EQ(cache().find("hall"), "of the hall");
  EXPECT_FALSE(cache().find("yard"));
}

TEST_F(CacheIn, goes_on_without_keeping_where_the_disk_is_full_or_the_folder_closed) {
  SystemCalls full = SystemCalls::real();
  full.write = [](int, const void*, std::size_t) -> ssize_t {
    errno = ENOSPC;
    return -1;
  };
  SystemCalls no_rename = SystemCalls::real();
  no_rename.rename = [](const char*, const char*) { return -1; };
  for (const SystemCalls& calls : {full, no_rename}) {
    Cache({folder_, 16, "one"}, calls).keep("hall", "mesh");
    EXPECT_TRUE(files().empty());
    EXPECT_FALSE(cache().find("hall"));
  }
  write(folder_ / "file", "");
  const Cache closed({folder_ / "file", 16, "one"});
  closed.keep("hall", "mesh");
  EXPECT_FALSE(closed.find("hall"));
}

TEST_F(CacheIn, keeps_to_its_bound_and_drops_what_was_used_longest_ago) {
  const std::string result(20'000, 'x');  // 3 of them fit into a folder's 62 500 bytes
  std::vector<std::string> keys;          // of one folder
  for (int i = 0; keys.size() < 4; ++i) {
    const std::string key = "hall " + std::to_string(i);
    if (hash_of(key) >> 60 == 0) keys.push_back(key);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    cache(1).keep(keys[i], result);
    for (const fs::path& file : files())  // each a minute older than before
      fs::last_write_time(file, fs::last_write_time(file) - std::chrono::minutes(1));
  }
  EXPECT_TRUE(cache(1).find(keys[0]));  // used again
  cache(1).keep(keys[3], result);
  EXPECT_TRUE(cache(1).find(keys[0]));
  EXPECT_FALSE(cache(1).find(keys[1]));
  EXPECT_TRUE(cache(1).find(keys[2]));
  EXPECT_TRUE(cache(1).find(keys[3]));

  for (int i = 0; i < 200; ++i) cache(1).keep("yard " + std::to_string(i), result);
  EXPECT_LE(bytes(), 1'000'000u);
  EXPECT_GT(files().size(), 20u);
  cache(1).keep("too large", std::string(70'000, 'x'));
  EXPECT_FALSE(cache(1).find("too large"));
}

TEST_F(CacheIn, of_no_megabytes_keeps_nothing) {
  cache(0).keep("hall", "mesh");
  EXPECT_TRUE(files().empty());
  cache().keep("hall", "mesh");
  EXPECT_FALSE(cache(0).find("hall"));
}

TEST_F(CacheIn, is_whole_for_all_who_read_while_two_write_the_same) {
  const std::vector<std::string> results = {std::string(300'000, 'a'), std::string(200'000, 'b')};
  cache().keep("hall", results[0]);
  std::vector<pid_t> writers;
  for (const std::string& result : results) {
    const pid_t id = ::fork();
    if (id == 0) {
      for (int i = 0; i < 100; ++i) cache().keep("hall", result);
      ::_exit(0);
    }
    ASSERT_GT(id, 0);
    writers.push_back(id);
  }
  for (std::size_t left = writers.size(); left > 0;) {
    const auto found = cache().find("hall");
    EXPECT_TRUE(found == results[0] || found == results[1]);
    for (pid_t& id : writers)
      if (id > 0 && ::waitpid(id, nullptr, WNOHANG) == id) id = 0, --left;
  }
  EXPECT_EQ(files().size(), 1u);
}

TEST(Bytes, are_read_back_as_they_were_written) {
  ByteWriter out;
  out.put(1.5, std::string("text"), std::vector<int>{1, -2, 3}, false);
  ByteReader in(out.bytes());
  double number = 0.0;
  std::string text;
  std::vector<int> numbers;
  bool flag = true;
  in.get(number, text, numbers, flag);
  EXPECT_EQ(number, 1.5);
  EXPECT_EQ(text, "text");
  EXPECT_EQ(numbers, (std::vector<int>{1, -2, 3}));
  EXPECT_FALSE(flag);
}

TEST(HashOfBytes, tells_each_changed_bit_and_the_length_apart) {
  const std::string bytes(19, '\0');
  const std::uint64_t hash = hash_of(bytes);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string other = bytes;
    other[bit / 8] = static_cast<char>(1 << bit % 8);
    EXPECT_NE(hash_of(other), hash) << bit;
  }
  EXPECT_NE(hash_of(std::string(20, '\0')), hash);
  EXPECT_NE(hash_of(std::string(24, '\0')), hash);
}

}  // namespace
}  // namespace navvi_files
