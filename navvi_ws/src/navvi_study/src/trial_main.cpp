// Runs trials: sets the goal, keeps the journal, the bag and the results. See trial_node.hpp.

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <signal.h>

#include <navvi_config/ros_parameters.hpp>
#include <stdexcept>

#include "navvi_study/trial_node.hpp"

namespace {

volatile sig_atomic_t asked_to_stop = 0;

void ask_to_stop(int) { asked_to_stop = 1; }

}  // namespace

int main(int argc, char** argv) {
  if (navvi_config::tells_parameters<navvi_study::TrialNodeConfig>(argc, argv)) return 0;
  ros::init(argc, argv, "trial_node", ros::init_options::NoSigintHandler);
  ros::NodeHandle node;
  signal(SIGINT, ask_to_stop);
  signal(SIGTERM, ask_to_stop);
  signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error of write(), as any other
  try {
    navvi_study::TrialNode trials(
        navvi_config::load<navvi_study::TrialNodeConfig>(ros::NodeHandle("~")));
    while (ros::ok()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
      if (asked_to_stop) trials.shut_down();
    }
    return trials.exit_code();
  } catch (const navvi_config::ConfigError& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  } catch (const std::runtime_error& error) {
    ROS_FATAL("%s", error.what());
    return 3;
  }
}
