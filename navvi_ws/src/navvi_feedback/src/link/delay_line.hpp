#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <iterator>
#include <navvi_types/random.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "navvi_config/field.hpp"

namespace navvi_feedback::link {

/// A simulated connection between the person and the robot, each way by itself.
struct LinkConfig {
  double delay = 0.0;      ///< s, one way
  double jitter = 0.0;     ///< s, mean of what comes on top of the delay
  double loss = 0.0;       ///< share of the packets
  double outage = 0.0;     ///< s, once a minute
  double bandwidth = 0.0;  ///< kB/s; 0: any

  void describe(navvi_config::Visitor& visit);
  [[nodiscard]] bool simulated() const {
    return delay > 0.0 || jitter > 0.0 || loss > 0.0 || outage > 0.0 || bandwidth > 0.0;
  }
};

/// When what is sent arrives. Times are s of one clock that does not run backwards.
class Channel {
 public:
  Channel(const LinkConfig& config, std::uint64_t seed) : config_(config), random_(seed) {}

  /// By a stream, as TCP keeps it: in order, and a lost packet holds up what follows until it is
  /// sent again.
  [[nodiscard]] double in_stream(double sent);
  /// By a packet of its own, as of UDP. \return nullopt: it is lost
  [[nodiscard]] std::optional<double> alone(double sent);

 private:
  /// s; 0 outside of an outage
  [[nodiscard]] double outage_left(double sent) const;
  [[nodiscard]] double way();

  LinkConfig config_;
  navvi_types::Random random_;
  double last_ = 0.0;  ///< s, of the last arrival in the stream
};

/// Hands over values when they have arrived.
template <typename Value>
class DelayLine {
 public:
  /// \param streams  each keeps the order in which values were sent, and does not wait for what
  /// another has lost, as the topics of ROS; 0: each value has a packet of its own, and what a later
  /// one has overtaken is dropped
  DelayLine(const LinkConfig& config, std::uint64_t seed, std::size_t streams)
      : alone_(streams == 0),
        takes_(config.bandwidth > 0.0 ? kMessage / config.bandwidth : 0.0),
        begins_(std::max<std::size_t>(1, streams)) {
    for (std::size_t stream = 0; stream < std::max<std::size_t>(1, streams); ++stream)
      channels_.emplace_back(config, 1000 * seed + stream);
  }

  void send(Value value, double time, std::size_t stream = 0) {
    if (begins_.at(stream) > time) return replace(std::move(value), time, stream);
    begins_[stream] = std::max(time, free_);
    free_ = begins_[stream] + takes_;
    Channel& channel = channels_.at(stream);
    const auto arrival = alone_ ? channel.alone(free_) : std::optional(channel.in_stream(free_));
    if (!arrival) return;
    auto after = under_way_.end();
    while (after != under_way_.begin() && std::prev(after)->arrival > *arrival) --after;
    if (alone_) after = under_way_.erase(after, under_way_.end());
    under_way_.insert(after, {*arrival, time, stream, std::move(value)});
  }
  /// \param take  called with each value that has arrived, and the time at which it was sent
  template <typename Take>
  void receive(double time, const Take& take) {
    for (; !under_way_.empty() && under_way_.front().arrival <= time; under_way_.pop_front())
      take(under_way_.front().value, under_way_.front().sent);
  }

 private:
  static constexpr double kMessage = 0.3;  ///< kB with all headers, about

  struct Sent {
    double arrival, sent;  ///< s
    std::size_t stream;
    Value value;
  };

  /// The last value of the stream has not left yet: this one goes in its place.
  void replace(Value value, double time, std::size_t stream) {
    const auto last = std::find_if(under_way_.rbegin(), under_way_.rend(),
                                   [&](const Sent& one) { return one.stream == stream; });
    if (last == under_way_.rend()) return;  // it is to be lost
    last->sent = time;
    last->value = std::move(value);
  }

  bool alone_;
  double takes_;                ///< s, of a message at the link's bandwidth
  double free_ = 0.0;           ///< s, when all that was sent has left
  std::vector<double> begins_;  ///< s, when the last of each stream leaves or left
  std::vector<Channel> channels_;
  std::deque<Sent> under_way_;
};

}  // namespace navvi_feedback::link
