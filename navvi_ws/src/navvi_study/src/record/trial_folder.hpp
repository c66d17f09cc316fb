#pragma once

#include <ctime>
#include <filesystem>
#include <navvi_files/files.hpp>
#include <string>
#include <vector>

#include "record/figures.hpp"

namespace navvi_study::record {

/// A time of the calendar in the form of ISO 8601, such as 2026-01-31T12:00:00.250Z. \param utc_ns
/// ns since 1970
[[nodiscard]] std::string calendar(std::int64_t utc_ns);

/// A new folder `trial-<UTC>` under `out`, which is created where it is missing; two in one second
/// get numbers. \throws std::runtime_error with a sentence
[[nodiscard]] std::filesystem::path create_trial_folder(const std::filesystem::path& out,
                                                        std::time_t utc);

/// The record in a folder: its journal up to the first damage, and its track.
[[nodiscard]] Trial read_trial(const std::filesystem::path& folder);

/// Writes events.csv and summary.csv; each is replaced as a whole.
[[nodiscard]] navvi_files::Problem write_results(
    const std::filesystem::path& folder, const Trial& trial,
    const navvi_files::SystemCalls& calls = navvi_files::SystemCalls::real());

/// Brings every trial under `out` in order that a crash left open. \return sentences, one a trial
/// that was changed or could not be
[[nodiscard]] std::vector<std::string> recover_trials(
    const std::filesystem::path& out,
    const navvi_files::SystemCalls& calls = navvi_files::SystemCalls::real());

}  // namespace navvi_study::record
