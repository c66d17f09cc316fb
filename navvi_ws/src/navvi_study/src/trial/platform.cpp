#include "trial/platform.hpp"

#include <algorithm>
#include <fstream>

namespace navvi_study::trial {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t at = line.find(": ");
    if (at == std::string::npos) break;
    std::string name = line.substr(at + 2);
    std::replace(name.begin(), name.end(), ',', ' ');
    return name;
  }
  return "n/a";
}

std::string compiler() {
#ifdef __clang__
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

std::string bullet() { return BULLET_VERSION; }

}  // namespace navvi_study::trial
