#include "navvi_study/trial_node.hpp"

#include <navvi_msgs/TrialEvent.h>
#include <ros/callback_queue.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <stdexcept>

#include "navvi_study/metrics.hpp"
#include "navvi_study/msg_conversion.hpp"
#include "navvi_study/trial_folder.hpp"

namespace navvi_study {
namespace fs = std::filesystem;
namespace {

constexpr double kStep = 0.05;          // s, of the wall timer
constexpr double kSayAgain = 5.0;       // s, between sentences on what is missing
constexpr double kRefuseAfter = 60.0;   // s, without what a trial needs
constexpr double kSimulatorLost = 5.0;  // s, without odometry
constexpr double kGuidanceLost = 10.0;  // s, wall clock
constexpr double kBagStart = 6.0;       // s, for the recorder to listen
constexpr double kSettle = 0.5;         // s, for links to come up before the first event
constexpr double kBagStill = 3.0;       // s, without growth
constexpr double kBagClose = 8.0;       // s, for the recorder to close the bag
constexpr double kDrain = 0.3;          // s, for reports on their way when a trial ends
constexpr double kGoalAgain = 2.0;      // s, before a goal is sent again
constexpr int kGoalTries = 3;
constexpr std::int64_t kTimeBack = 1'000'000'000;  // ns
constexpr std::uint32_t kQueue = 1000;

const std::vector<std::string> kRecorded = {"/clock",
                                            "/tf",
                                            "/tf_static",
                                            "odom",
                                            "octomap_binary",
                                            "navvi/scene",
                                            "navvi/scene_moving",
                                            "navvi/obstacles",
                                            "navvi/proximity",
                                            "navvi/contacts",
                                            "navvi/path",
                                            "navvi/guidance",
                                            "navvi/navmesh",
                                            "navvi/markers",
                                            "navvi/cues",
                                            "navvi/scenario",
                                            "navvi/drive_state",
                                            "navvi/applied_commands",
                                            "navvi/state_hash",
                                            "cmd_vel",
                                            "joy",
                                            "joy/set_feedback",
                                            "move_base_simple/goal",
                                            "/diagnostics",
                                            "navvi/events"};

double wall() { return ros::SteadyTime::now().toSec(); }
std::int64_t mono_ns() { return static_cast<std::int64_t>(ros::SteadyTime::now().toNSec()); }
std::int64_t sim_ns() { return static_cast<std::int64_t>(ros::Time::now().toNSec()); }

std::string list_of(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void refuse_control_characters(const char* name, const std::string& text) {
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); })) {
    throw std::runtime_error(std::string(name) + " may hold no control characters");
  }
}

/// Letters, digits, - and _, such as sub-01, so that names do not slip into the record.
void refuse_all_but_pseudonyms(const std::string& text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_';
  });
  if (text == "n/a" || (plain && !text.empty() && text.size() <= 32)) return;
  throw std::runtime_error("participant is \"" + text +
                           "\"; allowed are up to 32 letters, digits, - and _, such as sub-01");
}

}  // namespace

TrialNode::TrialNode(const TrialNodeConfig& config)
    : config_(config), readiness_(config.require), monitor_(config.monitor) {
  refuse_control_characters("operator", config_.operator_kind);
  refuse_control_characters("profile", config_.profile);
  refuse_all_but_pseudonyms(config_.participant);
  if (config_.out.empty()) throw std::runtime_error("out names no folder");
  config_.out = fs::absolute(config_.out).lexically_normal().string();
  for (const auto& sentence : recover_trials(config_.out)) ROS_WARN("%s", sentence.c_str());
  subscribe();
  phase_since_ = said_ = wall();
  timer_ = node_.createWallTimer(ros::WallDuration(kStep), [this](auto&) { step(); });
}

template <typename Message>
void TrialNode::listen(const std::string& topic) {
  subscribers_.push_back(node_.subscribe<Message>(
      topic, kQueue,
      [this, topic](const typename Message::ConstPtr& msg) {
        if (const auto report = from_msg(*msg)) {
          take(*report);
        } else {
          ROS_WARN_THROTTLE(5.0, "a bad message on %s was dropped", topic.c_str());
        }
      },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
}

void TrialNode::subscribe() {
  recorder_name_ = ros::this_node::getName().substr(1) + "_recorder";
  std::replace(recorder_name_.begin(), recorder_name_.end(), '/', '_');
  events_ = node_.advertise<navvi_msgs::TrialEvent>(
      "navvi/events", kQueue, [this](const ros::SingleSubscriberPublisher& link) {
        const std::string& name = link.getSubscriberName();
        if (name.size() >= recorder_name_.size() &&
            name.compare(name.size() - recorder_name_.size(), name.npos, recorder_name_) == 0) {
          recorder_listens_ = true;
          phase_since_ = wall();
        }
      });
  goals_ = node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
  listen<navvi_msgs::Contact>("navvi/contacts");
  listen<navvi_msgs::Proximity>("navvi/proximity");
  listen<navvi_msgs::Cue>("navvi/cues");
  listen<navvi_msgs::DriveState>("navvi/drive_state");
  listen<navvi_msgs::StateHash>("navvi/state_hash");
  const auto hints = ros::TransportHints().tcpNoDelay();
  subscribers_.push_back(node_.subscribe("odom", kQueue, &TrialNode::on_odometry, this, hints));
  subscribers_.push_back(
      node_.subscribe("navvi/guidance", kQueue, &TrialNode::on_guidance, this, hints));
  subscribers_.push_back(
      node_.subscribe("/diagnostics", kQueue, &TrialNode::on_diagnostics, this, hints));
  subscribers_.push_back(node_.subscribe("move_base_simple/goal", 10, &TrialNode::on_goal, this));
  subscribers_.push_back(node_.subscribe("navvi/scenario", 1, &TrialNode::on_scenario, this));
}

template <typename Report>
void TrialNode::take(const Report& report) {
  for (const auto& event : monitor_.observe(report)) {
    if (active()) record(event);
  }
  // At once: a report that is stamped later may be the next to come.
  if (phase_ != Phase::running) return;
  if (monitor_.reached()) {
    end("reached", "goal_reached", monitor_.latest());
  } else if (const auto why = monitor_.refused()) {
    end("refused", *why, monitor_.latest());
  }
}

void TrialNode::on_odometry(const nav_msgs::Odometry::ConstPtr& msg) {
  const auto report = from_msg(*msg);
  if (!report) {
    ROS_WARN_THROTTLE(5.0, "a bad odometry message was dropped");
    return;
  }
  readiness_.saw_odometry(wall());
  take(*report);
}

void TrialNode::on_guidance(const navvi_msgs::Guidance::ConstPtr& msg) {
  const auto report = from_msg(*msg);
  if (!report) {
    ROS_WARN_THROTTLE(5.0, "a bad guidance message was dropped");
    return;
  }
  readiness_.saw(*report, wall());
  take(*report);
}

void TrialNode::on_diagnostics(const diagnostic_msgs::DiagnosticArray::ConstPtr& msg) {
  for (const auto& report : from_msg(*msg)) {
    readiness_.saw(report);
    take(report);
  }
}

void TrialNode::on_goal(const ros::MessageEvent<geometry_msgs::PoseStamped const>& event) {
  if (event.getPublisherName() == ros::this_node::getName()) return;
  const auto goal = from_msg(*event.getConstMessage());
  if (!goal) {
    ROS_WARN_THROTTLE(5.0, "a bad goal was dropped");
    return;
  }
  if (phase_ == Phase::armed && (!scenario_ || scenario_played_)) {
    start(*goal);
  } else if (phase_ == Phase::running) {
    goal_ = *goal;
    goal_sent_ = kGoalTries;
    goal_sent_at_ = wall();
    record(monitor_.change_goal(*goal, std::max(sim_ns(), monitor_.latest())));
  }
}

void TrialNode::on_scenario(const navvi_msgs::Scenario::ConstPtr& msg) {
  scenario_ = *msg;
  if (!active()) scenario_played_ = false;
}

std::vector<std::string> TrialNode::missing() const {
  return readiness_.missing(wall(), sim_ns() != 0);
}

void TrialNode::step() {
  switch (phase_) {
    case Phase::waiting:
      return wait();
    case Phase::armed:
      return try_to_start();
    case Phase::running:
      return watch();
    case Phase::draining:
      if (wall() - phase_since_ >= kDrain) write_end();
      return;
    case Phase::closing:
      return close();
    case Phase::done:
      return;
  }
}

void TrialNode::wait() {
  const auto words = missing();
  if (words.empty()) return arm();
  const double now = wall();
  if (config_.once && now - phase_since_ > kRefuseAfter) {
    ROS_FATAL("No trial: after %.0f s what is missing is still %s.", kRefuseAfter,
              list_of(words).c_str());
    return leave(3);
  }
  if (now - said_ < kSayAgain) return;
  said_ = now;
  ROS_WARN("No trial yet: waiting for %s.", list_of(words).c_str());
}

void TrialNode::arm() {
  try {
    folder_ = create_trial_folder(config_.out, std::time(nullptr));
    journal_ = std::make_unique<Journal>(folder_, folder_.filename().string());
  } catch (const std::runtime_error& error) {
    ROS_FATAL("%s", error.what());
    return leave(3);
  }
  bag_bad_ = recorder_listens_ = false;
  bag_size_ = 0;
  if (config_.record) {
    std::vector<std::string> topics;
    for (const auto& topic : kRecorded) topics.push_back(node_.resolveName(topic));
    recorder_ = std::make_unique<BagRecorder>(folder_ / "trial.bag", recorder_name_, topics);
  }
  phase_ = Phase::armed;
  phase_since_ = said_ = bag_grew_ = wall();
}

void TrialNode::try_to_start() {
  const double now = wall();
  if (recorder_ && !bag_bad_) {
    if (!recorder_->running() || (!recorder_listens_ && now - phase_since_ > kBagStart)) {
      ROS_ERROR("The bag recorder does not record. The trial goes on without a bag.");
      bag_bad_ = true;
    } else if (!recorder_listens_) {
      return;
    }
  }
  if (now - phase_since_ < kSettle) return;
  if (scenario_ && !scenario_played_) {
    const auto words = missing();
    if (words.empty()) {
      scenario_played_ = true;
      return start({scenario_->goal.x, scenario_->goal.y});
    }
    if (now - said_ >= kSayAgain) {
      said_ = now;
      ROS_WARN("No trial yet: waiting for %s.", list_of(words).c_str());
    }
  } else if (now - said_ >= 6 * kSayAgain) {
    said_ = now;
    ROS_INFO("Ready for a trial: waiting for a goal.");
  }
}

void TrialNode::start(const Point2& goal) {
  goal_ = goal;
  const TrialStart beginning = monitor_.start_now(sim_ns(), goal);
  start_stamp_ = beginning.stamp;
  monitor_.start(beginning);
  const auto limit = static_cast<std::int64_t>(config_.limit * 1e9);
  if (limit > 0) monitor_.end(start_stamp_ + limit);
  result_.clear();
  reason_.clear();
  goal_sent_ = 0;
  goal_stood_ = false;
  goal_sent_at_ = wall();
  phase_ = Phase::running;
  phase_since_ = bag_grew_ = wall();
  Fields fields;
  fields.set("world", scenario_ ? scenario_->world : "n/a");
  fields.set("world_hash", scenario_ ? scenario_->world_hash : "n/a");
  fields.set("seed", scenario_ ? std::to_string(scenario_->seed) : "n/a");
  fields.set("operator", config_.operator_kind).set("participant", config_.participant);
  fields.set("profile", config_.profile);
  for (const char* device : {"audio", "pad"}) fields.set(device, readiness_.state_of(device));
  fields.set("goal_x", goal.x, 6).set("goal_y", goal.y, 6).set("limit", config_.limit);
  fields.set("contact_seq", std::uint64_t{beginning.contact_seq});
  fields.set("shelf_contacts", beginning.shelf_count);
  fields.set("obstacle_contacts", beginning.obstacle_count);
  const TrialMonitorConfig& monitor = config_.monitor;
  fields.set("obstacle_range", monitor.obstacle_range).set("shelf_range", monitor.shelf_range);
  fields.set("leave_margin", monitor.leave_margin).set("leave_time", monitor.leave_time);
  fields.set("center_range", monitor.center_range);
  if (!record({"TRIAL_START", fields, start_stamp_})) return;
  Fields where;
  where.set("goal_x", goal.x, 6).set("goal_y", goal.y, 6);
  if (!record({"GOAL_SET", where, start_stamp_})) return;
  ROS_INFO("Trial %s has begun: goal at %.2f, %.2f.", folder_.filename().c_str(), goal.x, goal.y);
  ask_for_goal();
}

void TrialNode::ask_for_goal() {
  if (monitor_.goal_taken() || (goal_sent_ > 0 && wall() - goal_sent_at_ < kGoalAgain)) return;
  if (goal_sent_ >= kGoalTries) {
    ROS_ERROR("The goal was set %d times, but the guidance does not show it.", kGoalTries);
    return end("aborted", "goal_not_taken", monitor_.latest());
  }
  ++goal_sent_;
  goal_sent_at_ = wall();
  goals_.publish(goal_msg(goal_, ros::Time::now()));
}

void TrialNode::watch() {
  const std::int64_t now = sim_ns();
  watch_bag();
  if (journal_->reserve_used()) return end("invalid", "disk_full", monitor_.latest());
  if (monitor_.world_restarted()) return end("aborted", "simulator_restarted", monitor_.latest());
  if (now + kTimeBack < monitor_.latest())
    return end("aborted", "time_went_back", monitor_.latest());
  if (readiness_.silence(wall()) > kSimulatorLost) {
    return end("aborted", "simulator_lost", monitor_.latest());
  }
  if (readiness_.guidance_silence(wall()) > kGuidanceLost) {
    return end("aborted", "guidance_lost", monitor_.latest());
  }
  const auto limit = static_cast<std::int64_t>(config_.limit * 1e9);
  if (limit > 0 && now - start_stamp_ >= limit) {
    return end("timeout", "limit", start_stamp_ + limit);
  }
  // A guidance that was started anew knows no goal: it is asked again, with all tries.
  if (goal_stood_ && !monitor_.goal_taken()) goal_sent_ = 0;
  goal_stood_ = monitor_.goal_taken();
  ask_for_goal();
}

void TrialNode::watch_bag() {
  if (!recorder_ || bag_bad_) return;
  const auto size = recorder_->size();
  if (size > bag_size_) {
    bag_size_ = size;
    bag_grew_ = wall();
  }
  if (recorder_->running() && wall() - bag_grew_ < kBagStill) return;
  bag_bad_ = true;
  ROS_ERROR("The bag does not grow. The trial goes on; its summary says bag=bad.");
  record({"BAG_LOST", Fields(), monitor_.latest()});
}

void TrialNode::end(const std::string& result, const std::string& reason, std::int64_t stamp) {
  if (!active()) return;
  monitor_.end(stamp);
  result_ = result;
  reason_ = reason;
  end_stamp_ = *monitor_.ended();
  phase_ = Phase::draining;
  phase_since_ = wall();
}

void TrialNode::write_end() {
  // The goal may have been reached just before the end that was called first.
  if (monitor_.reached() && result_ != "invalid") {
    result_ = "reached";
    reason_ = "goal_reached";
  }
  if (journal_->reserve_used()) result_ = "invalid";
  Fields fields = monitor_.tally_fields();
  fields.set("result", result_).set("reason", reason_);
  phase_ = Phase::closing;
  phase_since_ = wall();
  record({"TRIAL_END", fields, end_stamp_});
  write_summary();
}

bool TrialNode::record(const Event& event) {
  if (journal_->broken()) return false;
  const auto row = journal_->append(event.type, event.fields, event.sim_ns, mono_ns(),
                                    event.essential ? Durability::essential : Durability::relaxed);
  if (row) {
    events_.publish(to_msg(*row));
    return true;
  }
  ROS_FATAL("%s. The trial is invalid.", journal_->problem().c_str());
  exit_code_ = 4;
  phase_ = Phase::closing;
  phase_since_ = wall();
  write_summary();
  return false;
}

void TrialNode::write_summary() {
  auto rows = journal_->rows();
  if (journal_->broken()) {
    Row last = rows.empty() ? Row{folder_.filename().string(), 0, 0, 0, "", {}} : rows.back();
    last.type = "TRIAL_END";
    last.fields = Fields().set("result", "invalid").set("reason", "journal_broken");
    rows.push_back(last);
  }
  if (const auto problem = write_results(folder_, rows)) {
    ROS_ERROR("%s", problem->c_str());
    exit_code_ = 4;
  }
}

void TrialNode::close() {
  const double age = wall() - phase_since_;
  if (recorder_ && recorder_->running()) {
    const double tail = shutting_down_ ? kDrain : std::max(kDrain, config_.tail);
    if (age < tail) return;
    recorder_->stop();
    if (age > tail + kBagClose) recorder_->kill();
    return;
  }
  finish();
}

void TrialNode::finish() {
  std::string bag = "none";
  if (recorder_) bag = recorder_->closed_well() && !bag_bad_ ? "ok" : "bad";
  recorder_.reset();
  if (!journal_->broken()) {
    record({"BAG_CLOSED", Fields().set("state", bag), end_stamp_});
    write_summary();
  }
  std::string screen = "Trial ended: " + folder_.string();
  for (const auto& [name, cell] : summarize(journal_->rows()))
    screen += "\n  " + name + ": " + cell;
  ROS_INFO("%s", screen.c_str());
  journal_.reset();
  phase_ = Phase::waiting;
  phase_since_ = said_ = wall();
  if (config_.once || exit_code_ != 0) leave(exit_code_);
}

void TrialNode::leave(int exit_code) {
  exit_code_ = exit_code;
  phase_ = Phase::done;
  ros::shutdown();
}

void TrialNode::shut_down() {
  shutting_down_ = true;
  if (phase_ == Phase::armed) {
    recorder_.reset();
    journal_.reset();
    std::error_code error;
    fs::remove_all(folder_, error);  // no trial has begun: nothing is lost
    return leave(0);
  }
  if (phase_ == Phase::running) end("aborted", "stopped_by_signal", monitor_.latest());
  const double begun = wall();
  while (phase_ == Phase::draining && wall() - begun < kDrain) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
  }
  if (phase_ == Phase::draining) write_end();
  while (phase_ == Phase::closing) {
    if (recorder_ && wall() - begun > 1.5) recorder_->kill();
    close();
    ros::WallDuration(0.02).sleep();
  }
  leave(exit_code_);
}

}  // namespace navvi_study
