// Runs trials: sets the goal, keeps the journal, the bag and the results.

#include <navvi_msgs/TrialEvent.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <signal.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_types/subscribe.hpp>
#include <set>

#include "node/session_parts.hpp"
#include "node/msg_conversion.hpp"
#include "trial/trial_keeper.hpp"

namespace navvi_study::node {
namespace {

constexpr double kStep = 0.05;  // s, of the wall timer
constexpr double kBeat = 0.25;  // s, between two messages of the same state
constexpr std::uint32_t kQueue = 1000;
constexpr double kFetch = 120.0;  // s, for a bag to come from the robot's machine

// All but what a replay makes anew of these: the mesh, and most of what moves in the picture.
constexpr const char* kRecorded[] = {"/clock",
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
                                     "navvi/markers",
                                     "navvi/zone",
                                     "navvi/zones",
                                     "navvi/cues",
                                     "navvi/order",
                                     "navvi/scenario",
                                     "navvi/drive_state",
                                     "navvi/applied_commands",
                                     "navvi/state_hash",
                                     "navvi/command",
                                     "navvi/link",
                                     "joy",
                                     "joy/set_feedback",
                                     "move_base_simple/goal",
                                     "navvi/trial_state",
                                     "navvi/trial_request",
                                     "navvi/time_reference",
                                     "/diagnostics",
                                     "navvi/events"};

trial::Moment now() {
  return {static_cast<std::int64_t>(ros::SteadyTime::now().toNSec()),
          static_cast<std::int64_t>(ros::Time::now().toNSec()),
          static_cast<std::int64_t>(ros::WallTime::now().toNSec())};
}

void tell(trial::TrialKeeper::Tone tone, const std::string& sentence) {
  using namespace ros::console::levels;
  constexpr Level kLevels[] = {Info, Warn, Error, Fatal};
  ROS_LOG(kLevels[static_cast<std::size_t>(tone)], ROSCONSOLE_DEFAULT_NAME, "%s", sentence.c_str());
}

void add(const std::string& name, XmlRpc::XmlRpcValue& value, trial::Settings& settings) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeStruct) {
    for (auto& [key, item] : value) add(name + "/" + key, item, settings);
    return;
  }
  std::ostringstream text;
  value.write(text);
  settings[name] =
      value.getType() == XmlRpc::XmlRpcValue::TypeString ? std::string(value) : text.str();
}

/// What the parameter server holds for NavVI's nodes, such as nav/mesh/climb: profile, launch file
/// and person gave it. The folder of the record may bear a person's name and is left out. The
/// master tells this node of changes, so that only the first call asks for all.
trial::Settings settings_of_nodes() {
  static const std::set<std::string> nodes = [] {
    std::vector<std::string> names;
    ros::param::getParamNames(names);
    std::set<std::string> found;
    for (const std::string& name : names)
      if (const auto end = name.find("_node/"); end != name.npos) found.insert(name.substr(0, end));
    return found;
  }();
  trial::Settings settings;
  for (const std::string& node : nodes)
    if (XmlRpc::XmlRpcValue value; ros::param::getCached(node + "_node", value))
      add(node.substr(1), value, settings);
  const std::string own = ros::this_node::getName();
  settings.erase(own.substr(1, own.rfind("_node") - 1) + "/out");
  return settings;
}

/// The node's name without slashes, as a child of it may bear it.
std::string name_of_recorder() {
  std::string name = ros::this_node::getName().substr(1) + "_recorder";
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

/// Runs trials (TrialKeeper) on what the topics say. Everything happens in the thread that spins.
class TrialNode {
 public:
  /// Puts earlier trials in order. \throws std::runtime_error if `out` cannot be used
  explicit TrialNode(const trial::TrialNodeConfig& config)
      : recorder_name_(name_of_recorder()),
        far_(config.record == "robot"),
        keeper_(named(config), outlets(), now()) {
    events_ = node_.advertise<navvi_msgs::TrialEvent>(
        "navvi/events", kQueue, [this](const ros::SingleSubscriberPublisher& link) {
          if (boost::algorithm::ends_with(link.getSubscriberName(), recorder_name_))
            keeper_.recorder_listens(now());
        });
    goals_ = node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
    state_ = node_.advertise<navvi_msgs::TrialState>("navvi/trial_state", 1, true);
    subscribe(config.odom_frame);
    timer_ = node_.createWallTimer(ros::WallDuration(kStep), [this](auto&) {
      keeper_.step(now());
      if (keeper_.done()) ros::shutdown();
    });
    beat_ = node_.createWallTimer(ros::WallDuration(kBeat), [this](auto&) { show(); });
  }

  /// Ends a running trial as aborted and closes everything. Takes two seconds at most.
  void shut_down() {
    const std::string why = navvi_config::name_is_taken() ? "name_taken" : parts_.crashed();
    for (keeper_.stop(now(), why); !keeper_.done(); keeper_.step(now()))
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
    ros::shutdown();
  }
  /// Of the process, once ROS has been shut down.
  [[nodiscard]] int exit_code() const { return keeper_.exit_code(); }

 private:
  /// With what topics and frames are called in this session.
  [[nodiscard]] trial::TrialNodeConfig named(trial::TrialNodeConfig config) const {
    config.sources = {node_.resolveName("odom"),
                      node_.resolveName("navvi/guidance"),
                      node_.resolveName("octomap_binary"),
                      node_.resolveName("map"),
                      ros::param::param<std::string>("nav_node/map_frame", "map"),
                      ros::param::param<std::string>("nav_node/base_frame", "base_link"),
                      ""};
    // Where the robot's clock is on another machine, person.launch has one here.
    if (node_.resolveName("/clock") != "/clock")
      config.sources.link = node_.resolveName("navvi/link");
    return config;
  }
  [[nodiscard]] trial::TrialKeeper::Outlets outlets() {
    trial::TrialKeeper::Outlets out;
    out.publish = [this](const record::Row& row) {
      events_.publish(to_msg(row));
      if (row.type == "TRIAL_START") parts_.note();
    };
    out.set_goal = [this](const trial::ChosenGoal& goal) {
      goals_.publish(navvi_types::goal_msg(goal.place, goal.stamp));
    };
    out.tell = tell;
    out.show = [this](const TrialState& state) {
      shown_ = state;
      shown_->stamp = navvi_types::to_ns(ros::Time::now());
      show();
    };
    out.settings = settings_of_nodes;
    out.hears_contacts = [this] { return contacts_.getNumPublishers() > 0; };
    out.phrases = [] { return ros::param::param<std::string>("navvi/phrases", ""); };
    out.start_recorder = [this](const std::filesystem::path& bag) {
      std::vector<std::string> topics;
      for (const char* topic : kRecorded) topics.push_back(node_.resolveName(topic));
      // As an argument that renames: the bag has what comes seldom under the name that RViz knows.
      topics.push_back(node_.resolveName("navvi/scene_moving") +
                       ":=" + node_.resolveName("navvi/scene_recorded"));
      if (!far_) {
        for (const std::string name : {"/clock", "/use_sim_time"})  // the robot's time is the bag's
          topics.push_back(name + ":=" + node_.resolveName(name));
        return std::make_unique<trial::BagRecorder>(bag, recorder_name_, topics);
      }
      const auto own = std::filesystem::read_symlink("/proc/self/exe").parent_path();
      return std::make_unique<trial::BagRecorder>(
          bag, recorder_name_, topics,
          std::vector<std::string>{(own / "robot_bag").string(), "fetch"}, kFetch);
    };
    return out;
  }

  /// Repeated, with the time of the last change: listeners know by it that trials are recorded.
  void show() {
    if (shown_) state_.publish(navvi_types::to_msg(*shown_));
  }

  void subscribe(const std::string& odom_frame) {
    take<nav_msgs::Odometry>("odom");
    take<navvi_msgs::Contact>("navvi/contacts");
    contacts_ = subscribers_.back();
    take<navvi_msgs::Proximity>("navvi/proximity");
    take<navvi_msgs::Cue>("navvi/cues");
    take<navvi_msgs::DriveState>("navvi/drive_state");
    take<navvi_msgs::LinkState>("navvi/link");
    take<navvi_msgs::Guidance>("navvi/guidance");
    take<navvi_msgs::Scenario>("navvi/scenario");
    take<navvi_msgs::TrialRequest>("navvi/trial_request");
    take<navvi_msgs::StateHash>("navvi/state_hash");
    for (const bool for_good : {false, true}) {
      listen<tf2_msgs::TFMessage>(
          for_good ? "/tf_static" : "/tf", [this, for_good, odom_frame](auto& msg) {
            for (const auto& correction : from_msg(msg, for_good, odom_frame))
              keeper_.take(correction, now());
          });
    }
    listen<sensor_msgs::TimeReference>("navvi/time_reference", [this](auto& msg) {
      if (const auto clock = from_msg(msg)) keeper_.take(*clock, now());
    });
    listen<diagnostic_msgs::DiagnosticArray>("/diagnostics", [this](auto& msg) {
      for (const auto& report : from_msg(msg)) keeper_.take(report, now());
    });
    listen<sensor_msgs::Joy>("joy", [this](auto& msg) {
      if (const auto hands = from_msg(msg)) keeper_.take(*hands, now());
    });
    subscribers_.push_back(node_.subscribe("move_base_simple/goal", 10, &TrialNode::on_goal, this));
  }

  template <typename Message, typename Callback>
  void listen(const std::string& topic, const Callback& callback) {
    subscribers_.push_back(node_.subscribe<Message>(
        topic, kQueue, [callback](const typename Message::ConstPtr& msg) { callback(*msg); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }

  /// The keeper takes the messages of `topic`; bad ones are dropped and counted.
  template <typename Message>
  void take(const std::string& topic) {
    subscribers_.push_back(
        navvi_types::subscribe<Message>(node_, topic, kQueue, navvi_types::from_msg,
                                        [this](const auto& value) { keeper_.take(value, now()); }));
  }

  void on_goal(const ros::MessageEvent<geometry_msgs::PoseStamped const>& event) {
    const std::string& frame = event.getConstMessage()->header.frame_id;
    // One in another frame comes once more from nav_node, in map.
    if (event.getPublisherName() == ros::this_node::getName() ||
        navvi_types::without_slash(frame) != "map")
      return;
    if (const auto goal = from_msg(*event.getConstMessage())) {
      keeper_.take_goal(*goal, now(), navvi_types::to_ns(event.getConstMessage()->header.stamp));
    } else {
      ROS_WARN_THROTTLE(5.0, "A goal is malformed and was dropped.");
    }
  }

  ros::NodeHandle node_;
  std::string recorder_name_;
  bool far_;  ///< the bag is recorded on the robot's machine
  ros::Publisher events_;
  ros::Publisher goals_;
  ros::Publisher state_;
  SessionParts parts_;
  trial::TrialKeeper keeper_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber contacts_;  ///< one of these
  ros::WallTimer timer_, beat_;
  std::optional<TrialState> shown_;
};

}  // namespace
}  // namespace navvi_study::node

int main(int argc, char** argv) {
  using navvi_study::trial::TrialNodeConfig;
  if (const auto code = navvi_config::print_parameters<TrialNodeConfig>(argc, argv)) return *code;
  navvi_config::init(argc, argv, "trial_node");
  ::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error of write(), as any other
  return navvi_config::run_node<TrialNodeConfig>([](const TrialNodeConfig& config) {
    navvi_study::node::TrialNode trials(config);
    navvi_study::node::end_with_master();
    navvi_config::spin();
    if (navvi_config::ending()) trials.shut_down();
    return trials.exit_code();
  });
}
