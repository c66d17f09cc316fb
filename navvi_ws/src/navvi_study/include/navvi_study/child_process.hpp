#pragma once

#include <functional>
#include <string>

namespace navvi_study {

struct Answer {
  bool good = false;
  std::string text;  ///< what the work gave, or a sentence on what went wrong
};

/// Does `work` in a child process: rosbag's reader may crash on a damaged file, and then only the
/// child is gone. What the work throws becomes the text of an answer that is not good.
[[nodiscard]] Answer ask_child(const std::function<std::string()>& work);

}  // namespace navvi_study
