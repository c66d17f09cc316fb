#include "recount/recount.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <stdexcept>

#include "node/msg_conversion.hpp"
#include "recount/bag_message.hpp"
#include "trial/tracker.hpp"

namespace navvi_study::recount {
namespace {

std::uint64_t count_in(const record::Row& row, const std::string& name) {
  return static_cast<std::uint64_t>(row.fields.number(name).value_or(0.0));
}

trial::TrialStart start_of(const record::Row& row) {
  trial::TrialStart start;
  start.stamp = row.sim_ns;
  start.goal = {row.fields.number("goal_x").value_or(0.0),
                row.fields.number("goal_y").value_or(0.0)};
  start.hits = {static_cast<std::uint32_t>(count_in(row, "contact_seq")),
                count_in(row, "shelf_contacts"), count_in(row, "obstacle_contacts")};
  start.hits_known = row.fields.number("contact_seq").has_value();
  start.round_trip = row.fields.number("round_trip").value_or(0.0);
  if (!row.fields.find("stuck_cues")) start.stuck = {navvi_types::CueKind::stuck};
  return start;
}

trial::TrialMonitorConfig config_of(const record::Row& row) {
  trial::TrialMonitorConfig config;
  config.obstacle_range = row.fields.number("obstacle_range").value_or(config.obstacle_range);
  config.shelf_range = row.fields.number("shelf_range").value_or(config.shelf_range);
  config.leave_margin = row.fields.number("leave_margin").value_or(config.leave_margin);
  config.leave_time = row.fields.number("leave_time").value_or(config.leave_time);
  config.center_range = row.fields.number("center_range").value_or(config.center_range);
  // Older records took the guide's word for it.
  config.arrival_range = row.fields.number("arrival_range").value_or(1e9);
  return config;
}

class Recount {
 public:
  /// Reads what trial_node itself said: when the trial began and ended, and its goals.
  explicit Recount(const rosbag::Bag& bag) : bag_(bag) {
    for (const auto& item : rosbag::View(bag, rosbag::TypeQuery("navvi_msgs/TrialEvent"))) {
      const auto msg = message_of<navvi_msgs::TrialEvent>(item);
      const auto row = msg ? node::from_msg(*msg) : std::nullopt;
      if (!row) continue;
      if (row->type == "TRIAL_START") start_ = *row;
      if (row->type == "GOAL_SET") goals_.push_back(*row);
      if (row->type == "CUE" || row->type == "CUE_END") cues_.push_back(*row);
      if (row->type != "TRIAL_END") continue;
      end_ = *row;
      over_ = item.getTime();
    }
    if (start_.type.empty()) throw std::runtime_error("the bag does not hold the trial's start");
    if (end_.type.empty()) throw std::runtime_error("the bag does not hold the trial's end");
    const std::string settings = start_.fields.get("settings"), name = "trial/odom_frame=";
    if (const auto at = settings.find(name); at != settings.npos)
      odom_frame_ = settings.substr(at + name.size(), settings.find(' ', at) - at - name.size());
  }

  void replay(const std::filesystem::path& phrases) {
    monitor_ = trial::TrialMonitor(config_of(start_));
    if (const auto name = start_.fields.find("phrases"))
      monitor_.understand(listener_.emplace(phrases / *name));
    tracker_.start(start_.sim_ns);
    // Stamps decide what belongs to the trial, so what came before it sets the scene first.
    const trial::TrialStart start = start_of(start_);
    for (const bool before : {true, false}) {
      if (!before) {
        monitor_.start(start);
        monitor_.end(end_.sim_ns);
        push({"TRIAL_START", start_.fields, start_.sim_ns});
        change_goals_until(start_.sim_ns);
      }
      places_ = trial::OdometryInMap();
      for (const auto& item : rosbag::View(bag_, ros::TIME_MIN, over_)) see(item, before);
    }
    record::Fields fields = monitor_.end_fields();
    const auto& arrival = monitor_.arrival();
    const bool reached = arrival && arrival->result == "reached";
    const std::string told = end_.fields.get("result");
    // What the messages show counts; only ends that no message shows are taken on trust.
    const bool contradicts = told != "invalid" && reached != (told == "reached");
    fields.set("result", contradicts ? (reached ? "reached" : "not reached") : told);
    fields.set("reason", end_.fields.get("reason"));
    push({"TRIAL_END", fields, end_.sim_ns});
  }

  [[nodiscard]] Recounted trial() { return {{rows_, tracker_.rows_until(end_.sim_ns)}, lost_}; }

 private:
  void push(const trial::Event& event) {
    rows_.push_back({start_.trial, static_cast<std::uint32_t>(rows_.size() + 1), event.sim_ns, 0,
                     event.type, event.fields});
  }

  void change_goals_until(std::int64_t stamp) {
    while (next_goal_ < goals_.size() && goals_[next_goal_].sim_ns <= stamp) {
      const record::Row& row = goals_[next_goal_++];
      const trial::Event event = {"GOAL_SET", row.fields, row.sim_ns};
      if (row.sim_ns > start_.sim_ns) (void)monitor_.change_goal(start_of(row).goal, row.sim_ns);
      push(event);
    }
  }

  /// A recorder that gets no processor drops what comes meanwhile. \param seq  gapless, by roscpp
  void count_lost(std::uint32_t seq) {
    if (last_seq_ && seq > *last_seq_) lost_ += seq - *last_seq_ - 1;
    last_seq_ = seq;
  }

  /// At the instant of the end the clock may stand, as after the loss of the simulator: of what was
  /// said then, that which trial_node has heard.
  [[nodiscard]] bool was_heard(const navvi_types::CueEvent& cue) const {
    if (cue.stamp != end_.sim_ns || cue.modality() != navvi_types::Modality::speech) return true;
    return std::any_of(cues_.begin(), cues_.end(), [&](const record::Row& row) {
      return row.fields.get("id") == std::to_string(cue.id) &&
             row.fields.get("stage") == to_string(cue.stage);
    });
  }

  template <typename Report>
  void observe(const Report& report, bool before) {
    if ((report.stamp <= start_.sim_ns) != before || monitor_.ahead(report.stamp, clock_)) return;
    if (!before) change_goals_until(report.stamp - 1);
    tracker_.observe(report);
    for (const auto& event : monitor_.observe(report)) push(event);
  }

  /// Calls `take` with the message if it is a `Message` on `topic`.
  template <typename Message, typename Take>
  static void with(const rosbag::MessageInstance& item, const char* topic, const Take& take) {
    if (!boost::algorithm::ends_with(item.getTopic(), topic)) return;
    if (const auto msg = message_of<Message>(item)) take(*msg);
  }

  void see(const rosbag::MessageInstance& item, bool before) {
    clock_ = navvi_types::to_ns(item.getTime());
    const auto observe_all = [&](const auto& reports) {
      for (const auto& report : reports) observe(report, before);
    };
    for (const bool for_good : {false, true}) {
      with<tf2_msgs::TFMessage>(item, for_good ? "/tf_static" : "/tf", [&](const auto& msg) {
        for (const auto& correction : node::from_msg(msg, for_good, odom_frame_))
          observe_all(places_.take(correction));
      });
    }
    // The only odometry in the bag, whatever the robot's topic is.
    with<nav_msgs::Odometry>(item, "", [&](const auto& msg) {
      const auto report = node::from_msg(msg);
      if (!report) return;
      if (!before && report->stamp > start_.sim_ns) count_lost(msg.header.seq);
      if (monitor_.ahead(report->stamp, clock_)) return;
      if ((report->stamp <= start_.sim_ns) == before) tracker_.take_odometry(*report);
      observe_all(places_.take(*report));
    });
    with<diagnostic_msgs::DiagnosticArray>(
        item, "/diagnostics", [&](const auto& msg) { observe_all(node::from_msg(msg)); });
    const auto observe_one = [&](const auto& msg) {
      if (const auto report = node::from_msg(msg)) observe(*report, before);
    };
    with<sensor_msgs::Joy>(item, "/joy", [&](const auto& msg) {
      const auto hands = node::from_msg(msg);
      if (hands && (hands->stamp <= start_.sim_ns) == before &&
          !monitor_.ahead(hands->stamp, clock_))
        tracker_.observe(*hands);
    });
    with<navvi_msgs::Contact>(item, "/navvi/contacts", observe_one);
    with<navvi_msgs::Proximity>(item, "/navvi/proximity", observe_one);
    with<navvi_msgs::Guidance>(item, "/navvi/guidance", observe_one);
    with<navvi_msgs::Cue>(item, "/navvi/cues", [&](const auto& msg) {
      const auto cue = node::from_msg(msg);
      if (cue && was_heard(*cue)) observe(*cue, before);
    });
    with<navvi_msgs::DriveState>(item, "/navvi/drive_state", observe_one);
    with<navvi_msgs::LinkState>(item, "/navvi/link", observe_one);
    with<navvi_msgs::StateHash>(item, "/navvi/state_hash", observe_one);
  }

  const rosbag::Bag& bag_;
  trial::TrialMonitor monitor_{trial::TrialMonitorConfig()};
  trial::Tracker tracker_;
  std::optional<navvi_people::people::Listener> listener_;
  trial::OdometryInMap places_;
  std::string odom_frame_ = "odom";
  record::Row start_;
  record::Row end_;
  ros::Time over_;          ///< when the bag got the end: what came later was counted by nobody
  std::int64_t clock_ = 0;  ///< ns, ROS time at which the bag got what is seen
  std::vector<record::Row> goals_, cues_;
  std::size_t next_goal_ = 0;
  std::vector<record::Row> rows_;
  std::optional<std::uint32_t> last_seq_;  ///< of the odometry
  unsigned lost_ = 0;
};

}  // namespace

Recounted trial_from_bag(const std::filesystem::path& path, const std::filesystem::path& phrases) {
  rosbag::Bag bag;
  bag.open(path.string(), rosbag::bagmode::Read);
  Recount recount(bag);
  recount.replay(phrases);
  return recount.trial();
}

}  // namespace navvi_study::recount
