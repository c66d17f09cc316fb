#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <regex>
#include <string>

/// The names of the tests that stand in a source file, as gtest's filter; empty if there are none.
/// \param file  the end of its path, such as "src/live/world_test.cpp"
/// \param part  a pattern of the names; empty: all
static std::string tests_in(const std::string& file, const std::string& part) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const testing::TestInfo& test = *suite.GetTestInfo(k);
      const std::string path = test.file();
      if (path.size() < file.size() || path.compare(path.size() - file.size(), file.size(), file)) continue;
      const std::string name = std::string(suite.name()) + "." + test.name();
      if (std::regex_search(name, std::regex(part))) filter += name + ":";
    }
  }
  return filter;
}

/// Runs a package's tests: with --file=src/ROOM/NAME_test.cpp those of one source file (of them, those in whose name
/// the pattern $NAVVI_TEST_CASE is found), else all, with gtest's own options.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const std::string option = "--file=";
  const char* const part = std::getenv("NAVVI_TEST_CASE");
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.compare(0, option.size(), option)) continue;
    const std::string filter = tests_in(word.substr(option.size()), part == nullptr ? "" : part);
    if (filter.empty()) {
      std::fprintf(stderr, "no test stands in \"%s\"\n", word.c_str() + option.size());
      return 2;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  return RUN_ALL_TESTS();
}
