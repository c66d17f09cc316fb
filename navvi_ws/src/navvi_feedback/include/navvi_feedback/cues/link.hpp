#pragma once

namespace navvi_feedback::cues {

/// State of a stream of messages, or of a device.
enum class Link { never, alive, lost };

/// All that a person depends on.
struct Links {
  Link pad = Link::never;
  Link simulator = Link::never;  ///< /clock or, on a robot, the odometry
  Link proximity = Link::never;
  Link guidance = Link::never;
  Link audio = Link::never;
};

}  // namespace navvi_feedback::cues
