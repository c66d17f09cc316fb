#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace navvi_files {

struct Answer {
  bool good = false;
  std::string text;  ///< the result of the work, or a sentence on what went wrong
};

/// Runs `work` in a child process: a crash ends only the child. The text of an exception becomes
/// that of an answer that is not good. \param crashed  the text after a crash
[[nodiscard]] Answer run_in_child(const std::function<std::string()>& work,
                                  const std::string& crashed);

/// Runs work(0) to work(count - 1), each in a child process as run_in_child does, at most `at_once`
/// at a time, and passes the answers on in order. All are forked from the calling thread, which
/// must be the only one that forks, waits for children or writes to standard output meanwhile.
void run_in_children(std::size_t count, std::size_t at_once,
                     const std::function<std::string(std::size_t)>& work,
                     const std::string& crashed,
                     const std::function<void(std::size_t, const Answer&)>& answered);

}  // namespace navvi_files
