#include "link/delay_line.hpp"

#include <cmath>

namespace navvi_feedback::link {

void LinkConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(delay, "delay", Range{0.0, 5.0}, "s",
        "of a simulated connection between person and robot, one way");
  visit(jitter, "jitter", Range{0.0, 1.0}, "s",
        "mean of what comes on top of it, drawn for each message; only commands overtake one another");
  visit(loss, "loss", Range{0.0, 0.2}, "",
        "share of its packets; each holds up its topic until it is sent again, but commands");
  visit(outage, "outage", Range{0.0, 30.0}, "s", "for which it is silent once a minute");
  visit(bandwidth, "bandwidth", Range{0.0, 1e6}, "kB/s",
        "of it; of each topic only the newest message waits; 0: any");
}

double Channel::outage_left(double sent) const {
  constexpr double kEvery = 60.0;     // s, from one outage to the next
  constexpr double kOutageAt = 30.0;  // s of each such time; alike for all that is sent
  const double since = std::fmod(sent, kEvery) - kOutageAt;
  return since >= 0.0 && since < config_.outage ? config_.outage - since : 0.0;
}

double Channel::way() {
  if (config_.jitter == 0.0) return config_.delay;
  return config_.delay - config_.jitter * std::log(1.0 - random_.uniform(0.0, 1.0));
}

double Channel::in_stream(double sent) {
  constexpr double kAgain = 0.2;  // s, after which a packet is sent again at the earliest (Linux)
  double at = sent + outage_left(sent) + way();
  if (config_.loss > 0.0 && random_.chance(config_.loss))
    at += std::max(kAgain, 2.0 * config_.delay);
  return last_ = std::max(last_, at);
}

std::optional<double> Channel::alone(double sent) {
  const bool lost = config_.loss > 0.0 && random_.chance(config_.loss);
  if (lost || outage_left(sent) > 0.0) return std::nullopt;
  return sent + way();
}

}  // namespace navvi_feedback::link
