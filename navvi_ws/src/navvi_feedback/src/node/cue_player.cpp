// Plays recorded cues again: what was heard and felt, when it was. It never drives.

#include <ros/ros.h>
#include <sensor_msgs/JoyFeedbackArray.h>

#include <navvi_config/ros_parameters.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/subscribe.hpp>

#include "devices/earcons.hpp"
#include "devices/gamepad.hpp"
#include "devices/speaker.hpp"
#include "haptics/rumble_output.hpp"
#include "core/events.hpp"
#include "navvi_feedback/node/msg_conversion.hpp"
#include "sounds/sounds_config.hpp"

namespace navvi_feedback::node {
namespace {

/// s of wall time; once the recording's clock has stood for so long, the motors rest.
constexpr double kStanding = 0.5;

struct PlayerConfig {
  bool speech = true;
  devices::SpeakerConfig speaker;
  devices::MixerConfig mixer;

  void describe(navvi_config::Visitor& visit) {
    visit(speech, "speech", navvi_config::Any{}, "", "false: nothing is heard");
    visit.group("speaker", speaker);
    visit.group("mixer", mixer);
  }
};

class CuePlayer {
 public:
  explicit CuePlayer(const PlayerConfig& config)
      : mixer_(config.mixer, config.speech ? devices::Audio::on : devices::Audio::off),
        speaker_(config.speaker, mixer_),
        earcons_(mixer_) {
    const devices::Mixer::Status status = mixer_.status();
    if (status.device == devices::Mixer::Status::Device::missing)
      ROS_WARN("Nothing will be heard: %s.", status.detail.c_str());
    ROS_INFO("The voice is %s, at %d words a minute and pitch %d.",
             config.speaker.voice.empty() ? "en" : config.speaker.voice.c_str(),
             config.speaker.rate, config.speaker.pitch);
    feedback_ = node_.advertise<sensor_msgs::JoyFeedbackArray>("joy/set_feedback", 10);
    cues_ = navvi_types::subscribe<navvi_msgs::Cue>(
        node_, "navvi/cues", 100, navvi_types::from_msg,
        [this](const navvi_types::CueEvent& cue) { take(cue); });
    motor_timer_ = node_.createWallTimer(ros::WallDuration(0.02),
                                         [this](const ros::WallTimerEvent&) { move_motors(); });
  }

 private:
  void take(const navvi_types::CueEvent& cue) {
    if (cue.modality() == navvi_types::Modality::rumble) {
      rumble_ = {cue.left, cue.right};
    } else if (cue.word() == to_string(sounds::Earcon::flow)) {
      (void)earcons_.hold({cue.left, cue.right}, sounds::FamilyConfig().volume);
    } else if (const auto sound = core::sound_of(cue)) {
      (void)earcons_.play({*sound});
    } else if (cue.modality() != navvi_types::Modality::speech) {
      return;
    } else if (cue.stage == CueStage::started) {
      ROS_INFO("[%s] %s", cue.word().c_str(), cue.text.c_str());
      speaking_ = cue.id;
      speaker_.start(cue.text);
    } else if (cue.stage == CueStage::cut && speaking_ == cue.id) {
      speaker_.stop();
    }
  }

  void move_motors() {
    const double wall = ros::SteadyTime::now().toSec();
    const ros::Time stamp = ros::Time::now();
    if (stamp != last_stamp_) moved_at_ = wall;
    last_stamp_ = stamp;
    if (wall - moved_at_ > kStanding) rumble_ = {};
    pad_.rumble(rumble_);
    if (output_.update(rumble_, wall).feedback) feedback_.publish(feedback_msg(rumble_));
  }

  devices::Mixer mixer_;
  devices::Speaker speaker_;
  devices::EarconPlayer earcons_;
  devices::Gamepad pad_;
  haptics::RumbleOutput output_;
  haptics::Rumble rumble_;
  std::uint32_t speaking_ = 0;
  ros::Time last_stamp_;
  double moved_at_ = 0.0;  // s, steady

  ros::NodeHandle node_;
  ros::Publisher feedback_;
  ros::Subscriber cues_;
  ros::WallTimer motor_timer_;
};

}  // namespace
}  // namespace navvi_feedback::node

int main(int argc, char** argv) {
  using navvi_feedback::node::PlayerConfig;
  if (const auto code = navvi_config::print_parameters<PlayerConfig>(argc, argv)) return *code;
  navvi_config::init(argc, argv, "cue_player");
  return navvi_config::run_node<PlayerConfig>([](const PlayerConfig& config) {
    const navvi_feedback::node::CuePlayer player(config);
    navvi_config::spin();
    return 0;
  });
}
