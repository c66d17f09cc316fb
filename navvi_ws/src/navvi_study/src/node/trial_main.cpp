// Runs trials: sets the goal, keeps the journal, the bag and the results. See trial_node.hpp.

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <signal.h>

#include <navvi_config/ros_parameters.hpp>
#include <stdexcept>

#include "node/trial_node.hpp"

namespace {

volatile sig_atomic_t asked_to_stop = 0;

void ask_to_stop(int) { asked_to_stop = 1; }

}  // namespace

int main(int argc, char** argv) {
  using navvi_study::trial::TrialNodeConfig;
  if (navvi_config::print_parameters<TrialNodeConfig>(argc, argv)) return 0;
  ros::init(argc, argv, "trial_node", ros::init_options::NoSigintHandler);
  signal(SIGINT, ask_to_stop);
  signal(SIGTERM, ask_to_stop);
  signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error of write(), as any other
  return navvi_config::run_node<TrialNodeConfig>([](const TrialNodeConfig& config) {
    navvi_study::node::TrialNode trials(config);
    while (ros::ok()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
      if (asked_to_stop) trials.shut_down();
    }
    return trials.exit_code();
  });
}
