// Preloaded into every process of a session: a socket that would listen on all interfaces listens
// at the address ROS_IP alone, such as that of a tunnel, or on the loopback interface. roscpp offers
// no setting for its XML-RPC port. No small message waits for the acknowledgement of the last one,
// which takes a round trip: ROS leaves that to each subscriber, and its own /clock and calls of the
// master have no setting. Where a connection is slow, messages wait in ROS's short queue, which
// drops the oldest, and not in the system's, which keeps seconds of them; and a machine whose
// default is BBR, which lets four packets pass in one round trip of each ten seconds, uses CUBIC,
// if it has that. And each ends with roslaunch, ROS's own programs too.

#include <arpa/inet.h>
#include <dlfcn.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cstdlib>
#include <cstring>
#include <navvi_config/launcher.hpp>

namespace {

constexpr int kUnsent = 8192;  // bytes that may wait in the system
constexpr char kCongestion[] = "cubic";

[[gnu::constructor]] void begin() { navvi_config::end_with_launcher(); }

in_addr own_address() {
  in_addr address{htonl(INADDR_LOOPBACK)};
  if (const char* const given = std::getenv("ROS_IP")) inet_pton(AF_INET, given, &address);
  return address;
}

/// The function of that name that this library stands in front of.
template <typename Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

/// What it accepts later inherits the options. A socket that is not of TCP rejects them.
extern "C" int socket(int domain, int type, int protocol) noexcept {
  static const auto make = next<int (*)(int, int, int)>("socket");
  const int made = make(domain, type, protocol);
  const int on = 1;
  if (made >= 0) {
    setsockopt(made, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    setsockopt(made, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kUnsent, sizeof(kUnsent));
    setsockopt(made, IPPROTO_TCP, TCP_CONGESTION, kCongestion, sizeof(kCongestion));
  }
  return made;
}

extern "C" int bind(int socket, const sockaddr* address, socklen_t length) noexcept {
  static const auto own = next<int (*)(int, const sockaddr*, socklen_t)>("bind");
  if (address != nullptr && address->sa_family == AF_INET && length >= sizeof(sockaddr_in)) {
    sockaddr_in local;
    std::memcpy(&local, address, sizeof(local));
    if (local.sin_addr.s_addr == htonl(INADDR_ANY)) local.sin_addr = own_address();
    return own(socket, reinterpret_cast<const sockaddr*>(&local), sizeof(local));
  }
  if (address != nullptr && address->sa_family == AF_INET6 && length >= sizeof(sockaddr_in6)) {
    sockaddr_in6 local;
    std::memcpy(&local, address, sizeof(local));
    if (std::memcmp(&local.sin6_addr, &in6addr_any, sizeof(in6_addr)) == 0)
      local.sin6_addr = in6addr_loopback;
    return own(socket, reinterpret_cast<const sockaddr*>(&local), sizeof(local));
  }
  return own(socket, address, length);
}
