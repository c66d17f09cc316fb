#pragma once

#include <string>

namespace navvi_study::trial {

/// What this processor calls itself; n/a where the system does not tell.
[[nodiscard]] std::string processor();
/// That made this program, with its version.
[[nodiscard]] std::string compiler();
/// Version of the Bullet that the simulator was built with.
[[nodiscard]] std::string bullet();

}  // namespace navvi_study::trial
