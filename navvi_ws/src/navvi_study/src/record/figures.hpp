#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "record/row.hpp"
#include "record/track.hpp"

namespace navvi_study::record {

/// The record of a trial: what happened, and how the robot and its person moved.
struct Trial {
  std::vector<Row> rows = {};
  Track track = {};  ///< empty where the record is older than tracks

  [[nodiscard]] const Row* first(const std::string& type) const;
  [[nodiscard]] const Row* last(const std::string& type) const;
  /// s, of ROS time, from TRIAL_START on; 0 without one
  [[nodiscard]] double begin() const;
  /// s, of ROS time, to TRIAL_END, or to the last row
  [[nodiscard]] double end() const;
  /// At that s of ROS time; nullptr: before the first.
  [[nodiscard]] const TrackRow* at(double time) const;
};

/// s, ROS time.
[[nodiscard]] inline double time_of(const Row& row) { return 1e-9 * static_cast<double>(row.sim_ns); }
inline constexpr double kSameGoal = 0.05;  ///< m, between two that are one

/// A column of the summary, and of the tables of batches and studies: counted in the record, stated
/// by TRIAL_START, or reported by feedback_node in its diagnostics, which TRIAL_END keeps.
struct Figure {
  std::string name;
  std::string unit;  ///< empty: a word or a number of times
  std::string meaning;
  std::string source;  ///< publication; empty where there is none
  std::function<std::string(const Trial&)> of;  ///< "n/a" where it is not known
  enum class Kind { counted, stated, reported } kind = Kind::counted;
};

/// All that is told of a trial. Nothing else counts.
[[nodiscard]] const std::vector<Figure>& figures();

/// Column name and cell, in order; "n/a" where there is no value.
using Summary = std::vector<std::pair<std::string, std::string>>;

/// A journal without an end is aborted; one without a start has no figures.
[[nodiscard]] Summary summarize(const Trial& trial);

[[nodiscard]] std::vector<std::string> reported_columns();

[[nodiscard]] std::string summary_csv(const Summary& summary);
/// nullopt for a text that summary_csv() does not write, and for one without a result.
[[nodiscard]] std::optional<Summary> parse_summary(const std::string& text);
/// Empty where there is no such column.
[[nodiscard]] std::string cell_of(const Summary& summary, const std::string& name);

/// A sentence for each column of the summary that the recount has otherwise, but `bag`, as no bag
/// holds how it was closed, and what an earlier version counted by another meaning. A summary of
/// such a version has fewer columns.
[[nodiscard]] std::vector<std::string> differences(const Summary& summary, const Summary& recount);

}  // namespace navvi_study::record
