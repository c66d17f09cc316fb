// The person's side: one stick in; rumble, speech and a bright path out.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/Float32.h>
#include <std_msgs/String.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <navvi_config/priority.hpp>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_config/subscribe.hpp>
#include <navvi_types/msg_conversion.hpp>

#include "cues/heard_words.hpp"
#include "devices/earcon_player.hpp"
#include "devices/input_source.hpp"
#include "devices/speech_channel.hpp"
#include "navvi_feedback/core/feedback.hpp"
#include "navvi_feedback/haptics/rumble_output.hpp"
#include "navvi_feedback/node/msg_conversion.hpp"
#include "node/beat.hpp"
#include "node/diagnostics.hpp"
#include "node/node_config.hpp"
#include "person/settings_saver.hpp"
#include "picture/markers.hpp"

namespace navvi_feedback::node {

using navvi_types::from_msg;
using navvi_types::Modality;
using navvi_types::to_msg;

namespace {

volatile std::sig_atomic_t g_stop = 0;

constexpr double kTick = 0.02;      // s
constexpr double kReport = 0.25;    // s; who waits for it knows within a second that it hangs
constexpr double kHalted = 0.5;     // s without a tick
constexpr double kCatchUp = 0.2;    // s
constexpr double kRarely = 2.0;     // s; who is slow all the time speaks nevertheless
constexpr double kLate = 0.1;       // s between two ticks; below it hands and ears notice nothing
constexpr double kFirstBeat = 2.0;  // s
constexpr double kLastWords = 3.0;  // s, that the end of a session waits for them at most

/// Wall time, so that the person hears of a simulation that has stopped.
double now() { return ros::SteadyTime::now().toSec(); }

class FeedbackNode {
 public:
  explicit FeedbackNode(const NodeConfig& config)
      : config_(config),
        feedback_(config.feedback, config.phrases_file()),
        plates_(config.phrases_file(), config.plates()),
        mixer_(config.mixer, config.speech ? devices::Audio::on : devices::Audio::off),
        speech_(config.voice(), mixer_, latencies_),
        earcons_(mixer_),
        source_(config.input) {
    config_.speaker = config.voice();  // for the record
    // The picture speaks the language of the session.
    ros::param::set("navvi/phrases", config.phrases_file().string());
    offer_settings();
    ROS_INFO("The stick comes from the %s.", devices::to_string(source_.kind()));
    advertise();
    subscribe();
    hear_of_trials();
    subscribers_.push_back(node_.subscribe<std_msgs::String>(
        "navvi/ask", 10, [this](const std_msgs::String::ConstPtr& msg) {
          if (const auto button = navvi_types::from_word<drive::Button>(msg->data))
            asked_.push_back(*button);
        }));
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
    report(saver_->finish());
    if (runs_) over(CueKind::trial_over);
    if (!news_.empty()) tick();
    cmd_vel_.publish(geometry_msgs::Twist());
    move_motors({}, std::nullopt, now());
    for (const double end = now() + kLastWords; over_ && !speech_.idle() && now() < end;) {
      say({}, now());
      ros::WallDuration(kTick).sleep();
    }
    publish(as_heard(speech_.finish()));
  }

 private:
  void advertise() {
    cmd_vel_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    motors_ = node_.advertise<sensor_msgs::JoyFeedbackArray>("joy/set_feedback", 10);
    cues_ = node_.advertise<navvi_msgs::Cue>("navvi/cues", 100);
    assistance_ = node_.advertise<std_msgs::Float32>("navvi/assistance", 1, true);
    goals_ = node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
    requests_ = node_.advertise<navvi_msgs::TrialRequest>("navvi/trial_request", 10);
    markers_ = node_.advertise<visualization_msgs::MarkerArray>("navvi/markers", 1, true);
    diagnostics_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("diagnostics", 10);
    // Another driver's joy is taken, never answered with one of our own.
    if (source_.kind() != devices::InputSource::Kind::topic)
      joy_out_ = node_.advertise<sensor_msgs::Joy>("joy", 1);
  }

  void subscribe() {
    if (source_.kind() == devices::InputSource::Kind::topic) {
      listen<sensor_msgs::Joy>(
          "joy", 1, [this](const drive::InputState& joy) { source_.receive(joy, now()); });
    }
    if (config_.others_rumble && source_.pad() != nullptr) {
      using Wish = ros::MessageEvent<const sensor_msgs::JoyFeedbackArray>;
      const boost::function<void(const Wish&)> feel = [this](const Wish& wish) {
        if (wish.getPublisherName() == ros::this_node::getName()) return;
        if (const auto rumble = from_msg(*wish.getConstMessage(), config_.motors))
          feedback_.take(*rumble, now());
        else
          ROS_WARN_THROTTLE(5.0, "A message on joy/set_feedback is malformed and was dropped.");
      };
      subscribers_.push_back(node_.subscribe<sensor_msgs::JoyFeedbackArray>(
          "joy/set_feedback", 10, feel, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
    }
    if (source_.kind() == devices::InputSource::Kind::keyboard) {
      // Without a stick in it, the keys are lost. Each message counts: a short press is two.
      const boost::function<void(const sensor_msgs::Joy::ConstPtr&)> type =
          [this](const sensor_msgs::Joy::ConstPtr& msg) {
            source_.receive(from_msg(*msg).value_or(drive::InputState{}), now());
          };
      subscribers_.push_back(node_.subscribe<sensor_msgs::Joy>(
          "navvi/keys", 100, type, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
    }
    // What is felt, hit or to be obeyed does not wait for the next beat.
    listen<navvi_msgs::Proximity>("navvi/proximity", 1, [this](const Proximity& proximity) {
      const std::chrono::nanoseconds age(navvi_types::to_ns(ros::Time::now()) - proximity.stamp);
      latencies_.add(devices::Chain::sensed, devices::Latencies::Clock::now() - age);
      feedback_.take(proximity, now());
      tick(devices::Chain::motors);
    });
    listen<navvi_msgs::Contact>("navvi/contacts", 100, [this](const Contact& contact) {
      feedback_.take(contact);
      tick(devices::Chain::pattern);
    });
    listen<navvi_msgs::Guidance>("navvi/guidance", 1, [this](const Guidance& guidance) {
      const bool news = !feedback_.guidance() || feedback_.guidance()->state != guidance.state;
      feedback_.take(guidance, now());
      if (news) tick();
    });
    listen<navvi_msgs::DriveState>("navvi/drive_state", 1, [this](DriveState state) {
      twin_ = state.intruder == ros::this_node::getName();
      if (twin_) state.intruder.clear();
      feedback_.take(state, now());
    });
    listen<navvi_msgs::TrialState>("navvi/trial_state", 1, [this](const TrialState& state) {
      const bool runs = state.state == TrialState::State::running;
      if (runs && !std::exchange(told_to_run_, runs)) begin();
      told_to_run_ = runs;
      feedback_.take(state, now());
    });
    keep<navvi_msgs::Scenario>("navvi/scenario");
    keep<nav_msgs::Odometry>("odom");
    listen<geometry_msgs::PoseStamped>(
        "move_base_simple/goal", 10,
        [this](const Eigen::Vector2d& goal) { feedback_.take_goal(goal); });
    listen<nav_msgs::Path>("navvi/path", 1,
                           [this](const std::vector<Eigen::Vector2d>& path) { path_ = path; });
  }

  void hear_of_trials() {
    subscribers_.push_back(node_.subscribe<navvi_msgs::TrialEvent>(
        "navvi/events", 100, [this](const navvi_msgs::TrialEvent::ConstPtr& msg) {
          if (msg->type == "TRIAL_END") runs_ = false;
          if (const auto kind = last_words(*msg)) over(*kind);
        }));
  }

  void begin() {
    latencies_.clear();
    runs_ = true;
    over_ = false;
  }

  /// \param kind  of the cue that tells the end of a trial
  void over(CueKind kind) {
    news_.push_back(kind);
    over_ = true;
  }

  template <typename Msg, typename Take>
  void listen(const std::string& topic, std::uint32_t queue, Take take) {
    subscribers_.push_back(navvi_config::subscribe<Msg>(node_, topic, queue, from_msg, take));
  }

  template <typename Msg>
  void keep(const std::string& topic) {
    listen<Msg>(topic, 1, [this](const auto& value) { feedback_.take(value, now()); });
  }

  /// At 50 Hz or more. \param caused  the chain that a message begins which has just come
  void tick(std::optional<devices::Chain> caused = std::nullopt) {
    const auto begun = devices::Latencies::Clock::now();
    std::function<void()> called;
    if (caused) called = [this, chain = *caused, begun] { latencies_.add(chain, begun); };
    const double time = now();
    // Who was halted first takes what came meanwhile, and only then judges what is lost.
    if (time - std::exchange(last_tick_, time) > kHalted && time - woke_ > kRarely) woke_ = time;
    if (time - woke_ < kCatchUp) return;
    if (!caused && beat_.becomes_late(time)) {
      ROS_WARN(
          "The computer is too busy: touch and words come late. Close other programs; "
          "doc/driving.md says how "
          "NavVI goes before them.");
      news_.push_back(CueKind::machine_slow);
    }
    core::Feedback::Input input;
    input.hands = source_.read(time);
    input.keyboard = source_.kind() == devices::InputSource::Kind::keyboard;
    input.audio = audio_link();
    input.sounds = heard();
    input.motors = !source_.pad() || source_.pad()->status().connected;
    input.felt = motors_there();
    input.pad = source_.pad() ? source_.pad()->status().guid : "joy";
    input.voice_busy = !speech_.idle();
    input.robot = robot();
    input.notices = notices();
    input.asked = std::exchange(asked_, {});
    report(saver_->update());
    // Where words are heard by topic, whoever listens comes a moment after this node.
    if (welcomes_ && (config_.listener != "topic" || cues_.getNumSubscribers() > 0)) {
      welcomes_ = false;
      news_.push_back(CueKind::settings_of);
    }
    for (const CueKind kind : std::exchange(news_, {})) input.notices.push_back(kind);
    input.person = config_.person;
    const core::Feedback::Output output = feedback_.update(input, time);
    keep_lesson(output);
    if (output.command) cmd_vel_.publish(to_msg(*output.command));
    if (input.hands.live && joy_out_) joy_out_.publish(to_msg(input.hands, ros::Time::now()));
    if (share_ != output.share) {
      std_msgs::Float32 share;
      share.data = static_cast<float>(output.share);
      assistance_.publish(share);
      share_ = output.share;
    }
    if (output.goal)
      goals_.publish(navvi_types::goal_msg(*output.goal, navvi_types::to_ns(ros::Time::now())));
    if (output.request)
      requests_.publish(
          to_msg(TrialRequest{*output.request, navvi_types::to_ns(ros::Time::now())}));
    if (!output.change.empty()) change(output.change);
    if (output.alarm_begins)
      ROS_WARN("There is no audio device: nothing is heard. %s", mixer_.status().detail.c_str());
    const std::vector<sounds::Play> played = earcons_.play(output.plays);
    for (const sounds::Play& sound : by_topic() ? output.plays : played)
      publish({sound_event(sound, ++sound_id_)});
    for (const sounds::Play& sound : speech_.take_played())
      if (heard()) publish({sound_event(sound, ++sound_id_)});
    move_motors(output.rumble, output.pattern, time, called);
    say(output.cues, time);
    show(time);
    last_hands_ = input.hands;
  }

  /// What a lesson finds out is written at once; the program ends with it.
  void keep_lesson(const core::Feedback::Output& output) {
    if (!config_.record.empty() && std::exchange(recorded_, output.record) != output.record)
      std::ofstream(config_.record) << output.record;
    if (std::exchange(found_, output.settings) != output.settings) {
      for (const std::string& word : output.settings) ROS_INFO("Found: feedback/%s", word.c_str());
      if (person_) person_->save(output.settings);  // before it is said
    }
    if (output.lesson_over) g_stop = 1;
  }

  void offer_settings() {
    if (!config_.person.empty()) {
      person_ = person::PersonFile::of<PersonConfig>(config_.person);
      welcomes_ = true;
    }
    saver_.emplace(person_);
    std::map<std::string, std::string> values;
    const auto describe = [this](navvi_config::Visitor& visit) { config_.describe(visit); };
    for (const navvi_config::Row& row : navvi_config::table_of(describe)) {
      const bool in_vain = (row.key.rfind("sounds/", 0) == 0 && !config_.feedback.sounds.enabled) ||
                           (row.key.rfind("haptics/", 0) == 0 && !config_.feedback.haptics.enabled);
      if (!in_vain) values[row.key] = row.default_value;
    }
    feedback_.take_settings(values);
  }

  /// Holds from now on: here, in the records of trials to come, and if this node is started anew.
  void change(const std::string& word) {
    const YAML::Node values = navvi_config::read_words({word});
    navvi_config::read(config_, values, "the menu");
    feedback_.use(config_.feedback);
    plates_.use(config_.plates());
    speech_.set_rate(config_.speaker.rate);
    mixer_.set_volume(config_.mixer.volume);
    const std::size_t end = word.find(":=");
    ros::param::set("~" + word.substr(0, end), word.substr(end + 2));
    saver_->save(word);
  }

  void report(const std::vector<person::SettingsSaver::Failure>& failures) {
    for (const auto& [cue, detail] : failures) {
      if (!detail.empty()) ROS_ERROR("%s", detail.c_str());
      news_.push_back(cue);
    }
  }

  /// \param called  once the driver was told, if that is another command
  void move_motors(const haptics::Rumble& rumble, std::optional<haptics::Pattern> pattern,
                   double time, const std::function<void()>& called = {}) {
    devices::Gamepad* pad = source_.pad();
    if (pad != nullptr) pad->rumble(rumble, called);
    const haptics::RumbleOutput::Due due = rumble_output_.update(rumble, time);
    if (due.feedback) motors_.publish(feedback_msg(rumble, config_.motors));
    if (pad == nullptr && due.moved && called) called();
    // The record holds what can have been felt.
    if (due.changed && motors_there()) publish({rumble_event(rumble, pattern, ++rumble_id_)});
  }

  /// Our own pad's, or those of another driver.
  [[nodiscard]] bool motors_there() {
    if (devices::Gamepad* pad = source_.pad())
      return pad->status().connected && pad->status().has_rumble;
    return source_.kind() == devices::InputSource::Kind::topic;
  }

  void say(const std::vector<cues::Cue>& cues, double time) {
    const bool pressed =
        std::any_of(cues.begin(), cues.end(), [](const cues::Cue& cue) { return cue.asked; });
    const std::vector<CueEvent> events = speech_.tick(cues, time, pressed);
    feedback_.note(events);
    publish(as_heard(events));
  }

  [[nodiscard]] bool by_topic() const { return config_.listener == "topic"; }
  /// What is played now reaches somebody.
  [[nodiscard]] bool heard() const {
    return by_topic() || mixer_.status().device == devices::Mixer::Status::Device::open;
  }

  /// Where sound is off there are no words.
  [[nodiscard]] std::vector<CueEvent> as_heard(const std::vector<CueEvent>& events) {
    if (!config_.speech && !by_topic()) return {};
    return heard_words_.of(events, heard());
  }

  [[nodiscard]] cues::Link audio_link() const {
    switch (mixer_.status().device) {
      case devices::Mixer::Status::Device::missing:
        return cues::Link::never;
      case devices::Mixer::Status::Device::lost:
        return cues::Link::lost;
      case devices::Mixer::Status::Device::open:
      case devices::Mixer::Status::Device::off:
        break;
    }
    return cues::Link::alive;
  }

  [[nodiscard]] std::vector<CueKind> notices() const {
    std::vector<CueKind> kinds;
    if (source_.pad()) kinds = notices_of(source_.pad()->status());
    if (twin_) kinds.push_back(CueKind::two_drivers);
    return kinds;
  }

  /// base_link in map
  [[nodiscard]] std::optional<navvi_types::Pose2> robot() const {
    try {
      return from_msg(tf_.lookupTransform("map", "base_link", ros::Time(0)).transform);
    } catch (const tf2::TransformException&) {
      return std::nullopt;
    }
  }

  void show(double time) {
    if (markers_time_ && time - *markers_time_ < 0.1) return;
    markers_time_ = time;
    visualization_msgs::MarkerArray markers = picture::guide_markers(
        config_.markers, feedback_.guidance_fresh(time) ? feedback_.guidance() : std::nullopt,
        path_, plates_);
    if (markers.markers == shown_.markers) return;
    shown_ = markers;
    picture::stamp(markers, ros::Time::now());
    markers_.publish(markers);
  }

  void publish(const std::vector<CueEvent>& events) {
    for (CueEvent event : events) {
      event.stamp = navvi_types::to_ns(ros::Time::now());
      cues_.publish(to_msg(event));
      if (event.stage == CueStage::started && event.modality() == Modality::speech)
        ROS_INFO("[%s] %s", event.word().c_str(), event.text.c_str());
    }
  }

  void diagnose() {
    diagnostic_msgs::DiagnosticArray array;
    array.header.stamp = ros::Time::now();
    std::optional<devices::Gamepad::Status> pad;
    if (source_.pad()) pad = source_.pad()->status();
    if (pad) explain_heartbeat(*pad);
    array.status = {pad_status(pad, devices::to_string(source_.kind()), last_hands_.live,
                               config_.feedback.haptics.enabled),
                    audio_status(mixer_.status()),
                    speech_status(speech_.status(), config_.speaker.voice),
                    latency_status(latencies_, feedback_.stopping_delay()), beat_status(beat_)};
    diagnostics_.publish(array);
    if (!ros::Time::isValid()) ROS_WARN_THROTTLE(5.0, "There is no /clock yet.");
  }

  /// Once for each pad, when its sensor has had time to begin.
  void explain_heartbeat(const devices::Gamepad::Status& pad) {
    if (pad.connections != pad_) {
      pad_ = pad.connections;
      pad_time_ = now();
    }
    if (!pad_time_ || !pad.connected || now() - *pad_time_ < kFirstBeat) return;
    pad_time_.reset();
    if (!pad.heartbeat)
      ROS_WARN(
          "%s streams no motion sensor. If its radio link freezes while the stick is held, the "
          "robot drives on until the system names the pad disconnected; by cable that is at once.",
          pad.name.c_str());
  }

  NodeConfig config_;
  core::Feedback feedback_;
  cues::Phrases plates_;  ///< what is written in the picture
  Beat beat_{kLate};
  devices::Latencies latencies_;  ///< of this trial; before all that times for it
  devices::Mixer mixer_;
  devices::SpeechChannel speech_;
  devices::EarconPlayer earcons_;
  devices::InputSource source_;
  haptics::RumbleOutput rumble_output_;

  ros::NodeHandle node_;
  tf2_ros::Buffer tf_;
  tf2_ros::TransformListener tf_listener_{tf_};
  ros::Publisher cmd_vel_, joy_out_, motors_, assistance_, goals_, requests_, cues_, markers_,
      diagnostics_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer tick_timer_, diagnostics_timer_;

  std::vector<Eigen::Vector2d> path_;  ///< m, in map
  std::vector<drive::Button> asked_;   ///< by topic, not answered yet
  std::vector<CueKind> news_;          ///< not said yet
  std::optional<person::PersonFile> person_;
  std::optional<person::SettingsSaver> saver_;
  bool twin_ = false;      ///< another node drives under the name of this one
  bool welcomes_ = false;  ///< the person's settings were loaded, and that is to be said

  unsigned pad_ = 0;                    ///< of the status: number of connections
  std::optional<double> pad_time_;      // s, of now(), since when; until its heartbeat is explained
  std::optional<double> markers_time_;  // s, of now()
  double last_tick_ = 0.0;              // s, of now()
  double woke_ = 0.0;                   // s, of now(), after it was halted
  bool told_to_run_ = false;            ///< by the last state of the trial, which is repeated
  bool runs_ = false;                   ///< a trial
  bool over_ = false;                   ///< and has ended, which is told
  drive::InputState last_hands_;
  std::uint32_t rumble_id_ = 0;
  std::optional<double> share_;     ///< of the person's speed, last published
  std::vector<std::string> found_;  ///< by the lesson, and saved
  std::string recorded_;            ///< of the lesson, as it is in the file
  std::uint32_t sound_id_ = 0;
  cues::HeardWords heard_words_;
  visualization_msgs::MarkerArray shown_;
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
