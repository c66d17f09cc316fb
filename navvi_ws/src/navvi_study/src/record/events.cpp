#include "record/events.hpp"

#include <algorithm>
#include <numeric>

namespace navvi_study::record {
namespace {

std::string seconds(std::int64_t from, std::int64_t to, double less = 0.0) {
  return fixed(static_cast<double>(to - from) * 1e-9 - less, 3);
}

/// What the paper's Table III calls it; the type itself for what the paper does not have.
std::string paper_name(const Row& row) {
  const bool shelf = row.fields.get("kind") == "shelf";
  if (row.type == "PROXIMITY_ENTER") return shelf ? "proximity to shelf" : "proximity to obstacle";
  if (row.type == "COLLISION") return shelf ? "collision with shelf" : "collision with obstacle";
  if (row.type == "GOAL_REACHED") return "goal reached";
  std::string name = row.type;
  for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(c - 'A' + 'a');
  return name;
}

/// s, duration of the interval that `rows[at]` opens; n/a if that is not known, 0 for what only
/// happened.
std::string duration_of(const std::vector<Row>& rows, std::size_t at, const Row& start) {
  const Row& row = rows[at];
  const bool cue = row.type == "CUE";
  if (!cue && row.type != "PROXIMITY_ENTER") return "0";
  // The end of a sound or a pattern is not recorded.
  if (row.fields.get("modality", "speech") != "speech") return "n/a";
  const char* end = cue ? "CUE_END" : "PROXIMITY_LEAVE";
  // A thing that is recorded to leave has been away for so long.
  const double away = cue ? 0.0 : start.fields.number("leave_time").value_or(0.0);
  const auto same = [&](const Row& other, const char* name) {
    return other.fields.get(name) == row.fields.get(name);
  };
  for (std::size_t i = at + 1; i < rows.size(); ++i) {
    const bool ends = rows[i].type == end, begins = rows[i].type == row.type;
    if (!(ends || begins) || !same(rows[i], "id") || !same(rows[i], "modality")) continue;
    // A node that was started anew numbers from 1 again.
    return begins ? "n/a" : seconds(row.sim_ns, rows[i].sim_ns, away);
  }
  return "n/a";
}

/// Places in `rows`. What a node stamped may have come after what happened later.
std::vector<std::size_t> by_onset(const std::vector<Row>& rows) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rows[a].sim_ns < rows[b].sim_ns; });
  return order;
}

/// The first of these fields that a row has.
std::string any_of(const Row& row, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (const auto value = row.fields.find(name)) return *value;
  return "n/a";
}

}  // namespace

std::string events_csv(const Trial& trial) {
  std::string text = csv_line(
      {"onset_s", "duration_s", "trial", "participant", "wall_clock_utc", "trial_type", "robot_x_m",
       "robot_y_m", "goal_x_m", "goal_y_m", "obstacle_position", "obstacle_collision_count",
       "shelf_collision_count", "elapsed_s", "thing_class", "thing", "spoken", "detail"});
  const std::vector<Row>& rows = trial.rows;
  const Row* start = trial.first("TRIAL_START");
  if (start == nullptr) return text;
  for (const std::size_t i : by_onset(rows)) {
    const Row& row = rows[i];
    if (row.type == "PROXIMITY_LEAVE" || row.type == "CUE_END" || row.type == "PROGRESS" ||
        row.type == "CLOCK_OFFSET")
      continue;
    const bool collision = row.type == "COLLISION";
    const bool shelf = row.fields.get("kind") == "shelf";
    const bool zoned = row.type == "PROXIMITY_ENTER" && !shelf;
    text += csv_line({seconds(start->sim_ns, row.sim_ns), duration_of(rows, i, *start), row.trial,
                    start->fields.get("participant"), row.fields.get("utc"), paper_name(row),
                    row.fields.get("x"), row.fields.get("y"), row.fields.get("goal_x"),
                    row.fields.get("goal_y"), zoned ? row.fields.get("zone") : "n/a",
                    collision && !shelf ? row.fields.get("count") : "n/a",
                    collision && shelf ? row.fields.get("count") : "n/a", row.fields.get("elapsed"),
                    row.fields.get("class"), row.fields.get("thing"), row.fields.get("text"),
                    row.type == "CUE" ? row.fields.get("kind")
                                      : any_of(row, {"reason", "state", "device", "result", "does",
                                                     "late", "node", "name"})});
  }
  return text;
}

}  // namespace navvi_study::record
