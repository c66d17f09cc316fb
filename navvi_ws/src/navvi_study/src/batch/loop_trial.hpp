#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <navvi_people/loop/closed_loop.hpp>
#include <vector>

#include "record/figures.hpp"
#include "trial/conditions.hpp"
#include "trial/tracker.hpp"
#include "trial/trial_flow.hpp"
#include "trial/trial_monitor.hpp"

namespace navvi_study::batch {

using navvi_people::loop::ClosedLoop;

class LoopBag;

/// Watches the trial that a closed loop is, as trial_node watches a live one.
class LoopTrial {
 public:
  /// \param config  limit, and what the record is to say \param loop  lasts as long
  /// \param phrases  as the loop's
  LoopTrial(trial::TrialNodeConfig config, const ClosedLoop& loop, std::filesystem::path phrases);
  ~LoopTrial();

  /// Before the first step: the record will be that of a live trial, with its bag, in a folder.
  /// \param folder  is made, and bears the trial's name \param utc_ns  of the calendar, now
  /// \throws std::exception with a sentence
  void keep(const std::filesystem::path& folder, std::int64_t utc_ns);
  /// Call it after every step of the loop. \return whether the trial goes on
  [[nodiscard]] bool watch();
  /// Once it is over. \throws std::runtime_error with a sentence if it was to be kept and is not
  [[nodiscard]] const record::Trial& finish();

 private:
  void begin();
  void end(const trial::Ending& ending);
  void push(const trial::Event& event);
  template <typename Report>
  void observe(const Report& report);
  template <typename Message>
  void observe_all(const std::vector<Message>& messages);
  [[nodiscard]] trial::Ending ending() const;
  [[nodiscard]] std::int64_t now() const { return loop_.session().world().now().stamp(); }

  trial::TrialNodeConfig config_;
  const ClosedLoop& loop_;
  std::filesystem::path phrases_;
  trial::TrialMonitor monitor_;
  trial::Tracker tracker_;
  trial::TrialFlow flow_;
  trial::TrialStart start_;
  bool begun_ = false;
  std::size_t hashes_ = 0;     ///< of the world, that the monitor knows
  std::size_t published_ = 0;  ///< rows in the bag
  record::Trial seen_;
  std::filesystem::path folder_;  ///< empty: nothing is kept
  std::int64_t utc_ns_ = 0;       ///< of the calendar, when the world began
  std::unique_ptr<LoopBag> bag_;
};

}  // namespace navvi_study::batch
