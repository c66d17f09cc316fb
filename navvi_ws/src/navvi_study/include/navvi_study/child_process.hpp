#pragma once

#include <functional>
#include <string>

namespace navvi_study {

struct Answer {
  bool good = false;
  std::string text;  ///< what the work gave, or a sentence on what went wrong
};

/// Does `work` in a child process: where it crashes, only the child is gone. What the work throws
/// becomes the text of an answer that is not good. \param crashed  the text after a crash
[[nodiscard]] Answer ask_child(const std::function<std::string()>& work,
                               const std::string& crashed);

/// rosbag's reader may crash on a damaged file.
inline constexpr const char* kBagCrashed = "the bag is damaged: its reader crashed";

}  // namespace navvi_study
