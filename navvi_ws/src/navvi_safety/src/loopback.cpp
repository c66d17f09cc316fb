// Preloaded into every process of a session that must not be reached from outside: a socket that
// would listen on all interfaces listens on the loopback interface alone. roscpp offers no setting
// for its XML-RPC port. And each ends with roslaunch, ROS's own programs too.

#include <dlfcn.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>
#include <navvi_config/launcher.hpp>

namespace {

[[gnu::constructor]] void begin() { navvi_config::end_with_launcher(); }

}  // namespace

extern "C" int bind(int socket, const sockaddr* address, socklen_t length) noexcept {
  using Bind = int (*)(int, const sockaddr*, socklen_t);
  static const auto next = reinterpret_cast<Bind>(dlsym(RTLD_NEXT, "bind"));
  if (address != nullptr && address->sa_family == AF_INET && length >= sizeof(sockaddr_in)) {
    sockaddr_in local;
    std::memcpy(&local, address, sizeof(local));
    if (local.sin_addr.s_addr == htonl(INADDR_ANY)) local.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
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
