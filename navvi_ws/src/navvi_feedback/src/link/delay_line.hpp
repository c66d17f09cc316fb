#pragma once

#include <cstdint>
#include <deque>
#include <navvi_types/random.hpp>
#include <utility>

#include "link/link_config.hpp"

namespace navvi_feedback::link {

/// When what is sent arrives by a stream, as TCP keeps it: in order, and a lost packet holds up
/// what follows until it is sent again. Times are s of one clock that does not run backwards.
class Channel {
 public:
  Channel(const LinkConfig& config, std::uint64_t seed) : config_(config), random_(seed) {}

  [[nodiscard]] double arrival(double sent);

 private:
  LinkConfig config_;
  navvi_types::Random random_;
  double outage_ = 0.0;  ///< s, when the next one begins
  double last_ = 0.0;    ///< s, of the last arrival
};

/// Hands over values in the order in which they were sent, each when it has arrived.
template <typename Value>
class DelayLine {
 public:
  DelayLine(const LinkConfig& config, std::uint64_t seed) : channel_(config, seed) {}

  void send(Value value, double time) {
    under_way_.push_back({channel_.arrival(time), time, std::move(value)});
  }
  /// \param take  called with each value that has arrived, and the time at which it was sent
  template <typename Take>
  void receive(double time, const Take& take) {
    for (; !under_way_.empty() && under_way_.front().arrival <= time; under_way_.pop_front())
      take(under_way_.front().value, under_way_.front().sent);
  }

 private:
  struct Sent {
    double arrival, sent;  ///< s
    Value value;
  };
  Channel channel_;
  std::deque<Sent> under_way_;
};

}  // namespace navvi_feedback::link
