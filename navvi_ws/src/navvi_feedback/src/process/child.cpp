#include "process/child.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>

extern char** environ;

namespace navvi_feedback::process {
namespace {

/// \param socket  becomes the child's standard input \return -1 if it cannot be started
pid_t start(std::vector<std::string>& words, int socket) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  sigset_t none;
  ::sigemptyset(&none);
  posix_spawn_file_actions_t files;
  posix_spawnattr_t how;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, socket, STDIN_FILENO);
  ::posix_spawnattr_init(&how);
  // A group of its own: the signal that ends a session must not cut its last words.
  ::posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  ::posix_spawnattr_setpgroup(&how, 0);
  ::posix_spawnattr_setsigmask(&how, &none);
  pid_t id = -1;
  if (::posix_spawn(&id, arguments[0], &files, &how, arguments.data(), environ) != 0) id = -1;
  ::posix_spawnattr_destroy(&how);
  ::posix_spawn_file_actions_destroy(&files);
  return id;
}

}  // namespace

Child::Child(const std::string& program, std::vector<std::string> arguments) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  arguments.insert(arguments.begin(), (self.parent_path() / program).string());
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
  socket_ = ends[0];
  id_ = start(arguments, ends[1]);
  ::close(ends[1]);
}

Child::~Child() {
  if (!gone()) {
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }
  if (socket_ >= 0) ::close(socket_);
}

bool Child::send(std::int32_t value, std::string_view bytes) const {
  return process::send(socket_, value, bytes, MSG_DONTWAIT);
}

std::optional<Frame> Child::receive(Clock::time_point until) const {
  return socket_ < 0 ? std::nullopt : process::receive(socket_, until);
}

bool Child::gone() {
  if (id_ > 0 && ::waitpid(id_, nullptr, WNOHANG) != 0) id_ = -1;
  return id_ < 0;
}

}  // namespace navvi_feedback::process
