#pragma once

#include <string>

#include "record/figures.hpp"

namespace navvi_study::record {

/// The events of R-TRL-1 and whatever else happened, as CSV with a header: onset since the start
/// and duration, in simulated seconds, then whose it was, what, where, and the running counts.
/// Units are in the columns' names.
[[nodiscard]] std::string events_csv(const Trial& trial);

}  // namespace navvi_study::record
