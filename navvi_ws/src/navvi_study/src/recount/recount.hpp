#pragma once

#include <filesystem>
#include <vector>

#include "record/row.hpp"

namespace navvi_study::recount {

/// Reads a bag and lets the same monitor observe it again. Only the start, the goals and the end
/// are taken from navvi/events; what happened between is recounted from the other topics. \throws
/// std::runtime_error with a sentence if the bag holds no whole trial. Rosbag's reader can crash on
/// a damaged file: call this in a child process.
[[nodiscard]] std::vector<record::Row> rows_from_bag(const std::filesystem::path& bag);

}  // namespace navvi_study::recount
