#include "node/repetition_record.hpp"

#include <navvi_types/msg_conversion.hpp>

#include "navvi_sim/node/msg_conversion.hpp"

namespace navvi_sim::node {

RepetitionRecord::RepetitionRecord(ros::NodeHandle& node, const live::Session& session)
    : session_(session) {
  // A subscriber that comes in mid-session can still repeat it from its first step.
  applied_ = node.advertise<navvi_msgs::AppliedCommands>(
      "navvi/applied_commands", 1000, [this](const ros::SingleSubscriberPublisher& listener) {
        listener.publish(applied_commands_msg(session_.commands(), 0, stamp()));
      });
  hash_ = node.advertise<navvi_msgs::StateHash>("navvi/state_hash", 1, true);
}

void RepetitionRecord::publish() {
  if (commands_published_ < session_.commands().size()) {
    applied_.publish(applied_commands_msg(session_.commands(), commands_published_, stamp()));
    commands_published_ = session_.commands().size();
  }
  if (hashes_published_ < session_.hashes().size()) {
    hash_.publish(navvi_types::to_msg(session_.hashes().back()));
    hashes_published_ = session_.hashes().size();
  }
}

}  // namespace navvi_sim::node
