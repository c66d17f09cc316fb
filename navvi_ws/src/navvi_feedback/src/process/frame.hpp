#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navvi_feedback::process {

using Clock = std::chrono::steady_clock;

/// What goes over the socket between a node and a program of its devices.
struct Frame {
  std::int32_t value = 0;  ///< what it means is the program's own matter
  std::string bytes;
};

/// \param flags  of send(2): 0 waits for a peer that reads slowly, MSG_DONTWAIT does not
/// \return false if the peer is gone, or would have to be waited for
[[nodiscard]] bool send(int socket, std::int32_t value, std::string_view bytes, int flags = 0);

/// \param until  the time to give up at; the past: a frame that is there already, or none
/// \return nullopt if there is no whole frame by then, or the peer is gone
[[nodiscard]] std::optional<Frame> receive(int socket, Clock::time_point until);

/// For the program of a device, at its start: its socket, which it shares with the node that it
/// ends with. It keeps no other file of that node.
[[nodiscard]] int socket_of_parent();

}  // namespace navvi_feedback::process
