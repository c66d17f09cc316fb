#pragma once

namespace navvi_config {

/// Asks the system to run this program before others, so that a busy machine delays neither motors nor words. Call it
/// before the program has threads; they inherit it. The kernel grants it to root, or by a limit
/// (/etc/security/limits.d: "@audio - nice -10").
/// \param niceness  [-20, -1], of which -20 goes first
/// \returns whether it was granted
bool ask_for_priority(int niceness);

}  // namespace navvi_config
