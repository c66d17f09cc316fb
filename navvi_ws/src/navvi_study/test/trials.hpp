#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "temp_folder.hpp"
#include "trial/trial_keeper.hpp"

// For tests: trials of a scripted person, without ROS.

namespace navvi_study::trial {

namespace fs = std::filesystem;
using State = Guidance::State;

inline const Scenario kScenario{"hall", "0123456789abcdef", 7, {5.0, 2.0}};

/// A keeper in a world of its own, whose clocks run together.
class Trials : public testing::Test {
 protected:
  Trials() {
    config_.out = folder_.string();
    config_.record = "none";
    config_.operator_kind = "keyboard";
  }
  void begin() {
    TrialKeeper::Outlets outlets;
    outlets.publish = [this](const record::Row& row) {
      EXPECT_NE(content("journal.csv").find(row.type), std::string::npos) << "not on the disk";
      events_.push_back(row.type);
      if (published_) published_(row);
    };
    outlets.set_goal = [this](const ChosenGoal& goal) {
      goals_.push_back(goal.place);
      stamps_.push_back(goal.stamp);
    };
    outlets.show = [this](const TrialState& now) {
      shown_.push_back(now.state);
      waits_ = now;
    };
    outlets.tell = [this](TrialKeeper::Tone, const std::string& words) { said_ += words + "\n"; };
    outlets.settings = [this] { return settings_; };
    outlets.hears_contacts = [this] { return contacts_; };
    outlets.start_recorder = [this](const fs::path& bag) {
      const fs::path program = folder_.write("record", "#!/bin/sh\nexec sleep 60\n");
      fs::permissions(program, fs::perms::owner_all);
      return std::make_unique<BagRecorder>(bag, "recorder", std::vector<std::string>{},
                                           std::vector<std::string>{program.string()});
    };
    navvi_files::SystemCalls calls = calls_;
    calls.write = [this, write = calls.write](int file, const void* bytes, std::size_t count) {
      if (failures_ == 0) return write(file, bytes, count);
      --failures_;
      errno = error_;
      return ssize_t{-1};
    };
    keeper_ = std::make_unique<TrialKeeper>(config_, outlets, now(), calls);
  }
  [[nodiscard]] Moment now() const {
    const auto ns = static_cast<std::int64_t>(1e9 * time_);
    return {1'000'000'000'000 + ns, ns, 1'700'000'000'000'000'000 + set_ + ns};
  }
  void guide(State state, const Eigen::Vector2d& goal) {
    Guidance report;
    report.stamp = now().ros_ns;
    report.seq = ++guidance_;
    report.state = state;
    report.goal = goal;
    report.plans = plans_;
    report.replan_reason = Guidance::Replan::new_goal;
    keeper_->take(report, now());
  }
  /// With a world that asks for a trial.
  void offer() {
    begin();
    keeper_->take(kScenario, now());
  }
  /// For a second, so that it runs, and a second of it.
  void run() {
    offer();
    live(1.0);
    live(1.0, State::following, kScenario.goal);
  }
  /// Start, or the end.
  void press(TrialRequest::Kind kind = TrialRequest::Kind::begin) {
    keeper_->take(TrialRequest{kind, now().ros_ns}, now());
  }
  void report(const std::string& device) {
    keeper_->take(DeviceReport{now().ros_ns, device, DeviceState::works}, now());
  }
  /// So many s in which all nodes report.
  void live(double seconds, State state = State::no_goal,
            const Eigen::Vector2d& goal = Eigen::Vector2d::Zero()) {
    for (const double end = time_ + seconds; time_ < end && !keeper_->done();) {
      time_ += 0.05;
      const bool there = state == State::arrived && !elsewhere_;
      keeper_->take(Odometry{now().ros_ns, {there ? goal : Eigen::Vector2d(time_, 0.0)}}, now());
      guide(state, goal);
      if (feedback_) report("latency");
      keeper_->step(now());
    }
  }
  /// So many s in which none does.
  void wait(double seconds) {
    for (const double end = time_ + seconds; time_ < end && !keeper_->done();) {
      time_ += 0.05;
      keeper_->step(now());
    }
  }
  [[nodiscard]] std::vector<fs::path> folders() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(config_.out))
      if (entry.is_directory()) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }
  /// Of a file of the latest trial.
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folders().back() / name).rdbuf();
    return text.str();
  }
  [[nodiscard]] testing::AssertionResult holds(const std::string& name,
                                               const std::string& words) const {
    return found(content(name), words);
  }
  [[nodiscard]] testing::AssertionResult said(const std::string& words) const {
    return found(said_, words);
  }
  [[nodiscard]] std::ptrdiff_t times(const std::string& type) const {
    return std::count(events_.begin(), events_.end(), type);
  }
  [[nodiscard]] bool happened(const std::string& type) const { return times(type) > 0; }

  static testing::AssertionResult found(const std::string& text, const std::string& words) {
    const bool there = text.find(words) != std::string::npos;
    return (there ? testing::AssertionSuccess() : testing::AssertionFailure()) << text;
  }

  navvi_test::TempFolder folder_;
  TrialNodeConfig config_;
  std::unique_ptr<TrialKeeper> keeper_;
  double time_ = 1.0;     // s, of ROS
  std::int64_t set_ = 0;  // ns, by which the calendar was set
  std::uint32_t guidance_ = 0;
  std::uint32_t plans_ = 1;
  std::vector<std::string> events_;
  std::vector<Eigen::Vector2d> goals_;
  std::vector<std::int64_t> stamps_;  ///< of these
  std::string said_;
  std::vector<TrialState::State> shown_;
  TrialState waits_;  ///< shown last
  bool contacts_ = true;    ///< something tells of them
  bool feedback_ = true;    ///< feedback_node reports
  bool elsewhere_ = false;  ///< the robot, where the guide says that it has arrived
  int failures_ = 0;        ///< writes of the journal that are still to fail
  int error_ = 0;           ///< with this errno
  Settings settings_{{"sim/seed", "3"}};
  navvi_files::SystemCalls calls_ = navvi_files::SystemCalls::real();
  std::function<void(const record::Row&)> published_;
};

}  // namespace navvi_study::trial
