#pragma once

#include <filesystem>

#include "record/figures.hpp"

namespace navvi_study::recount {

/// What a bag tells of a trial.
struct Recounted {
  record::Trial trial;
  unsigned lost = 0;  ///< messages of odometry, between those that the bag holds
};

/// Reads a bag and lets the same monitor observe it again. Only the start, the goals and the end
/// are taken from navvi/events; what happened between is recounted from the other topics. \throws
/// std::runtime_error with a sentence if the bag holds no whole trial. Rosbag's reader can crash on
/// a damaged file: call this in a child process.
/// \param phrases  folder of the files of what is spoken
[[nodiscard]] Recounted trial_from_bag(const std::filesystem::path& bag,
                                       const std::filesystem::path& phrases);

}  // namespace navvi_study::recount
