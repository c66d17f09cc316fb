#include "node/node_config.hpp"

#include <ros/package.h>

#include "cues/phrases.hpp"

namespace navvi_feedback::node {

using navvi_config::Any;
using navvi_config::OneOf;

void PersonConfig::describe(navvi_config::Visitor& visit) {
  visit(language, "language", OneOf{{"en", "es"}}, "", "English or Spanish");
  visit(phrases, "phrases", Any{}, "",
        "path of a phrase file for any other language; empty for the one that ships");
  feedback.describe(visit);
  visit.group("speaker", speaker);
  visit.group("mixer", mixer);
}

void NodeConfig::describe(navvi_config::Visitor& visit) {
  visit(input, "input", OneOf{{"auto", "pad", "keyboard", "topic"}}, "",
        "where the stick comes from; topic: joy from another driver");
  visit(speech, "speech", Any{}, "", "false: our own voice and sounds are silent");
  visit(listener, "listener", OneOf{{"device", "topic"}}, "",
        "the sound device, or a reader of navvi/cues, such as a simulated person or a screen "
        "reader, with or without a device");
  visit(
      motors, "motors", OneOf{{"joy_node", "ds4_driver"}}, "",
      "driver of the motors by joy/set_feedback: motor 0 is the strong, left one to joy_node, the "
      "weak, right one to ds4_driver (with its use_standard_msgs)");
  visit(odom_frame, "odom_frame", Any{}, "",
        "frame of odometry, which a localizer places in the map");
  visit(emergency_stop, "emergency_stop", Any{}, "",
        "topic with std_msgs/Bool, true while the robot's emergency stop is pressed; empty: none");
  visit(battery, "battery", Any{}, "", "topic with sensor_msgs/BatteryState; empty: none");
  visit(person, "person", Any{}, "",
        "in whose file settings are kept that are changed while driving; ./navvi run lays what is "
        "in it over the profile's");
  visit(record, "record", Any{}, "", "path of a file for how a lesson went; empty for none");
  visit(feedback->lesson, "lesson",
        OneOf{{"none", "glossary", "tutorial", "calibrate", "questionnaire"}}, "",
        "lesson or questionnaire that comes first; all but the tutorial need no robot");
  visit(feedback->questions, "questions", Any{}, "", "path of the file that a questionnaire asks");
  visit(feedback->locked, "locked", Any{}, "",
        "true: the menu offers neither goals nor settings, as a study has set them");
  visit(feedback->places, "places", Any{}, "",
        "path of a file with places by name that the menu offers as goals (doc/robot.md)");
  PersonConfig::describe(visit);
}

std::filesystem::path NodeConfig::phrases_file() const {
  if (!phrases.empty()) return phrases;
  return ros::package::getPath("navvi_feedback") + "/config/phrases/" + language + ".yaml";
}

devices::SpeakerConfig NodeConfig::voice() const {
  devices::SpeakerConfig voice = speaker;
  if (voice.voice.empty()) voice.voice = cues::Phrases(phrases_file()).voice();
  return voice;
}

}  // namespace navvi_feedback::node
