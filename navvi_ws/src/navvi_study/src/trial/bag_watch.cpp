#include "trial/bag_watch.hpp"

namespace navvi_study::trial {
namespace {

constexpr double kStart = 60.0;  // s, for the recorder to listen: it asks the master for each topic in turn, which may be far
constexpr double kSettle = 0.5;  // s, for links to come up before the first event
constexpr double kStill = 10.0;  // s, without growth; a compressed bag grows by whole chunks
constexpr double kHalted = 2.0;  // s, in which a recorder may be stopped by a signal
constexpr double kClose = 8.0;   // s, for the recorder to close the bag

}  // namespace

void BagWatch::hears(double time) {
  listens_ = true;
  begun_ = time;
}

bool BagWatch::ready(double time) {
  if (recorder_ && !bad_) {
    if (!recorder_->running() || (!listens_ && time - begun_ > kStart)) {
      bad_ = true;
    } else if (!listens_) {
      return false;
    }
  }
  return time - begun_ >= kSettle;
}

bool BagWatch::growing(double time) {
  if (!recorder_ || bad_) return !bad_;
  const auto size = recorder_->size();
  if (size > size_) {
    size_ = size;
    grew_ = time;
  }
  if (!recorder_->halted()) went_on_ = time;
  bad_ = !recorder_->running() || time - grew_ >= kStill || time - went_on_ >= kHalted;
  return !bad_;
}

bool BagWatch::close(double age, double tail) {
  if (!recorder_ || !recorder_->running()) return true;
  if (age >= tail) recorder_->stop();
  if (age > tail + kClose) recorder_->kill();
  return false;
}

void BagWatch::kill() {
  if (recorder_) recorder_->kill();
}

std::string BagWatch::verdict() {
  if (!recorder_) return "none";
  return recorder_->closed_well() && !bad_ ? "ok" : "bad";
}

}  // namespace navvi_study::trial
