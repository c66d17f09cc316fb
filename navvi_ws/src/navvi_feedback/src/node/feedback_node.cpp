// The person's side: one stick in; rumble, speech and a bright path out.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

#include <csignal>
#include <navvi_config/priority.hpp>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/subscribe.hpp>
#include <navvi_types/transform_listener.hpp>

#include "navvi_feedback/lockstep/guide.hpp"
#include "navvi_feedback/node/msg_conversion.hpp"
#include "node/beat.hpp"
#include "node/diagnostics.hpp"
#include "node/heartbeat_notice.hpp"
#include "node/node_config.hpp"
#include "node/outlets.hpp"
#include "node/person_devices.hpp"
#include "node/settings.hpp"

namespace navvi_feedback::node {

using devices::Chain;
using devices::InputSource;
using devices::Latencies;
using lockstep::Told;
using navvi_types::from_msg;
using navvi_types::to_ns;

namespace {

volatile std::sig_atomic_t g_stop = 0;

constexpr double kTick = 0.02;      // s
constexpr double kReport = 0.25;    // s; trial_node knows within a second that this node hangs
constexpr double kMostAhead = 0.3;  // s, that a pose may be stamped ahead of ROS time
constexpr double kLate = 0.1;       // s between two ticks; below it hands and ears notice nothing
constexpr double kLastWords = 3.0;  // s, that the end of a session waits for them at most

/// Wall time, so that the person hears of a simulation that has stopped.
double now() { return ros::SteadyTime::now().toSec(); }

/// Topics in, one beat of the guide, topics out.
class FeedbackNode {
 public:
  explicit FeedbackNode(const NodeConfig& config)
      : config_(config),
        settings_(config_),
        welcomes_(settings_.loaded()),
        guide_(config.feedback, config.phrases_file()),
        plates_(config.phrases_file(), config.plates()),
        devices_(config),
        outlets_(node_, config, devices_.source().kind() != InputSource::Kind::topic) {
    config_.speaker = config.voice();  // for the record
    // The picture speaks the language of the session.
    ros::param::set("navvi/phrases", config.phrases_file().string());
    guide_.offer(settings_.values());
    ROS_INFO("The stick comes from the %s.", devices::to_string(devices_.source().kind()));
    subscribe_to_hands();
    subscribe_to_robot();
    subscribe_to_trials();
    tick_timer_ =
        node_.createWallTimer(ros::WallDuration(kTick), [this](const ros::WallTimerEvent&) {
          if (now() - last_tick_ >= 0.9 * kTick) tick();
        });
    diagnostics_timer_ = node_.createWallTimer(ros::WallDuration(kReport),
                                               [this](const ros::WallTimerEvent&) { diagnose(); });
  }

  /// Leaves nothing running, driving or speaking.
  void finish() {
    tick_timer_.stop();
    for (const CueKind failure : settings_.finish()) guide_.announce(failure);
    if (guide_.end_session()) tick();
    outlets_.stop_wheels();
    for (const double end = now() + kLastWords; guide_.has_last_words() && now() < end;) {
      tell(guide_.hear_out(devices_.read(now()), now()), {});
      ros::WallDuration(kTick).sleep();
    }
    tell(guide_.hear_out(devices_.read(now()), now()), {});
    tell(guide_.finish(devices_.read(now())), {});
  }

 private:
  template <typename Msg, typename Take>
  void listen(const std::string& topic, std::uint32_t queue, Take take) {
    subscribers_.push_back(navvi_types::subscribe<Msg>(node_, topic, queue, from_msg, take));
  }

  /// Without delay, and with the name of the publisher.
  template <typename Msg>
  void listen_at_once(const std::string& topic, std::uint32_t queue,
                      const boost::function<void(const ros::MessageEvent<const Msg>&)>& take) {
    subscribers_.push_back(node_.subscribe<Msg>(topic, queue, take, ros::VoidConstPtr(),
                                                ros::TransportHints().tcpNoDelay()));
  }

  void subscribe_to_hands() {
    InputSource& source = devices_.source();
    if (source.kind() == InputSource::Kind::topic)
      listen<sensor_msgs::Joy>(
          "joy", 1, [&source](const drive::InputState& joy) { source.receive(joy, now()); });
    // Without a stick in it, the keys are lost. Each message counts: a short press is two.
    if (source.kind() == InputSource::Kind::keyboard)
      listen_at_once<sensor_msgs::Joy>(
          "navvi/keys", 100, [&source](const ros::MessageEvent<const sensor_msgs::Joy>& event) {
            source.receive(from_msg(*event.getConstMessage()).value_or(drive::InputState{}), now());
          });
    if (config_.others_rumble && source.pad() != nullptr)
      listen_at_once<sensor_msgs::JoyFeedbackArray>(
          "joy/set_feedback", 10,
          [this](const ros::MessageEvent<const sensor_msgs::JoyFeedbackArray>& wish) {
            if (wish.getPublisherName() == ros::this_node::getName()) return;
            if (const auto rumble = from_msg(*wish.getConstMessage(), config_.motors))
              guide_.take(*rumble, now());
            else
              ROS_WARN_THROTTLE(5.0, "A message on joy/set_feedback is malformed and was dropped.");
          });
    subscribers_.push_back(node_.subscribe<std_msgs::String>(
        "navvi/ask", 10, [this](const std_msgs::String::ConstPtr& msg) {
          if (const auto button = navvi_types::from_word<drive::Button>(msg->data))
            asked_.push_back(*button);
        }));
  }

  void subscribe_to_robot() {
    // A thing that is felt, hit or to be obeyed does not wait for the next beat.
    listen<navvi_msgs::Proximity>("navvi/proximity", 1, [this](const auto& proximity) {
      const std::chrono::nanoseconds age(to_ns(ros::Time::now()) - proximity.stamp);
      devices_.latencies().add(Chain::sensed, Latencies::Clock::now() - age);
      guide_.take(proximity, now());
      tick(Chain::motors);
    });
    listen<navvi_msgs::Contact>("navvi/contacts", 100, [this](const auto& contact) {
      guide_.take(contact);
      tick(Chain::pattern);
    });
    listen<navvi_msgs::Guidance>("navvi/guidance", 1, [this](const auto& guidance) {
      const bool news = !guide_.guidance() || guide_.guidance()->state != guidance.state;
      guide_.take(guidance, now());
      if (news) tick();
    });
    listen<navvi_msgs::DriveState>("navvi/drive_state", 1, [this](navvi_types::DriveState state) {
      twin_ = state.intruder == ros::this_node::getName();
      if (twin_) state.intruder.clear();
      guide_.take(state, now());
    });
    listen<nav_msgs::Odometry>("odom", 1,
                               [this](const auto& odometry) { guide_.take(odometry, now()); });
    listen<nav_msgs::Path>("navvi/path", 1, [this](const auto& path) { path_ = path; });
  }

  void subscribe_to_trials() {
    listen<navvi_msgs::TrialState>("navvi/trial_state", 1, [this](const auto& state) {
      const bool runs = state.state == navvi_types::TrialState::State::running;
      if (runs && !std::exchange(runs_, runs)) devices_.latencies().clear();
      runs_ = runs;
      guide_.take(state, now());
    });
    listen<navvi_msgs::Scenario>("navvi/scenario", 1,
                                 [this](const auto& scenario) { guide_.take(scenario, now()); });
    listen<geometry_msgs::PoseStamped>("move_base_simple/goal", 10,
                                       [this](const auto& goal) { guide_.take_goal(goal); });
    subscribers_.push_back(node_.subscribe<navvi_msgs::TrialEvent>(
        "navvi/events", 100, [this](const navvi_msgs::TrialEvent::ConstPtr& msg) {
          if (msg->type == "TRIAL_END") guide_.end_trial(last_words(*msg));
        }));
  }

  /// At 50 Hz or more. \param caused  the chain that a message begins which has just come
  void tick(std::optional<Chain> caused = std::nullopt) {
    const auto begun = Latencies::Clock::now();
    std::function<void()> called;
    if (caused) called = [this, chain = *caused, begun] { devices_.latencies().add(chain, begun); };
    const double time = last_tick_ = now();
    if (!caused && beat_.becomes_late(time)) {
      ROS_WARN(
          "The computer is too busy: touch and words come late. Close other programs; "
          "doc/driving.md says how NavVI goes before them.");
      guide_.announce(CueKind::machine_slow);
    }
    for (const CueKind failure : settings_.failures()) guide_.announce(failure);
    // A reader of words by topic comes a moment after this node.
    if (welcomes_ && (config_.listener != "topic" || outlets_.are_words_read())) {
      welcomes_ = false;
      guide_.announce(CueKind::settings_of);
    }
    senses::Devices devices = devices_.read(time);
    devices.robot = robot();
    devices.asked = asked_;
    if (twin_) devices.states.push_back(CueKind::two_drivers);
    const auto told = guide_.update(devices, time);
    if (!told) return;
    asked_.clear();
    live_ = devices.hands.live;
    if (live_) outlets_.send(devices.hands);
    tell(*told, called);
    outlets_.show(guide_.guidance_fresh(time) ? guide_.guidance() : std::nullopt, path_, plates_,
                  time);
  }

  void tell(const Told& told, const std::function<void()>& called) {
    settings_.keep(told);
    if (told.lesson_over) g_stop = 1;
    if (!told.change.empty()) change(told.change);
    if (told.alarm_begins)
      ROS_WARN("There is no audio device: nothing is heard. %s", devices_.audio().detail.c_str());
    const bool own_pad = devices_.move_motors(told.rumble, called);
    outlets_.send(told);
    if (!own_pad && told.rumble_moved && called) called();
    std::vector<CueEvent> events;
    for (const sounds::Play& sound : devices_.obey(told)) events.push_back(guide_.event_of(sound));
    if (told.felt) events.push_back(*told.felt);
    events.insert(events.end(), told.said.begin(), told.said.end());
    outlets_.send(events);
  }

  /// Holds from now on: here, in the records of trials to come, and if this node is started anew.
  void change(const std::string& word) {
    settings_.change(word);
    guide_.use(config_.feedback);
    plates_.use(config_.plates());
    devices_.use(config_.speaker.rate, config_.mixer.volume);
  }

  /// base_link in map
  [[nodiscard]] std::optional<navvi_types::Pose2> robot() const {
    try {
      const auto found = tf_.lookupTransform("map", "base_link", ros::Time(0));
      if ((found.header.stamp - ros::Time::now()).toSec() > kMostAhead) return std::nullopt;
      return from_msg(found.transform);
    } catch (const tf2::TransformException&) {
      return std::nullopt;
    }
  }

  void diagnose() {
    diagnostic_msgs::DiagnosticArray array;
    array.header.stamp = ros::Time::now();
    const auto pad = devices_.pad();
    if (const auto notice = pad ? heartbeat_.notice(*pad, now()) : std::nullopt)
      ROS_WARN("%s", notice->c_str());
    array.status = {pad_status(pad, devices::to_string(devices_.source().kind()), live_,
                               config_.feedback->haptics.enabled),
                    audio_status(devices_.audio()),
                    speech_status(devices_.voice(), config_.speaker.voice),
                    latency_status(devices_.latencies(), guide_.learnt()), beat_status(beat_)};
    outlets_.send(array);
    if (!ros::Time::isValid()) ROS_WARN_THROTTLE(5.0, "There is no /clock yet.");
  }

  NodeConfig config_;
  Settings settings_;
  bool welcomes_;  ///< the person's settings were loaded, and that is to be said
  lockstep::Guide guide_;
  cues::Phrases plates_;  ///< what is written in the picture
  PersonDevices devices_;
  Beat beat_{kLate};
  HeartbeatNotice heartbeat_;

  ros::NodeHandle node_;
  Outlets outlets_;
  tf2_ros::Buffer tf_;
  navvi_types::TransformListener tf_listener_{tf_};
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer tick_timer_, diagnostics_timer_;

  std::vector<Eigen::Vector2d> path_;  ///< m, in map
  std::vector<drive::Button> asked_;   ///< by topic, not answered yet
  bool twin_ = false;                  ///< another node drives under the name of this one
  bool runs_ = false;                  ///< a trial
  bool live_ = false;                  ///< the stick, at the last beat
  double last_tick_ = 0.0;             // s, of now()
};

/// roscpp waits for the master where no signal reaches it; so wait here first.
/// \return false if the wait was ended by a signal
bool await_master() {
  if (!ros::master::check())
    ROS_WARN("Waiting for the ROS master at %s.", ros::master::getURI().c_str());
  while (g_stop == 0 && !ros::master::check()) ros::WallDuration(0.2).sleep();
  return g_stop == 0;
}

void spin(FeedbackNode& node) {
  while (ros::ok() && g_stop == 0) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
  }
  if (!ros::ok()) return;
  node.finish();
  ros::WallDuration(0.05).sleep();  // lets the last messages leave
}

}  // namespace
}  // namespace navvi_feedback::node

int main(int argc, char** argv) {
  using navvi_feedback::node::NodeConfig;
  using navvi_feedback::node::PersonConfig;
  using navvi_feedback::person::PersonFile;
  if (const auto code =
          navvi_config::print_parameters<NodeConfig>(argc, argv, [](const NodeConfig& config) {
            return config.person.empty() ? YAML::Node(YAML::NodeType::Map)
                                         : PersonFile::of<PersonConfig>(config.person).load();
          }))
    return *code;
  navvi_config::ask_for_priority(-10);
  // roscpp's own handler would close the topics before the last zero is out.
  ros::init(argc, argv, "feedback_node", ros::init_options::NoSigintHandler);
  for (const int signal : {SIGINT, SIGTERM})
    std::signal(signal, [](int) { navvi_feedback::node::g_stop = 1; });
  navvi_config::end_with_launcher();
  if (!navvi_feedback::node::await_master()) return 0;
  return navvi_config::run_node<NodeConfig>([](const NodeConfig& config) {
    navvi_feedback::node::FeedbackNode node(config);
    navvi_feedback::node::spin(node);
    return 0;
  });
}
