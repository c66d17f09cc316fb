#pragma once

#include <string>

namespace navvi_study::trial {

/// What this processor calls itself; n/a where the system does not tell.
[[nodiscard]] std::string processor();
/// That made this program, with its version.
[[nodiscard]] std::string compiler();

}  // namespace navvi_study::trial
