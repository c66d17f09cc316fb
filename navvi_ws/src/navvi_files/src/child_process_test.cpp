#include "navvi_files/child_process.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace navvi_files {
namespace {

std::vector<Answer> answers(std::size_t count, std::size_t at_once,
                            const std::function<std::string(std::size_t)>& work) {
  std::vector<Answer> out;
  run_in_children(count, at_once, work, "it crashed", [&](std::size_t index, const Answer& answer) {
    EXPECT_EQ(index, out.size()) << "in order";
    out.push_back(answer);
  });
  return out;
}

TEST(Children, answer_in_order_though_the_first_waits_for_the_last) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const auto all = answers(3, 3, [&](std::size_t index) {
    char sign = 'x';
    const bool spoke = index != 2 || ::write(ends[1], &sign, 1) == 1;
    const bool heard = index != 0 || ::read(ends[0], &sign, 1) == 1;
    if (!spoke || !heard) return std::string("the pipe is broken");
    return std::to_string(index);
  });
  ASSERT_EQ(all.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(all[i].good);
    EXPECT_EQ(all[i].text, std::to_string(i));
  }
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(Children, may_say_more_than_a_pipe_holds) {
  const auto all = answers(
      4, 2, [](std::size_t index) { return std::string(300000, static_cast<char>('a' + index)); });
  ASSERT_EQ(all.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(all[i].text, std::string(300000, static_cast<char>('a' + i)));
}

TEST(Children, that_crash_end_or_throw_take_nobody_with_them) {
  const auto all = answers(5, 2, [](std::size_t index) -> std::string {
    if (index == 1) std::abort();
    if (index == 2) ::_exit(1);  // as a library may
    if (index == 3) throw std::runtime_error("no world");
    return "well";
  });
  ASSERT_EQ(all.size(), 5U);
  for (const std::size_t i : {0U, 4U}) EXPECT_TRUE(all[i].good && all[i].text == "well") << i;
  for (const std::size_t i : {1U, 2U}) EXPECT_TRUE(!all[i].good && all[i].text == "it crashed") << i;
  EXPECT_FALSE(all[3].good);
  EXPECT_EQ(all[3].text, "no world");
}

TEST(Children, do_not_write_again_what_waited_to_be_written) {
  testing::internal::CaptureStdout();
  std::printf("row ");
  const auto all = answers(6, 3, [](std::size_t) {
    std::cout << "trace " << std::flush;
    std::fflush(stdout);
    return "";
  });
  const std::string out = testing::internal::GetCapturedStdout();
  EXPECT_EQ(all.size(), 6U);
  EXPECT_EQ(out, "row trace trace trace trace trace trace ");
}

TEST(Children, are_waited_for_though_whoever_started_the_program_ignored_them) {
  std::signal(SIGCHLD, SIG_IGN);
  const auto all = answers(3, 2, [](std::size_t index) { return std::to_string(index); });
  ASSERT_EQ(all.size(), 3U);
  EXPECT_TRUE(all[2].good);
}

TEST(Children, of_no_work_are_none) { EXPECT_TRUE(answers(0, 4, nullptr).empty()); }

}  // namespace
}  // namespace navvi_files
