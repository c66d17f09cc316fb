#include "record/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <navvi_types/angles.hpp>

#include "record/csv.hpp"
#include "record/driven.hpp"
#include "record/told.hpp"

namespace navvi_study::record {
namespace {

constexpr const char* kNothing = "n/a";
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

constexpr double kFelt = 3.0;      // s before a contact
constexpr double kTold = 2.0;      // s
constexpr double kLongAgo = 10.0;  // s; a word before that was no warning

std::string text_of(double value, int decimals = 3) {
  if (!std::isfinite(value)) return kNothing;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string text_of(const Row* row, const std::string& field) {
  return row != nullptr ? row->fields.get(field) : kNothing;
}

double number_of(const Row* row, const std::string& field) {
  return row != nullptr ? row->fields.number(field).value_or(kUnknown) : kUnknown;
}

const Row* start_of(const Trial& trial) { return trial.first("TRIAL_START"); }

/// The last row with sums of the trial so far.
const Row* sums_of(const Trial& trial) {
  const auto row = std::find_if(trial.rows.rbegin(), trial.rows.rend(), [](const Row& one) {
    return one.fields.find("path_length").has_value();
  });
  return row == trial.rows.rend() ? nullptr : &*row;
}

template <typename Test>
std::string count_of(const Trial& trial, const Test& test) {
  return std::to_string(std::count_if(trial.rows.begin(), trial.rows.end(), test));
}

std::string count_of(const Trial& trial, const std::string& type, const std::string& kind) {
  return count_of(trial, [&](const Row& row) {
    return row.type == type && (kind.empty() || row.fields.get("kind") == kind);
  });
}

/// \param share  [0, 1] of the values that are not above it
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double duration(const Trial& trial) { return std::max(1.0, trial.end() - trial.begin()); }

// The record's own words.

std::string as_begun(const Trial& trial, const std::string& name) {
  return text_of(start_of(trial), name);
}
std::string as_summed(const Trial& trial, const std::string& name) {
  return text_of(sums_of(trial), name);
}

std::string name_of(const Trial& trial, const std::string&) {
  return trial.rows.empty() ? kNothing : trial.rows.front().trial;
}
std::string started(const Trial& trial, const std::string&) {
  return text_of(start_of(trial), "utc");
}
std::string bag(const Trial& trial, const std::string&) {
  return text_of(trial.last("BAG_CLOSED"), "state");
}

// The end.

std::string result(const Trial& trial, const std::string&) {
  const Row* end = trial.last("TRIAL_END");
  return end != nullptr ? end->fields.get("result") : "aborted";
}
std::string reason(const Trial& trial, const std::string&) {
  const Row* end = trial.last("TRIAL_END");
  return end != nullptr ? end->fields.get("reason") : "no_end";
}
std::string elapsed(const Trial& trial, const std::string&) {
  if (const Row* reached = trial.last("GOAL_REACHED")) return reached->fields.get("elapsed");
  return start_of(trial) != nullptr ? text_of(trial.end() - trial.begin()) : kNothing;
}

// The way.

std::string path_length(const Trial& trial, const std::string&) {
  return text_of(sums_of(trial), "path_length");
}
std::string first_path_length(const Trial& trial, const std::string&) {
  return text_of(trial.first("ROUTE"), "first_path_length");
}
std::string shortest_path(const Trial& trial, const std::string&) {
  return text_of(trial.first("ROUTE"), "shortest_path");
}
std::string spl(const Trial& trial, const std::string& name) {
  if (result(trial, name) != "reached") return text_of(0.0);
  const double shortest = number_of(trial.first("ROUTE"), "shortest_path");
  return text_of(shortest / std::max(number_of(sums_of(trial), "path_length"), shortest));
}
std::string replans(const Trial& trial, const std::string&) {
  const Row* replan = trial.last("REPLAN");
  return replan != nullptr ? replan->fields.get("count") : "0";
}
std::string reroutes(const Trial& trial, const std::string&) {
  return text_of(sums_of(trial), "reroutes");
}
std::string stuck(const Trial& trial, const std::string&) { return count_of(trial, "STUCK", ""); }

/// In a state of the guidance, which names the figure.
std::string in_state(const Trial& trial, const std::string& name) {
  const std::string state = name.substr(0, name.size() - 2);  // without _s
  double sum = 0.0, since = 0.0;
  bool inside = false;
  for (const Row& row : trial.rows) {
    if (row.type != "GUIDANCE") continue;
    if (inside) sum += time_of(row) - since;
    inside = row.fields.get("state") == state;
    since = time_of(row);
  }
  return text_of(inside ? sum + trial.end() - since : sum);
}

// Contacts.

bool counts_contacts(const Trial& trial) {
  const Row* start = start_of(trial);
  return start == nullptr || start->fields.get("contacts", "counted") != "unknown";
}
std::string collisions(const Trial& trial, const char* kind) {
  return counts_contacts(trial) ? count_of(trial, "COLLISION", kind) : "unknown";
}
std::string shelf_collisions(const Trial& trial, const std::string&) {
  return collisions(trial, "shelf");
}
std::string obstacle_collisions(const Trial& trial, const std::string&) {
  return collisions(trial, "obstacle");
}
std::string contacts(const Trial& trial, const std::string&) { return collisions(trial, ""); }
std::string contacts_per_100m(const Trial& trial, const std::string&) {
  const double driven = number_of(sums_of(trial), "path_length");
  if (!counts_contacts(trial) || driven == 0.0) return kNothing;
  return text_of(100.0 * std::stod(collisions(trial, "")) / driven);
}
std::string hits(const Trial& trial, const std::string&) {
  std::map<std::string, int> counts;
  for (const Row& row : trial.rows)
    if (row.type == "COLLISION") ++counts[row.fields.get("class", row.fields.get("kind"))];
  std::string text;
  for (const auto& [thing_class, count] : counts)
    text += (text.empty() ? "" : " ") + thing_class + " " + std::to_string(count);
  return !counts_contacts(trial) ? "unknown" : text.empty() ? "-" : text;
}
std::string near_obstacles(const Trial& trial, const std::string&) {
  return count_of(trial, "PROXIMITY_ENTER", "obstacle");
}
std::string near_shelves(const Trial& trial, const std::string&) {
  return count_of(trial, "PROXIMITY_ENTER", "shelf");
}
bool is_mover(const std::string& thing_class) {
  return thing_class == "worker" || thing_class == "forklift" || thing_class == "pallet_robot";
}
std::string near_movers(const Trial& trial, const std::string&) {
  return count_of(trial, [](const Row& row) {
    return row.type == "PROXIMITY_ENTER" && is_mover(row.fields.get("class"));
  });
}
std::string least_gap(const Trial& trial, const std::string&) {
  double least = std::numeric_limits<double>::infinity();
  for (const TrackRow& row : trial.track)
    if (std::isfinite(row.gap)) least = std::min(least, std::max(0.0, static_cast<double>(row.gap)));
  return text_of(least, 2);
}

/// How early a person was warned of what moves before it touched the robot, s.
struct Warning {
  double felt = 0.0;
  double told = 0.0;
};
/// Since when that class was named, within the last 10 s; 0: not at all.
double told_before(const Trial& trial, std::string thing_class, double time) {
  double told = 0.0;
  const auto named = [&](double when) {
    if (when < time && time - when < kLongAgo) told = std::max(told, time - when);
  };
  for (const TrackRow& row : trial.track)
    if (!row.sounds.empty() && row.sounds.text().find(thing_class) != std::string::npos) named(row.time);
  std::replace(thing_class.begin(), thing_class.end(), '_', ' ');
  for (const Row& row : trial.rows)
    if (row.type == "CUE" && row.fields.get("text").find(thing_class) != std::string::npos)
      named(time_of(row));
  return told;
}
std::vector<Warning> warnings_of(const Trial& trial) {
  std::vector<Warning> found;
  for (const Row& row : trial.rows)
    if (row.type == "COLLISION" && is_mover(row.fields.get("class")))
      found.push_back({row.fields.number("felt").value_or(0.0),
                       told_before(trial, row.fields.get("class"), time_of(row))});
  return found;
}
std::string late_warnings(const Trial& trial, const std::string&) {
  const auto all = warnings_of(trial);
  return std::to_string(std::count_if(all.begin(), all.end(), [](const Warning& one) {
    return one.felt < kFelt || one.told < kTold;
  }));
}
std::string warned(const Trial& trial, const std::string&) {
  std::string text;
  for (const Warning& one : warnings_of(trial))
    text += (text.empty() ? "" : " ") + text_of(one.felt, 1) + "/" + text_of(one.told, 1);
  return text.empty() ? "-" : text;
}

// What was said.

std::string cues_per_minute(const Trial& trial, const std::string&) {
  return text_of(60.0 * speech_of(trial).cues / duration(trial), 1);
}
std::string words_per_minute(const Trial& trial, const std::string&) {
  return text_of(60.0 * speech_of(trial).words / duration(trial), 1);
}
std::string talk(const Trial& trial, const std::string&) {
  return text_of(speech_of(trial).talk / duration(trial));
}
/// A count of Speech or Directions.
template <auto Of, auto Member>
std::string counted(const Trial& trial, const std::string&) {
  if constexpr (std::is_same_v<decltype(Of(trial)), std::optional<Directions>>) {
    const auto found = Of(trial);
    return found ? std::to_string((*found).*Member) : kNothing;
  } else {
    return std::to_string(Of(trial).*Member);
  }
}
std::string turns_per_minute(const Trial& trial, const std::string&) {
  const auto found = directions_of(trial);
  return found ? text_of(60.0 * found->turns / (trial.end() - trial.begin()), 1) : kNothing;
}

// How the hands and the robot moved.

std::string led_turns(const Trial& trial, const std::string&) {
  return trial.track.empty() ? kNothing : std::to_string(turns_of(trial).left.size());
}
std::string residual(const Trial& trial, const std::string&) {
  return text_of(navvi_types::degrees(quantile(turns_of(trial).left, 0.5)), 1);
}
std::string residual_90(const Trial& trial, const std::string&) {
  return text_of(navvi_types::degrees(quantile(turns_of(trial).left, 0.9)), 1);
}
std::string cue_to_action(const Trial& trial, const std::string&) {
  return text_of(quantile(turns_of(trial).late, 0.5), 2);
}
std::string motors(const Trial& trial, const std::string&) {
  double felt = 0.0;  // s
  for (std::size_t i = 0; i < trial.track.size(); ++i) {
    const TrackRow& row = trial.track[i];
    const double until = i + 1 < trial.track.size() ? trial.track[i + 1].time : trial.end();
    if (row.motor_left > 0.0F || row.motor_right > 0.0F) felt += until - row.time;
  }
  return trial.track.empty() ? kNothing : text_of(felt / duration(trial));
}
std::string speechless(const Trial& trial, const std::string&) {
  return trial.track.empty() ? kNothing : std::to_string(stands_of(trial).speechless);
}
std::string still(const Trial& trial, const std::string&) {
  return trial.track.empty() ? kNothing : text_of(stands_of(trial).longest, 1);
}
std::string still_since(const Trial& trial, const std::string&) {
  return trial.track.empty() ? kNothing : text_of(stands_of(trial).since, 1);
}
std::string still_about(const Trial& trial, const std::string&) { return stands_of(trial).about; }

// What failed.

std::string safe_stops(const Trial& trial, const std::string&) {
  return count_of(trial, [](const Row& row) {
    // Wheels that had not turned yet were held, not stopped.
    return row.type == "SAFE_STOP" && row.fields.get("moved", "yes") == "yes" &&
           row.fields.get("held", "no") == "no";
  });
}
std::string device_losses(const Trial& trial, const std::string&) {
  return count_of(trial, [](const Row& row) {
    // That feedback_node was silent is no message of a bag.
    return row.type == "DEVICE_LOST" && row.fields.get("device") != "feedback";
  });
}
std::string sounds_played(const Trial& trial, const std::string& name) {
  const Row* start = start_of(trial);
  // A simulated person knows of sounds by message, also where no device plays them.
  const bool unheard = start != nullptr && start->fields.get("pad") == "simulated" &&
                       start->fields.get("audio") != "works" &&
                       start->fields.get("audio") != "simulated";
  return unheard ? kNothing : as_summed(trial, name);
}

const char* kSpl = "Anderson et al. 2018, On Evaluation of Embodied Navigation Agents";
const char* kPaper = "the paper, Table III";

std::vector<Figure> all_figures() {
  constexpr auto stated = Figure::Kind::stated, reported = Figure::Kind::reported;
  std::vector<Figure> all = {
      {"trial", "", "name of its folder", "", name_of, stated},
      {"world", "", "name or file", "", as_begun, stated},
      {"world_hash", "", "of the world that was built", "", as_begun, stated},
      {"seed", "", "draws the world, start and goal", "", as_begun, stated},
      {"operator", "", "what drives: pad, simulated, ...", "", as_begun, stated},
      {"participant", "", "a pseudonym", "", as_begun, stated},
      {"profile", "", "of the parameters", "", as_begun, stated},
      {"parameters", "", "that were set besides the profile's", "", as_begun, stated},
      {"version", "", "of NavVI, with the commit", "", as_begun, stated},
      {"audio", "", "works, missing, off or unknown", "", as_begun, stated},
      {"pad", "", "likewise; simulated where no person drives", "", as_begun, stated},
  };
  // Where the trial stands in a study, and on what it ran.
  for (const char* name : {"study", "plan", "group", "condition", "condition_order", "phase",
                           "session", "repeat", "attempt", "replaces", "cpu", "compiler", "bullet",
                           "audio_device", "voice", "pad_name"})
    all.push_back({name, "", "as TRIAL_START has it", "", as_begun, stated});
  const std::vector<Figure> counted_ones = {
      {"started_utc", "", "ISO 8601", "", started, stated},
      {"result", "", "reached, timeout, refused, aborted or invalid", "", result},
      {"reason", "", "of the result", "", reason},
      {"elapsed_s", "s", "simulated time from start to goal, or to the end", kPaper, elapsed},
      {"shelf_collision_count", "", "collisions with shelves", kPaper, shelf_collisions},
      {"obstacle_collision_count", "", "collisions with everything else", kPaper,
       obstacle_collisions},
      {"contacts", "", "collisions with anything", "", contacts},
      {"contacts_per_100m", "", "collisions per 100 m driven", "", contacts_per_100m},
      {"hits", "", "collisions by class", "", hits},
      {"path_length_m", "m", "way driven", "", path_length},
      {"first_path_length_m", "m", "of the first path", "", first_path_length},
      {"shortest_path_m", "m", "of the shortest path when the first one was planned", "",
       shortest_path},
      {"spl", "", "shortest over driven way where the goal was reached, else 0", kSpl, spl},
      {"obstacle_proximity_count", "", "times that an obstacle came within 5 m", kPaper,
       near_obstacles},
      {"shelf_proximity_count", "", "times that a shelf came within 1 m", kPaper, near_shelves},
      {"mover_proximity_count", "", "times that a worker or vehicle came within 5 m", "",
       near_movers},
      {"least_gap_m", "m", "from the hull to anything", "", least_gap},
      {"late_warnings", "", "contacts with movers that were felt < 3 s or named < 2 s before", "",
       late_warnings},
      {"warned", "", "s felt/named before each contact with a mover", "", warned},
      {"stuck_count", "", "times that a cue reports being stuck", "", stuck},
      {"replan_count", "", "times that the path was searched again", "", replans},
      {"reroute_count", "", "times that the path was replaced by one that leads elsewhere", "",
       reroutes},
      {"safe_stop_count", "", "times that the wheels were stopped for safety", "", safe_stops},
      {"device_loss_count", "", "losses of pad, audio or voice", "", device_losses},
      {"cues_spoken", "", "sentences", "", as_summed},
      {"sounds_played", "", "short sounds", "", sounds_played},
      {"patterns_felt", "", "patterns of the motors", "", as_summed},
      {"cues_per_min", "1/min", "sentences", "", cues_per_minute},
      {"words_per_min", "1/min", "words", "", words_per_minute},
      {"talk", "", "share of the time in which something is said", "", talk},
      {"repeats", "", "times that a sentence was said again within 10 s, unasked", "",
       counted<speech_of, &Speech::repeats>},
      {"waits", "", "unasked words to wait or stop", "", counted<speech_of, &Speech::waits>},
      {"hasty", "", "of these, followed by another sentence within 2 s", "",
       counted<speech_of, &Speech::hasty>},
      {"at_odds", "", "times that straight on and a thing ahead were said within 2 s", "",
       counted<speech_of, &Speech::at_odds>},
      {"turns_per_min", "1/min", "changes of the announced hour", "", turns_per_minute},
      {"flips", "", "directions that contradict the one just before", "",
       counted<directions_of, &Directions::flips>},
      {"misled", "", "turns that are not the ones announced for their corners", "",
       counted<directions_of, &Directions::misled>},
      {"reversed", "", "directions 4 hours or more from one within 4 s before", "",
       counted<directions_of, &Directions::reversed>},
      {"following_s", "s", "in that state of the guidance", "", in_state},
      {"blocked_s", "s", "in that state of the guidance", "", in_state},
      {"make_room_s", "s", "in that state of the guidance", "", in_state},
      {"no_route_s", "s", "in that state of the guidance", "", in_state},
      {"off_mesh_s", "s", "in that state of the guidance", "", in_state},
      {"led_turns", "", "turns on the spot of more than 15 deg, with somewhere to steer", "",
       led_turns},
      {"residual_deg", "deg", "what these left, median", "", residual},
      {"residual_90_deg", "deg", "what a tenth of these exceed", "", residual_90},
      {"cue_to_action_s", "s", "from a cue that asks for a turn to the turn, median", "",
       cue_to_action},
      {"motors", "", "share of the time in which a motor turns", "", motors},
      {"speechless", "", "pushes in vain for 3 s without a word or a sound", "", speechless},
      {"still_s", "s", "the longest stay within 0.3 m", "", still},
      {"still_since_s", "s", "from the start to the begin of that stay", "", still_since},
      {"still_about", "", "what was about at its end", "", still_about},
  };
  all.insert(all.end(), counted_ones.begin(), counted_ones.end());
  for (const char* chain : {"sensed", "motors", "pattern", "words", "answer", "silence"})
    for (const char* part : {"p50", "p99", "max"})
      all.push_back({std::string(chain) + "_" + part + "_ms", "ms",
                     std::string("how long the person waited: ") + chain + ", " + part, "",
                     as_summed, reported});
  const std::vector<Figure> last_ones = {
      {"stopping_delay_s", "s", "that the person takes to stop a turn, as learnt last", "",
       as_summed, reported},
      {"stopping_spread_s", "s", "its standard deviation", "", as_summed, reported},
      {"turn_error_rad", "rad", "left of turns that a sound led, mean of the latest", "",
       as_summed, reported},
      {"words_lead", "", "yes where words had taken over, as that was too much", "", as_summed, reported},
      {"missed_messages", "", "messages that were lost on their way", "", as_summed},
      {"state_step", "", "of the world's last state", "", as_summed},
      {"state_hash", "", "of the world's last state", "", as_summed},
      {"bag", "", "ok, bad or none", "", bag, stated},
  };
  all.insert(all.end(), last_ones.begin(), last_ones.end());
  return all;
}

}  // namespace

const Row* Trial::first(const std::string& type) const {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const Row& one) { return one.type == type; });
  return row == rows.end() ? nullptr : &*row;
}

const Row* Trial::last(const std::string& type) const {
  const auto row =
      std::find_if(rows.rbegin(), rows.rend(), [&](const Row& one) { return one.type == type; });
  return row == rows.rend() ? nullptr : &*row;
}

double Trial::begin() const {
  const Row* row = first("TRIAL_START");
  return row != nullptr ? time_of(*row) : 0.0;
}

double Trial::end() const {
  const Row* row = last("TRIAL_END");
  if (row == nullptr && !rows.empty()) row = &rows.back();
  return row != nullptr ? time_of(*row) : 0.0;
}

const TrackRow* Trial::at(double time) const {
  constexpr double kRounding = 1e-6;  // s
  const auto after = std::upper_bound(track.begin(), track.end(), time + kRounding,
                                      [](double when, const TrackRow& row) { return when < row.time; });
  return after == track.begin() ? nullptr : &*std::prev(after);
}

const std::vector<Figure>& figures() {
  static const std::vector<Figure> all = all_figures();
  return all;
}

Summary summarize(const Trial& trial) {
  Summary summary;
  for (const Figure& figure : figures())
    summary.emplace_back(figure.name, figure.of(trial, figure.name));
  return summary;
}

std::vector<std::string> reported_columns() {
  std::vector<std::string> names;
  for (const Figure& figure : figures())
    if (figure.kind == Figure::Kind::reported) names.push_back(figure.name);
  return names;
}

std::string summary_csv(const Summary& summary) {
  std::vector<std::string> names;
  std::vector<std::string> cells;
  for (const auto& [name, cell] : summary) {
    names.push_back(name);
    cells.push_back(cell);
  }
  return csv_line(names) + csv_line(cells);
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
  const std::map<std::string, std::string> again(recount.begin(), recount.end());
  std::vector<std::string> sentences;
  for (const auto& [name, cell] : summary) {
    const auto other = again.find(name);
    const std::string now = other == again.end() ? "missing" : other->second;
    if (name != "bag" && now != cell)
      sentences.push_back(name + " is " + cell + " in the summary and " + now + " in the recount");
  }
  return sentences;
}

}  // namespace navvi_study::record
