#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "trial/bag_recorder.hpp"

namespace navvi_study::trial {

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
  /// Stops the recorder once `tail` s have passed, kills it if it takes too long.
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
  double went_on_ = 0.0;  ///< when the recorder was last seen not to be halted
};

}  // namespace navvi_study::trial
