#include "navvi_config/priority.hpp"

#include <sys/resource.h>

#include <fstream>

namespace navvi_config {

bool ask_for_priority(int niceness) {
  const bool granted = setpriority(PRIO_PROCESS, 0, niceness) == 0;
  // Where the kernel shares the processor among sessions, a niceness counts inside of one only; roslaunch gives each node a
  // session of its own, and this is that session's.
  if (granted) std::ofstream("/proc/self/autogroup") << niceness;
  return granted;
}

}  // namespace navvi_config
