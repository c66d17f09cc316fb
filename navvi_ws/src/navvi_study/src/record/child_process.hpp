#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace navvi_study::record {

struct Answer {
  bool good = false;
  std::string text;  ///< what the work gave, or a sentence on what went wrong
};

/// Does `work` in a child process: where it crashes, only the child is gone. What the work throws
/// becomes the text of an answer that is not good. \param crashed  the text after a crash
[[nodiscard]] Answer ask_child(const std::function<std::string()>& work,
                               const std::string& crashed);

/// Does work(0) to work(count - 1), each in a child process as ask_child does, at most `at_once` at
/// a time, and hands each answer over when all before it have been. All are forked from the thread
/// that calls, which must be the only one that forks or writes to standard output meanwhile.
void ask_children(std::size_t count, std::size_t at_once,
                  const std::function<std::string(std::size_t)>& work, const std::string& crashed,
                  const std::function<void(std::size_t, const Answer&)>& answered);

/// rosbag's reader may crash on a damaged file.
inline constexpr const char* kBagCrashed = "the bag is damaged: its reader crashed";

}  // namespace navvi_study::record
