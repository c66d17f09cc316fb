#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "types.hpp"

namespace navvi_feedback::person {

/// What could not be kept.
struct Failure {
  Content cue;         ///< that says so
  std::string detail;  ///< a sentence for the log, or empty
};

/// Saves items in a thread of its own, in their order: a disk may take seconds.
template <typename Item>
class Saver {
 public:
  /// Runs in that thread. It throws if it fails. Without one nothing is kept, which fails once.
  using Save = std::function<void(const std::vector<Item>&)>;

  Saver(Save save, Content failure) : save_(std::move(save)), failure_(failure) {}

  /// From the next update() on.
  void save(Item item) { unsaved_.push_back(std::move(item)); }

  /// To be called often; does not wait. \return what has failed since the last call
  [[nodiscard]] std::vector<Failure> update() {
    std::vector<Failure> failures;
    if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
      collect(failures);
    if (!save_ && !std::exchange(unsaved_, {}).empty() && !std::exchange(told_, true))
      failures.push_back({failure_, ""});
    if (!unsaved_.empty() && !saving_.valid())
      saving_ = std::async(std::launch::async,
                           [save = save_, items = std::exchange(unsaved_, {})] { save(items); });
    return failures;
  }

  [[nodiscard]] std::vector<Failure> finish() {
    std::vector<Failure> failures;
    while (saving_.valid() || !unsaved_.empty()) {
      if (saving_.valid()) collect(failures);
      for (Failure& failure : update()) failures.push_back(std::move(failure));
    }
    return failures;
  }

 private:
  void collect(std::vector<Failure>& failures) {
    try {
      saving_.get();
    } catch (const std::exception& error) {
      failures.push_back({failure_, error.what()});
    }
  }

  Save save_;
  Content failure_;
  std::vector<Item> unsaved_;
  std::future<void> saving_;
  bool told_ = false;  ///< that nothing is kept
};

}  // namespace navvi_feedback::person
