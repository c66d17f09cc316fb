// The person's side: one stick in; rumble, speech and a bright path out.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>

#include <navvi_config/ros_parameters.hpp>

#include "cues/phrases.hpp"
#include "lessons/questionnaire.hpp"
#include "navvi_feedback/core/guide.hpp"
#include "node/beat.hpp"
#include "node/diagnostics.hpp"
#include "node/inlets.hpp"
#include "node/node_config.hpp"
#include "node/outlets.hpp"
#include "node/person_devices.hpp"
#include "node/settings.hpp"

namespace navvi_feedback::node {

using devices::Chain;
using devices::InputSource;
using devices::Latencies;
using core::Output;

namespace {

constexpr double kTick = 0.02;      // s
constexpr double kReport = 0.25;    // s; trial_node knows within a second that this node hangs
constexpr double kLate = 0.1;       // s between two ticks; below it hands and ears notice nothing
constexpr double kLastWords = 3.0;  // s, that the end of a session waits for them at most

/// Topics in, one beat of the guide, topics out.
class FeedbackNode {
 public:
  explicit FeedbackNode(const NodeConfig& config)
      : config_(config),
        settings_(config_),
        welcomes_(settings_.loaded()),
        words_(config.phrases_file()),
        guide_(config.feedback, words_),
        devices_(config),
        outlets_(node_, config, devices_.source().kind() != InputSource::Kind::topic),
        inlets_(node_, config, guide_, devices_,
                [this](std::optional<Chain> caused) { tick(caused); }) {
    config_.speaker = config.voice();  // for the record
    // The picture speaks the language of the session, and tells lengths in its unit.
    ros::param::set("navvi/phrases", config.phrases_file().string());
    ros::param::set("navvi/units", config.feedback->cues.wording.units);
    guide_.offer(settings_.values());
    ROS_INFO("The stick comes from the %s.", navvi_types::to_string(devices_.source().kind()));
    tick_timer_ =
        node_.createWallTimer(ros::WallDuration(kTick), [this](const ros::WallTimerEvent&) {
          if (now() - last_tick_ >= 0.9 * kTick) tick();
        });
    diagnostics_timer_ = node_.createWallTimer(ros::WallDuration(kReport),
                                               [this](const ros::WallTimerEvent&) { diagnose(); });
  }

  [[nodiscard]] bool saved() const { return settings_.saved(); }
  void stop_wheels() { outlets_.stop_wheels(); }
  /// Leaves nothing running, driving or speaking.
  void finish() {
    tick_timer_.stop();
    for (const Content& failure : settings_.finish()) guide_.announce(failure);
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
  /// At 50 Hz or more. \param caused  the chain that a message begins which has just come
  void tick(std::optional<Chain> caused = std::nullopt) {
    const auto begun = Latencies::Clock::now();
    std::function<void()> called;
    if (caused) called = [this, chain = *caused, begun] { devices_.latencies().add(chain, begun); };
    const double time = last_tick_ = now();
    if (beat_.becomes_late(time)) {
      ROS_WARN(
          "The computer is too busy: touch and words come late. Close other programs; "
          "doc/driving.md says how NavVI goes before them.");
      guide_.announce({CueKind::notice, About::machine_slow});
    }
    for (const Content& failure : settings_.failures()) guide_.announce(failure);
    if (outlets_.is_picture_back()) guide_.announce({CueKind::back, About::picture});
    // A reader of words by topic comes a moment after this node.
    if (welcomes_ && (config_.listener != "topic" || outlets_.are_words_read())) {
      welcomes_ = false;
      guide_.announce({CueKind::settings, About::of});
    }
    senses::Devices devices = devices_.read(time);
    inlets_.complete(devices);
    const auto told = guide_.update(devices, time);
    if (!told) return;
    inlets_.forget_buttons();
    live_ = devices.hands.live;
    if (live_) outlets_.send(devices.hands);
    tell(*told, called);
    const auto guidance = guide_.guidance_fresh(time) ? guide_.guidance() : std::nullopt;
    const bool ahead = !(guidance && guidance->leads()) && inlets_.preview().size() > 1;
    outlets_.show(guide_.order());
    outlets_.show(ahead ? picture::preview_of(inlets_.preview()) : guidance,
                  ahead ? inlets_.preview() : inlets_.path(), told->stops_at, words_, time);
  }

  void tell(const Output& told, const std::function<void()>& called) {
    settings_.keep(told);
    if (told.lesson_over) navvi_config::end();
    if (!told.change.empty()) change(told.change);
    if (told.alarm_begins)
      ROS_WARN("There is no audio device: nothing is heard. %s", devices_.audio().detail.c_str());
    const bool own_pad = devices_.move_motors(told.rumble, called);
    outlets_.send(told);
    if (!own_pad && told.rumble_moved && called) called();
    std::vector<CueEvent> events;
    for (const sounds::Play& sound : devices_.obey(told)) events.push_back(guide_.event_of(sound));
    for (const auto& lasting : {told.felt, told.flowed})
      if (lasting) events.push_back(*lasting);
    events.insert(events.end(), told.said.begin(), told.said.end());
    outlets_.send(events);
  }

  /// Holds from now on: here, in the records of trials to come, and if this node is started anew.
  void change(const std::string& word) {
    settings_.change(word);
    guide_.use(config_.feedback);
    devices_.use(config_.speaker.rate, config_.mixer.volume);
  }

  void diagnose() {
    diagnostic_msgs::DiagnosticArray array;
    array.header.stamp = ros::Time::now();
    const auto pad = devices_.pad();
    if (const auto notice = pad ? heartbeat_.notice(*pad, now()) : std::nullopt)
      ROS_WARN("%s", notice->c_str());
    array.status = {pad_status(pad, navvi_types::to_string(devices_.source().kind()), live_,
                               config_.feedback->haptics.enabled),
                    audio_status(devices_.audio()),
                    speech_status(devices_.voice(), config_.speaker.voice),
                    latency_status(devices_.latencies(), guide_.learnt()), beat_status(beat_)};
    outlets_.send(array);
    // ROS_WARN_THROTTLE goes by the time that is missing.
    clockless_ = ros::Time::isValid() ? 0 : clockless_ + 1;
    if (clockless_ % 20 == 10) ROS_WARN("There is no /clock yet.");
  }

  NodeConfig config_;
  Settings settings_;
  bool welcomes_;  ///< the person's settings were loaded, and that is to be said
  cues::Phrases words_;  ///< of the guide and the picture
  core::Guide guide_;
  PersonDevices devices_;
  Beat beat_{kLate};
  HeartbeatNotice heartbeat_;

  ros::NodeHandle node_;
  Outlets outlets_;
  Inlets inlets_;
  ros::WallTimer tick_timer_, diagnostics_timer_;

  int clockless_ = 0;       ///< reports so far without a time
  bool live_ = false;       ///< the stick, at the last beat
  double last_tick_ = 0.0;  // s, of now()
};

void spin(FeedbackNode& node) {
  navvi_config::spin();
  if (!ros::ok()) return;
  navvi_config::ends_alone() ? node.stop_wheels() : node.finish();
  navvi_config::flush();
}

}  // namespace
}  // namespace navvi_feedback::node

int main(int argc, char** argv) {
  using navvi_feedback::node::NodeConfig;
  using navvi_feedback::node::PersonConfig;
  using navvi_feedback::person::PersonFile;
  if (const auto code =
          navvi_config::print_parameters<NodeConfig>(argc, argv, [](const NodeConfig& config) {
            using namespace navvi_feedback;
            const core::Guide would_start(config.feedback, cues::Phrases(config.phrases_file()));
            if (const std::string& asked = config.feedback->questions; !asked.empty())
              static_cast<void>(lessons::read_questions(asked));
            return config.person.empty() ? YAML::Node(YAML::NodeType::Map)
                                         : PersonFile::of<PersonConfig>(config.person).load();
          }))
    return *code;
  navvi_config::ask_for_priority(-10);
  navvi_config::init(argc, argv, "feedback_node");
  return navvi_config::run_node<NodeConfig>([](const NodeConfig& config) {
    navvi_feedback::node::FeedbackNode node(config);
    navvi_feedback::node::spin(node);
    return node.saved() ? 0 : 1;
  });
}
