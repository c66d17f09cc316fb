#include "process/frame.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace navvi_feedback::process {
namespace {

struct Header {
  std::int32_t value;
  std::uint32_t size;
};
constexpr std::uint32_t kLargest = 4'000'000;  // bytes, of a frame; a minute of speech is less

bool send_all(int socket, const char* from, std::size_t size, int flags) {
  while (size > 0) {
    const ssize_t sent = ::send(socket, from, size, flags | MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    from += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, char* to, std::size_t size, Clock::time_point until) {
  while (size > 0) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd ready{socket, POLLIN, 0};
    const int found = ::poll(&ready, 1, static_cast<int>(std::max<long>(0, left)));
    if (found < 0 && errno == EINTR) continue;
    if (found <= 0) return false;
    const ssize_t got = ::recv(socket, to, size, MSG_DONTWAIT);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got <= 0) return false;
    to += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

bool send(int socket, std::int32_t value, std::string_view bytes, int flags) {
  const Header header{value, static_cast<std::uint32_t>(bytes.size())};
  return send_all(socket, reinterpret_cast<const char*>(&header), sizeof header, flags) &&
         send_all(socket, bytes.data(), bytes.size(), flags);
}

std::optional<Frame> receive(int socket, Clock::time_point until) {
  Header header{};
  if (!receive_all(socket, reinterpret_cast<char*>(&header), sizeof header, until) ||
      header.size > kLargest)
    return std::nullopt;
  Frame frame{header.value, std::string(header.size, '\0')};
  // The rest follows at once, unless the peer hangs.
  const auto rest = std::max(until, Clock::now() + std::chrono::milliseconds(100));
  if (!receive_all(socket, frame.bytes.data(), frame.bytes.size(), rest)) return std::nullopt;
  return frame;
}

int socket_of_parent() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  return STDIN_FILENO;
}

}  // namespace navvi_feedback::process
