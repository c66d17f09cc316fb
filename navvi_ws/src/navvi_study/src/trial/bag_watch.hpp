#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace navvi_study::trial {

/// Rosbag's own recorder as a child process that cannot outlive this one. A second witness of the
/// trial, never the record: its failure is reported, nothing depends on it.
class BagRecorder {
 public:
  /// Starts recording `topics` into `bag` (a path that ends in .bag). \param node_name  the
  /// recorder's name in the graph \param program  and the words before those of rosbag's record
  /// \param patience  s, in which it closes a bag or goes on to write it
  BagRecorder(const std::filesystem::path& bag, const std::string& node_name,
              const std::vector<std::string>& topics,
              const std::vector<std::string>& program = {"/usr/lib/rosbag/record"},
              double patience = 8.0);
  /// Stops it; kills it if it does not stop within two seconds.
  ~BagRecorder();
  BagRecorder(const BagRecorder&) = delete;
  BagRecorder& operator=(const BagRecorder&) = delete;

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
  [[nodiscard]] double patience() const { return patience_; }

 private:
  std::filesystem::path bag_;
  double patience_;  ///< s
  pid_t child_ = -1;
  bool asked_ = false;
  int status_ = -1;
};

/// Watches over a recorder: whether it began to listen, and whether its bag grows. Times are s,
/// monotonic.
class BagWatch {
 public:
  BagWatch() = default;
  /// \param recorder  none where no bag is wanted
  BagWatch(std::unique_ptr<BagRecorder> recorder, double time)
      : recorder_(std::move(recorder)), begun_(time), grew_(time), went_on_(time) {}

  /// The recorder has opened its links.
  void hears(double time);
  /// Whether a trial may begin: the recorder listens and its links had time to settle, or there
  /// will be no bag.
  [[nodiscard]] bool ready(double time);
  /// False from the moment on that the bag is lost. Nothing depends on it but the record's word.
  [[nodiscard]] bool growing(double time);
  /// What growth is measured from.
  void expect_growth(double time) { grew_ = went_on_ = time; }
  /// Stops the recorder once `tail` s have passed, kills it if it does not end and writes nothing.
  /// \param age  s since the end of the trial \return whether it has gone
  [[nodiscard]] bool close(double age, double tail);
  void kill();
  /// After close(): ok, bad, or none where none was wanted.
  [[nodiscard]] std::string verdict();

 private:
  std::unique_ptr<BagRecorder> recorder_;
  double begun_ = 0.0;
  bool listens_ = false;
  bool bad_ = false;
  std::uintmax_t size_ = 0;
  double grew_ = 0.0;
  double wrote_ = 0.0;    ///< s since the end of the trial
  double went_on_ = 0.0;  ///< when the recorder was last seen not to be halted
};

}  // namespace navvi_study::trial
