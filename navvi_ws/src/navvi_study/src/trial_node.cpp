#include "navvi_study/trial_node.hpp"

#include <navvi_msgs/TrialEvent.h>
#include <ros/callback_queue.h>

#include <algorithm>
#include <ctime>
#include <stdexcept>

#include "navvi_study/metrics.hpp"
#include "navvi_study/msg_conversion.hpp"
#include "navvi_study/trial_folder.hpp"

namespace navvi_study {
namespace fs = std::filesystem;
namespace {

constexpr double kStep = 0.05;     // s, of the wall timer
constexpr double kSayAgain = 5.0;  // s, between sentences on what is missing
constexpr double kDrain = 0.3;     // s, for reports on their way when a trial ends
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

}  // namespace

TrialNode::TrialNode(const TrialNodeConfig& config)
    : config_(config), readiness_(config.require), monitor_(config.monitor), flow_(config.limit) {
  check(config_);
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
          bag_.hears(wall());
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
  for (const bool for_good : {false, true})
    subscribers_.push_back(node_.subscribe<tf2_msgs::TFMessage>(
        for_good ? "/tf_static" : "/tf", kQueue,
        [this, for_good](const tf2_msgs::TFMessage::ConstPtr& msg) {
          on_transforms(*msg, for_good);
        },
        ros::VoidConstPtr(), hints));
  subscribers_.push_back(
      node_.subscribe("navvi/guidance", kQueue, &TrialNode::on_guidance, this, hints));
  subscribers_.push_back(
      node_.subscribe("/diagnostics", kQueue, &TrialNode::on_diagnostics, this, hints));
  subscribers_.push_back(node_.subscribe("move_base_simple/goal", 10, &TrialNode::on_goal, this));
  subscribers_.push_back(node_.subscribe("navvi/scenario", 1, &TrialNode::on_scenario, this));
  if (config_.operator_kind != "simulated") return;
  subscribers_.push_back(node_.subscribe<sensor_msgs::Joy>(
      "joy", 1, [this](const sensor_msgs::Joy::ConstPtr&) { operator_seen_ = wall(); }));
}

template <typename Report>
void TrialNode::take(const Report& report) {
  for (const auto& event : monitor_.observe(report)) {
    if (active()) record(event);
  }
  // At once: a report that is stamped later may be the next to come.
  if (phase_ != Phase::running) return;
  if (monitor_.reached()) {
    end({"reached", "goal_reached", monitor_.latest()});
  } else if (const auto why = monitor_.refused()) {
    end({"refused", *why, monitor_.latest()});
  }
}

void TrialNode::on_odometry(const nav_msgs::Odometry::ConstPtr& msg) {
  const auto report = from_msg(*msg);
  if (!report) {
    ROS_WARN_THROTTLE(5.0, "a bad odometry message was dropped");
    return;
  }
  readiness_.saw_odometry(wall());
  for (const auto& place : places_.take(*report)) take(place);
}

void TrialNode::on_transforms(const tf2_msgs::TFMessage& msg, bool for_good) {
  for (const auto& correction : from_msg(msg, for_good))
    for (const auto& place : places_.take(correction)) take(place);
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
    goal_tries_.sent_elsewhere(wall());
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
  // Who drives one trial after the other may take their time, but a robot must be there at all.
  const bool refuses = config_.once || !readiness_.saw_any_odometry();
  if (refuses && config_.patience > 0.0 && now - phase_since_ > config_.patience) {
    ROS_FATAL("No trial: after %.0f s what is missing is still %s.", config_.patience,
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
  std::unique_ptr<BagRecorder> recorder;
  if (config_.record) {
    std::vector<std::string> topics;
    for (const auto& topic : kRecorded) topics.push_back(node_.resolveName(topic));
    recorder = std::make_unique<BagRecorder>(folder_ / "trial.bag", recorder_name_, topics);
  }
  bag_ = BagWatch(std::move(recorder), wall());
  bag_lost_ = false;
  phase_ = Phase::armed;
  phase_since_ = said_ = wall();
}

void TrialNode::try_to_start() {
  const double now = wall();
  if (!bag_.ready(now)) return;
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
  flow_.start(start_stamp_);
  if (const auto deadline = flow_.deadline()) monitor_.end(*deadline);
  ending_ = Ending();
  goal_tries_.begin();
  phase_ = Phase::running;
  phase_since_ = operator_seen_ = wall();
  bag_.expect_growth(phase_since_);
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
  switch (goal_tries_.next(monitor_.goal_taken(), wall())) {
    case GoalTries::Next::wait:
      return;
    case GoalTries::Next::send:
      return goals_.publish(goal_msg(goal_, ros::Time::now()));
    case GoalTries::Next::give_up:
      ROS_ERROR("The goal was set several times, but the guidance does not show it.");
      return end({"aborted", "goal_not_taken", monitor_.latest()});
  }
}

void TrialNode::watch() {
  watch_bag();
  Signs signs;
  signs.now = sim_ns();
  signs.latest = monitor_.latest();
  signs.disk_full = journal_->reserve_used();
  signs.world_restarted = monitor_.world_restarted();
  signs.odometry_silence = readiness_.silence(wall());
  signs.guidance_silence = readiness_.guidance_silence(wall());
  if (config_.operator_kind == "simulated") signs.operator_silence = wall() - operator_seen_;
  if (const auto ending = flow_.watch(signs)) return end(*ending);
  ask_for_goal();
}

void TrialNode::watch_bag() {
  if (bag_lost_ || bag_.growing(wall())) return;
  bag_lost_ = true;
  ROS_ERROR("The bag does not grow. The trial goes on; its summary says bag=bad.");
  record({"BAG_LOST", Fields(), monitor_.latest()});
}

void TrialNode::end(const Ending& ending) {
  if (!active()) return;
  monitor_.end(ending.stamp);
  ending_ = ending;
  ending_.stamp = *monitor_.ended();
  phase_ = Phase::draining;
  phase_since_ = wall();
}

void TrialNode::write_end() {
  // The goal may have been reached just before the end that was called first.
  ending_ = TrialFlow::last_word(ending_, monitor_.reached().has_value(), journal_->reserve_used());
  Fields fields = monitor_.tally_fields();
  fields.set("result", ending_.result).set("reason", ending_.reason);
  phase_ = Phase::closing;
  phase_since_ = wall();
  record({"TRIAL_END", fields, ending_.stamp});
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
  const double tail = shutting_down_ ? kDrain : std::max(kDrain, config_.tail);
  if (bag_.close(wall() - phase_since_, tail)) finish();
}

void TrialNode::finish() {
  const std::string bag = bag_.verdict();
  bag_ = BagWatch();
  if (!journal_->broken()) {
    record({"BAG_CLOSED", Fields().set("state", bag), ending_.stamp});
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
    bag_ = BagWatch();
    journal_.reset();
    std::error_code error;
    fs::remove_all(folder_, error);  // no trial has begun: nothing is lost
    return leave(0);
  }
  if (phase_ == Phase::running) end({"aborted", "stopped_by_signal", monitor_.latest()});
  const double begun = wall();
  while (phase_ == Phase::draining && wall() - begun < kDrain) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
  }
  if (phase_ == Phase::draining) write_end();
  while (phase_ == Phase::closing) {
    if (wall() - begun > 1.5) bag_.kill();
    close();
    ros::WallDuration(0.02).sleep();
  }
  leave(exit_code_);
}

}  // namespace navvi_study
