#pragma once

#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace navvi_config {

/// The process that started this one, as it was at the first call.
[[nodiscard]] inline pid_t first_parent() {
  static const pid_t parent = ::getppid();
  return parent;
}

[[nodiscard]] inline bool parent_has_ended() { return ::getppid() != first_parent(); }

/// Whether `process` is roslaunch, or a rostest that does its work.
[[nodiscard]] inline bool is_roslaunch(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/cmdline");
  const std::string line{std::istreambuf_iterator<char>(file), {}};
  // Each argument ends with a zero.
  return line.find(std::string("/roslaunch") + '\0') != line.npos ||
         line.find(std::string("/rostest") + '\0') != line.npos;
}

/// Lets this process end with the roslaunch that started it, also where that is killed and can end
/// none itself: nothing would supervise what it leaves, and its master's port would stay taken.
/// The environment variable NAVVI_LAUNCHER names that roslaunch where its end may come first.
inline void end_with_launcher() {
  const pid_t parent = first_parent();
  const char* const named = std::getenv("NAVVI_LAUNCHER");
  pid_t launcher = is_roslaunch(parent) ? parent : 0;
  if (named != nullptr) launcher = static_cast<pid_t>(std::atoi(named));
  if (launcher <= 0) return;
  if (parent == launcher) ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  const bool gone = ::kill(launcher, 0) != 0 && errno == ESRCH;
  if (gone || parent_has_ended()) ::raise(SIGTERM);
}

}  // namespace navvi_config
