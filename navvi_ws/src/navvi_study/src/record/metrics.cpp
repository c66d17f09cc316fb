#include "record/metrics.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

namespace navvi_study::record {
namespace {

/// Columns that older summaries lack, besides those of the latency.
constexpr const char* kNewer[] = {"parameters",    "version",       "started_utc",
                                  "reroute_count", "sounds_played", "patterns_felt"};

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
  Summary summary;
  const auto add = [&](const char* name, const std::string& cell) {
    summary.emplace_back(name, cell);
  };
  const Row* start = first_of(rows, "TRIAL_START");
  const Row* end = last_of(rows, "TRIAL_END");
  const Row* tally =
      last_that(rows, [](const Row& row) { return row.fields.find("path_length").has_value(); });
  const Row* replan = last_of(rows, "REPLAN");
  const Row* reached = last_of(rows, "GOAL_REACHED");
  const Row* bag = last_of(rows, "BAG_CLOSED");
  const Row* route = first_of(rows, "ROUTE");
  const std::string nothing = "n/a";
  add("trial", rows.empty() ? nothing : rows.front().trial);
  for (const char* name : {"world", "world_hash", "seed", "operator", "participant", "profile",
                           "parameters", "version", "audio", "pad"}) {
    add(name, start ? start->fields.get(name) : nothing);
  }
  for (const char* name : kSettings) add(name, start ? start->fields.get(name) : nothing);
  add("started_utc", start ? start->fields.get("utc") : nothing);
  add("result", end ? end->fields.get("result") : "aborted");
  add("reason", end ? end->fields.get("reason") : "no_end");
  const Row* last = end ? end : (rows.empty() ? nullptr : &rows.back());
  add("elapsed_s", reached ? reached->fields.get("elapsed")
                           : (start ? seconds(start->sim_ns, last->sim_ns) : nothing));
  const bool blind = start && start->fields.get("contacts", "counted") == "unknown";
  for (const char* what : {"shelf", "obstacle"})
    add((what + std::string("_collision_count")).c_str(),
        blind ? "unknown" : count_of(rows, "COLLISION", what));
  add("path_length_m", tally ? tally->fields.get("path_length") : nothing);
  add("first_path_length_m", route ? route->fields.get("first_path_length") : nothing);
  add("obstacle_proximity_count", count_of(rows, "PROXIMITY_ENTER", "obstacle"));
  add("shelf_proximity_count", count_of(rows, "PROXIMITY_ENTER", "shelf"));
  add("stuck_count", count_of(rows, "STUCK"));
  add("replan_count", replan ? replan->fields.get("count") : "0");
  add("reroute_count", tally ? tally->fields.get("reroutes") : nothing);
  // Wheels that had not turned yet were held, not stopped.
  add("safe_stop_count", std::to_string(std::count_if(rows.begin(), rows.end(), [](const Row& row) {
        return row.type == "SAFE_STOP" && row.fields.get("moved", "yes") == "yes" &&
               row.fields.get("held", "no") == "no";
      })));
  add("cues_spoken", tally ? tally->fields.get("cues_spoken") : nothing);
  // A simulated person knows of sounds by message, also where no device plays them.
  const bool unheard =
      start && start->fields.get("pad") == "simulated" && start->fields.get("audio") != "works";
  add("sounds_played", tally && !unheard ? tally->fields.get("sounds_played") : nothing);
  add("patterns_felt", tally ? tally->fields.get("patterns_felt") : nothing);
  for (const std::string& name : reported_columns())
    add(name.c_str(), tally ? tally->fields.get(name) : nothing);
  add("missed_messages", tally ? tally->fields.get("missed_messages") : nothing);
  for (const char* name : {"state_step", "state_hash"})
    add(name, tally ? tally->fields.get(name) : nothing);
  add("bag", bag ? bag->fields.get("state") : nothing);
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
