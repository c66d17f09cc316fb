#include "record/metrics.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

namespace navvi_study::record {
namespace {

/// Columns that older summaries lack, besides those of the latency.
constexpr const char* kNewer[] = {"parameters",    "version",       "started_utc",
                                  "reroute_count", "sounds_played", "patterns_felt",
                                  "device_loss_count"};

/// Of TRIAL_START: where the trial stands in a study, and on what it ran. Older summaries lack
/// them.
constexpr const char* kSettings[] = {"study",           "plan",         "group",   "condition",
                                     "condition_order", "phase",        "session", "repeat",
                                     "attempt",         "replaces",     "cpu",     "compiler",
                                     "bullet",          "audio_device", "voice",   "pad_name"};

std::string seconds(std::int64_t from, std::int64_t to) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.3f", static_cast<double>(to - from) * 1e-9);
  return text.data();
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : ",") + quoted(cells[i]);
  return line + "\n";
}

/// The cells of one line; nullopt where quotes are not in order.
std::optional<std::vector<std::string>> cells_of(std::string_view text) {
  std::vector<std::string> cells(1);
  bool open = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"' && open && i + 1 < text.size() && text[i + 1] == '"') {
      cells.back() += text[i++];
    } else if (text[i] == '"') {
      open = !open;
    } else if (text[i] == ',' && !open) {
      cells.emplace_back();
    } else {
      cells.back() += text[i];
    }
  }
  if (open) return std::nullopt;
  return cells;
}

const Row* first_of(const std::vector<Row>& rows, const std::string& type) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const Row& one) { return one.type == type; });
  return row == rows.end() ? nullptr : &*row;
}

template <typename Test>
const Row* last_that(const std::vector<Row>& rows, const Test& test) {
  const auto row = std::find_if(rows.rbegin(), rows.rend(), test);
  return row == rows.rend() ? nullptr : &*row;
}

const Row* last_of(const std::vector<Row>& rows, const std::string& type) {
  return last_that(rows, [&](const Row& row) { return row.type == type; });
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

/// What began in a row of this type ends in one of the type that is returned.
const char* end_of(const std::string& type) {
  if (type == "PROXIMITY_ENTER") return "PROXIMITY_LEAVE";
  return type == "CUE" ? "CUE_END" : nullptr;
}

/// s, how long it lasted what began in `rows[at]`; n/a if that is not known, 0 for what only
/// happened.
std::string duration_of(const std::vector<Row>& rows, std::size_t at) {
  const char* end = end_of(rows[at].type);
  if (end == nullptr) return "0";
  const auto same = [&](const Row& row, const char* name) {
    return row.fields.get(name) == rows[at].fields.get(name);
  };
  for (std::size_t i = at + 1; i < rows.size(); ++i) {
    if (rows[i].type == end && same(rows[i], "id") && same(rows[i], "modality"))
      return seconds(rows[at].sim_ns, rows[i].sim_ns);
  }
  return "n/a";
}

/// The first of these fields that a row has.
std::string any_of(const Row& row, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (const auto value = row.fields.find(name)) return *value;
  return "n/a";
}

std::string count_of(const std::vector<Row>& rows, const std::string& type,
                     const std::string& kind = "") {
  return std::to_string(std::count_if(rows.begin(), rows.end(), [&](const Row& row) {
    return row.type == type && (kind.empty() || row.fields.get("kind") == kind);
  }));
}

constexpr const char* kNothing = "n/a";

/// The value of that field, if there is such a row.
std::string cell_of(const Row* row, const char* field) {
  return row ? row->fields.get(field) : kNothing;
}

/// As the trial began.
void add_start(Summary& summary, const Row* start) {
  for (const char* name : {"world", "world_hash", "seed", "operator", "participant", "profile",
                           "parameters", "version", "audio", "pad"})
    summary.emplace_back(name, cell_of(start, name));
  for (const char* name : kSettings) summary.emplace_back(name, cell_of(start, name));
  summary.emplace_back("started_utc", cell_of(start, "utc"));
}

void add_end(Summary& summary, const std::vector<Row>& rows) {
  const Row* start = first_of(rows, "TRIAL_START");
  const Row* end = last_of(rows, "TRIAL_END");
  const Row* reached = last_of(rows, "GOAL_REACHED");
  const Row* last = end || rows.empty() ? end : &rows.back();
  summary.emplace_back("result", end ? end->fields.get("result") : "aborted");
  summary.emplace_back("reason", end ? end->fields.get("reason") : "no_end");
  summary.emplace_back("elapsed_s", reached ? reached->fields.get("elapsed")
                                    : start ? seconds(start->sim_ns, last->sim_ns)
                                            : kNothing);
}

/// Wheels that had not turned yet were held, not stopped.
bool stops_safely(const Row& row) {
  return row.type == "SAFE_STOP" && row.fields.get("moved", "yes") == "yes" &&
         row.fields.get("held", "no") == "no";
}

/// Pad, audio or voice. That feedback_node was silent is no message of a bag.
bool loses_device(const Row& row) {
  return row.type == "DEVICE_LOST" && row.fields.get("device") != "feedback";
}

/// \param tally  the last row with sums of the trial so far
void add_counts(Summary& summary, const std::vector<Row>& rows, const Row* tally) {
  const Row* start = first_of(rows, "TRIAL_START");
  const Row* replan = last_of(rows, "REPLAN");
  const bool blind = start && start->fields.get("contacts", "counted") == "unknown";
  const auto collisions = [&](const char* what) {
    return blind ? "unknown" : count_of(rows, "COLLISION", what);
  };
  const auto stops = std::count_if(rows.begin(), rows.end(), stops_safely);
  const auto losses = std::count_if(rows.begin(), rows.end(), loses_device);
  const Summary counts = {
      {"shelf_collision_count", collisions("shelf")},
      {"obstacle_collision_count", collisions("obstacle")},
      {"path_length_m", cell_of(tally, "path_length")},
      {"first_path_length_m", cell_of(first_of(rows, "ROUTE"), "first_path_length")},
      {"obstacle_proximity_count", count_of(rows, "PROXIMITY_ENTER", "obstacle")},
      {"shelf_proximity_count", count_of(rows, "PROXIMITY_ENTER", "shelf")},
      {"stuck_count", count_of(rows, "STUCK")},
      {"replan_count", replan ? replan->fields.get("count") : "0"},
      {"reroute_count", cell_of(tally, "reroutes")},
      {"safe_stop_count", std::to_string(stops)},
      {"device_loss_count", std::to_string(losses)}};
  summary.insert(summary.end(), counts.begin(), counts.end());
}

/// Nobody heard the sounds. A simulated person knows of them by message, also where no device plays
/// them.
bool unheard(const Row* start) {
  return start && start->fields.get("pad") == "simulated" && start->fields.get("audio") != "works";
}

void add_feedback(Summary& summary, const Row* tally, bool unheard) {
  summary.emplace_back("cues_spoken", cell_of(tally, "cues_spoken"));
  summary.emplace_back("sounds_played", cell_of(unheard ? nullptr : tally, "sounds_played"));
  summary.emplace_back("patterns_felt", cell_of(tally, "patterns_felt"));
  for (const std::string& name : reported_columns())
    summary.emplace_back(name, cell_of(tally, name.c_str()));
  for (const char* name : {"missed_messages", "state_step", "state_hash"})
    summary.emplace_back(name, cell_of(tally, name));
}

}  // namespace

std::string events_csv(const std::vector<Row>& rows) {
  std::string text = joined(
      {"onset_s", "duration_s", "trial", "participant", "wall_clock_utc", "trial_type", "robot_x_m",
       "robot_y_m", "goal_x_m", "goal_y_m", "obstacle_position", "obstacle_collision_count",
       "shelf_collision_count", "elapsed_s", "thing_class", "thing", "spoken", "detail"});
  const Row* start = first_of(rows, "TRIAL_START");
  if (start == nullptr) return text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    if (row.type == "PROXIMITY_LEAVE" || row.type == "CUE_END" || row.type == "PROGRESS" ||
        row.type == "CLOCK_OFFSET")
      continue;
    const bool collision = row.type == "COLLISION";
    const bool shelf = row.fields.get("kind") == "shelf";
    const bool zoned = row.type == "PROXIMITY_ENTER" && !shelf;
    text += joined({seconds(start->sim_ns, row.sim_ns), duration_of(rows, i), row.trial,
                    start->fields.get("participant"), row.fields.get("utc"), paper_name(row),
                    row.fields.get("x"), row.fields.get("y"), row.fields.get("goal_x"),
                    row.fields.get("goal_y"), zoned ? row.fields.get("zone") : "n/a",
                    collision && !shelf ? row.fields.get("count") : "n/a",
                    collision && shelf ? row.fields.get("count") : "n/a", row.fields.get("elapsed"),
                    row.fields.get("class"), row.fields.get("thing"), row.fields.get("text"),
                    row.type == "CUE" ? row.fields.get("kind")
                                      : any_of(row, {"reason", "state", "device", "result"})});
  }
  return text;
}

Summary summarize(const std::vector<Row>& rows) {
  const Row* tally =
      last_that(rows, [](const Row& row) { return row.fields.find("path_length").has_value(); });
  Summary summary{{"trial", rows.empty() ? kNothing : rows.front().trial}};
  add_start(summary, first_of(rows, "TRIAL_START"));
  add_end(summary, rows);
  add_counts(summary, rows, tally);
  add_feedback(summary, tally, unheard(first_of(rows, "TRIAL_START")));
  const Row* bag = last_of(rows, "BAG_CLOSED");
  summary.emplace_back("bag", bag ? bag->fields.get("state") : kNothing);
  return summary;
}

std::vector<std::string> latency_columns() {
  std::vector<std::string> names;
  for (const char* chain : {"sensed", "motors", "pattern", "words", "answer", "silence"})
    for (const char* figure : {"_p50_ms", "_p99_ms", "_max_ms"})
      names.push_back(std::string(chain) + figure);
  return names;
}

std::vector<std::string> reported_columns() {
  std::vector<std::string> names = latency_columns();
  names.push_back("stopping_delay_s");
  names.push_back("stopping_spread_s");
  names.push_back("turn_error_rad");
  names.push_back("words_lead");
  return names;
}

std::string summary_csv(const Summary& summary) {
  std::vector<std::string> names;
  std::vector<std::string> cells;
  for (const auto& [name, cell] : summary) {
    names.push_back(name);
    cells.push_back(cell);
  }
  return joined(names) + joined(cells);
}

std::optional<Summary> parse_summary(const std::string& text) {
  // No column holds a line end: the fields that could are free text of the launch, and a cell with
  // one would be quoted, which the count of lines below refuses.
  const auto first = text.find('\n');
  if (first == std::string::npos || text.find('\n', first + 1) != text.size() - 1) {
    return std::nullopt;
  }
  const auto names = cells_of(std::string_view(text).substr(0, first));
  const auto cells = cells_of(std::string_view(text).substr(first + 1, text.size() - first - 2));
  if (!names || !cells || names->size() != cells->size()) return std::nullopt;
  Summary summary;
  for (std::size_t i = 0; i < names->size(); ++i) summary.emplace_back((*names)[i], (*cells)[i]);
  if (summary_csv(summary) != text) return std::nullopt;
  return summary;
}

std::vector<std::string> differences(const Summary& summary, const Summary& recount) {
  const std::map<std::string, std::string> before(summary.begin(), summary.end());
  std::map<std::string, std::string> again(recount.begin(), recount.end());
  std::vector<std::string> newer = reported_columns();
  newer.insert(newer.end(), std::begin(kNewer), std::end(kNewer));
  newer.insert(newer.end(), std::begin(kSettings), std::end(kSettings));
  for (const std::string& name : newer)
    if (before.count(name) == 0) again.erase(name);
  std::vector<std::string> sentences;
  for (const auto& [name, cell] : summary) {
    if (name == "bag") continue;
    const auto other = again.find(name);
    if (other == again.end()) {
      sentences.push_back(name + " is " + cell + " in the summary and missing in the recount");
    } else if (other->second != cell) {
      sentences.push_back(name + " is " + cell + " in the summary and " + other->second +
                          " in the recount");
    }
  }
  if (before.size() != again.size()) sentences.push_back("the columns are not the same");
  return sentences;
}

}  // namespace navvi_study::record
