#pragma once

#include <string>
#include <utility>
#include <vector>

#include "record/row.hpp"

namespace navvi_study::record {

/// Column name and cell, in order; "n/a" where there is no value.
using Summary = std::vector<std::pair<std::string, std::string>>;

/// The events of R-TRL-1 and whatever else happened, as CSV with a header: onset since the start
/// and duration, in simulated seconds, then whose it was, what, where, and the running counts.
/// Units are in the columns' names.
[[nodiscard]] std::string events_csv(const std::vector<Row>& rows);

/// One line for the trial (R-TRL-2), a pure function of its journal. A journal without an end is
/// aborted; one without a start has no figures.
[[nodiscard]] Summary summarize(const std::vector<Row>& rows);

/// ms, how long the person waited: p50, p99 and max of each chain of feedback_node, from
/// sensing to its message, from that to the motors, a contact to its pattern, a cue to its first
/// sample, a button to the answer, and the end of words to silence.
[[nodiscard]] std::vector<std::string> latency_columns();

/// These, and what else feedback_node reports with them and the record keeps of the end of a trial:
/// stopping_delay_s, s, that the person was last found to take to stop a turn, stopping_spread_s,
/// s, its standard deviation, turn_error_rad, rad, what was left of turns that a sound led, mean of
/// the latest, and words_lead, yes where words had taken over, as that was too much.
[[nodiscard]] std::vector<std::string> reported_columns();

/// A header and one row.
[[nodiscard]] std::string summary_csv(const Summary& summary);
/// nullopt for a text that summary_csv() does not write.
[[nodiscard]] std::optional<Summary> parse_summary(const std::string& text);

/// A sentence for each column that differs; `bag` is left out, as no bag holds how it was
/// closed.
[[nodiscard]] std::vector<std::string> differences(const Summary& summary, const Summary& recount);

}  // namespace navvi_study::record
