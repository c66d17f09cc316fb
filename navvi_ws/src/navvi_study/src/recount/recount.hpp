#pragma once

#include <filesystem>

#include "record/figures.hpp"

namespace navvi_study::recount {

/// Reads a bag and lets the same monitor observe it again. Only the start, the goals and the end
/// are taken from navvi/events; what happened between is recounted from the other topics. \throws
/// std::runtime_error with a sentence if the bag holds no whole trial. Rosbag's reader can crash on
/// a damaged file: call this in a child process.
/// \param phrases  folder of the files of what is spoken
[[nodiscard]] record::Trial trial_from_bag(const std::filesystem::path& bag,
                                           const std::filesystem::path& phrases);

}  // namespace navvi_study::recount
