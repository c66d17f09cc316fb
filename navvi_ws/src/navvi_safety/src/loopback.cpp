// Preloaded into every process of a session: a socket that would listen on all interfaces listens
// at the address ROS_IP alone, such as that of a tunnel, or on the loopback interface. roscpp offers
// no setting for its XML-RPC port. And each ends with roslaunch, ROS's own programs too.

#include <arpa/inet.h>
#include <dlfcn.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdlib>
#include <cstring>
#include <navvi_config/launcher.hpp>

namespace {

[[gnu::constructor]] void begin() { navvi_config::end_with_launcher(); }

in_addr own_address() {
  in_addr address{htonl(INADDR_LOOPBACK)};
  if (const char* const given = std::getenv("ROS_IP")) inet_pton(AF_INET, given, &address);
  return address;
}

}  // namespace

extern "C" int bind(int socket, const sockaddr* address, socklen_t length) noexcept {
  using Bind = int (*)(int, const sockaddr*, socklen_t);
  static const auto next = reinterpret_cast<Bind>(dlsym(RTLD_NEXT, "bind"));
  if (address != nullptr && address->sa_family == AF_INET && length >= sizeof(sockaddr_in)) {
    sockaddr_in local;
    std::memcpy(&local, address, sizeof(local));
    if (local.sin_addr.s_addr == htonl(INADDR_ANY)) local.sin_addr = own_address();
    return next(socket, reinterpret_cast<const sockaddr*>(&local), sizeof(local));
  }
  if (address != nullptr && address->sa_family == AF_INET6 && length >= sizeof(sockaddr_in6)) {
    sockaddr_in6 local;
    std::memcpy(&local, address, sizeof(local));
    if (std::memcmp(&local.sin6_addr, &in6addr_any, sizeof(in6_addr)) == 0)
      local.sin6_addr = in6addr_loopback;
    return next(socket, reinterpret_cast<const sockaddr*>(&local), sizeof(local));
  }
  return next(socket, address, length);
}
