#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace navvi_study::trial {

/// Rosbag's own recorder as a child process that cannot outlive this one. A second witness of the
/// trial, never the record: its failure is reported, nothing depends on it.
class BagRecorder {
 public:
  /// Starts recording `topics` into `bag` (a path that ends in .bag). \param node_name  the
  /// recorder's name in the graph
  BagRecorder(const std::filesystem::path& bag, const std::string& node_name,
              const std::vector<std::string>& topics,
              const std::string& program = "/usr/lib/rosbag/record");
  /// Stops it; kills it if it does not stop within two seconds.
  ~BagRecorder();
  BagRecorder(const BagRecorder&) = delete;
  BagRecorder& operator=(const BagRecorder&) = delete;

  /// Whether the process lives.
  [[nodiscard]] bool running();
  /// Whether it is stopped by a signal: what comes meanwhile is not recorded for sure.
  [[nodiscard]] bool halted() const;
  /// bytes written so far; 0 while there is no file
  [[nodiscard]] std::uintmax_t size() const;
  /// Asks it to close the bag; running() turns false when it has.
  void stop();
  void kill();
  /// It was asked to stop, did so by itself, and left a bag that is not empty.
  [[nodiscard]] bool closed_well();

 private:
  std::filesystem::path bag_;
  pid_t child_ = -1;
  bool asked_ = false;
  int status_ = -1;
};

}  // namespace navvi_study::trial
