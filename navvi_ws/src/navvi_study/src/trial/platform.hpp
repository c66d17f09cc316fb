#pragma once

#include <optional>
#include <string>

namespace navvi_study::trial {

/// What this processor calls itself; n/a where the system does not tell.
[[nodiscard]] std::string processor();
/// That made this program, with its version.
[[nodiscard]] std::string compiler();
/// Version of the Bullet that the simulator was built with.
[[nodiscard]] std::string bullet();
/// The GNU build IDs of this program and of the libraries that it has loaded: programs with the
/// same ones compute the same on the same processor. nullopt if one of them has none.
[[nodiscard]] std::optional<std::string> build_ids();

}  // namespace navvi_study::trial
