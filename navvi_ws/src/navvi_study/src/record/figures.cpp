#include "record/figures.hpp"

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <navvi_types/angles.hpp>
#include <set>

#include "record/driven.hpp"
#include "record/told.hpp"

namespace navvi_study::record {
namespace {

using Of = std::function<std::string(const Trial&)>;

constexpr const char* kNothing = "n/a";
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

constexpr double kFelt = 3.0;       // s before a contact
constexpr double kTold = 2.0;       // s
constexpr double kLongAgo = 10.0;   // s; a word before that was no warning

std::string text_of(double value, int decimals = 3) {
  return std::isfinite(value) ? fixed(value, decimals) : kNothing;
}

std::string text_of(const Row* row, const std::string& field) {
  return row != nullptr ? row->fields.get(field) : kNothing;
}

double number_of(const Row* row, const std::string& field) {
  return row != nullptr ? row->fields.number(field).value_or(kUnknown) : kUnknown;
}

const Row* start_of(const Trial& trial) { return trial.first("TRIAL_START"); }

template <typename Iterator, typename Test>
const Row* found(Iterator begin, Iterator end, const Test& test) {
  const auto row = std::find_if(begin, end, test);
  return row == end ? nullptr : &*row;
}

/// The last row with sums of the trial so far.
const Row* sums_of(const Trial& trial) {
  return found(trial.rows.rbegin(), trial.rows.rend(),
               [](const Row& one) { return one.fields.find("path_length").has_value(); });
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

std::string name_of(const Trial& trial) {
  return trial.rows.empty() ? kNothing : trial.rows.front().trial;
}

double duration(const Trial& trial) { return std::max(1.0, trial.end() - trial.begin()); }

// Makers of figures.

/// Of the last one, if there is one.
Of last(const char* type, const char* field, const char* otherwise = kNothing) {
  return [=](const Trial& trial) {
    return trial.last(type) != nullptr ? text_of(trial.last(type), field) : otherwise;
  };
}
Of field_of(const Row* (*row)(const Trial&), const std::string& field) {
  return [=](const Trial& trial) { return text_of(row(trial), field); };
}
Of as_begun(const std::string& field) { return field_of(start_of, field); }
Of as_summed(const std::string& field) { return field_of(sums_of, field); }
Of counts(const std::function<bool(const Row&)>& test) {
  return [=](const Trial& trial) {
    return std::to_string(std::count_if(trial.rows.begin(), trial.rows.end(), test));
  };
}
Of counts(const char* type, const char* kind = nullptr) {
  return counts([=](const Row& row) {
    return row.type == type && (kind == nullptr || row.fields.get("kind") == kind);
  });
}
Of value(double (*of)(const Trial&), int decimals = 3) {
  return [=](const Trial& trial) { return text_of(of(trial), decimals); };
}
/// Of words, which are only known in this language.
Of in_english(const Of& of) {
  return [=](const Trial& trial) {
    const std::string phrases = text_of(start_of(trial), "phrases");
    return phrases == kNothing || phrases == "en.yaml" ? of(trial) : kNothing;
  };
}
/// Of a record with a track.
template <typename Number>
Of tracked(Number (*of)(const Trial&), int decimals = 0) {
  return [=](const Trial& trial) {
    return trial.track.empty() ? kNothing : text_of(static_cast<double>(of(trial)), decimals);
  };
}
Of said(int Speech::*count) {
  return [=](const Trial& trial) { return std::to_string(speech_of(trial).*count); };
}
Of directed(int Directions::*count) {
  return [=](const Trial& trial) {
    const auto found = directions_of(trial);
    return found ? std::to_string((*found).*count) : kNothing;
  };
}

// The end and the way.

std::string elapsed(const Trial& trial) {
  if (const Row* reached = trial.last("GOAL_REACHED")) return reached->fields.get("elapsed");
  return start_of(trial) != nullptr ? text_of(trial.end() - trial.begin()) : kNothing;
}

/// nullptr also where the goal was changed, as the way driven led to another.
const Row* route_of(const Trial& trial) {
  const auto apart = [&](const char* axis) {
    return std::abs(number_of(trial.last("GOAL_SET"), axis) -
                    number_of(trial.first("GOAL_SET"), axis));
  };
  return apart("goal_x") + apart("goal_y") > kSameGoal ? nullptr : trial.first("ROUTE");
}

double spl(const Trial& trial) {
  const Row* end = trial.last("TRIAL_END");
  if (end == nullptr || end->fields.get("result") != "reached") return 0.0;
  const double shortest = number_of(route_of(trial), "shortest_path");
  return shortest / std::max(number_of(sums_of(trial), "path_length"), shortest);
}

/// s, from rows of a type whose field has that word, or without `has` any other, to the next one.
Of time_in(const char* type, const char* field, const char* word, bool has = true) {
  return [=](const Trial& trial) {
    double sum = 0.0, since = 0.0;
    bool inside = false;
    for (const Row& row : trial.rows) {
      if (row.type != type) continue;
      if (inside) sum += time_of(row) - since;
      inside = (row.fields.get(field) == word) == has;
      since = time_of(row);
    }
    return text_of(inside ? sum + trial.end() - since : sum);
  };
}
Of in_state(const char* state) { return time_in("GUIDANCE", "state", state); }

// Contacts.

/// Where something tells of contacts.
Of of_contacts(const Of& of) {
  return [=](const Trial& trial) {
    return text_of(start_of(trial), "contacts") != "unknown" ? of(trial) : "unknown";
  };
}
/// Not finite, and so not known, where the robot stood.
double contacts_per_100m(const Trial& trial) {
  return 100.0 * std::stod(counts("COLLISION")(trial)) / number_of(sums_of(trial), "path_length");
}
std::string listed(const std::vector<std::string>& words) {
  return words.empty() ? "-" : boost::algorithm::join(words, " ");
}
std::string hits(const Trial& trial) {
  std::map<std::string, int> counts;
  for (const Row& row : trial.rows)
    if (row.type == "COLLISION") ++counts[row.fields.get("class", row.fields.get("kind"))];
  std::vector<std::string> words;
  for (const auto& [thing_class, count] : counts)
    words.push_back(thing_class + " " + std::to_string(count));
  return listed(words);
}
bool is_mover(const std::string& thing_class) {
  return thing_class == "worker" || thing_class == "forklift" || thing_class == "pallet_robot";
}
bool is_near_mover(const Row& row) {
  return row.type == "PROXIMITY_ENTER" && is_mover(row.fields.get("class"));
}
double least_gap(const Trial& trial) {
  double least = std::numeric_limits<double>::infinity();
  for (const TrackRow& row : trial.track)
    if (std::isfinite(row.gap)) least = std::min(least, std::max(0.0, static_cast<double>(row.gap)));
  return least;
}

bool is_felt(const TrackRow& row) { return row.motor_left > 0.0F || row.motor_right > 0.0F; }

/// How early a person was warned of what moves before it touched the robot, s.
struct Warning {
  double felt = 0.0;
  double told = 0.0;
};
/// Since when a motor turned while it was near; 0: not at all.
double felt_before(const Trial& trial, const Row& contact) {
  const double time = time_of(contact);
  const double near = time - contact.fields.number("felt").value_or(0.0);
  for (const TrackRow& row : trial.track)
    if (row.time >= near && row.time < time && is_felt(row)) return time - row.time;
  return 0.0;
}
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
/// A row by which the sound device is, or was, lost.
bool is_soundless(const Row& row) {
  return row.fields.get("audio") == "missing" || row.fields.get("device") == "audio";
}
/// nullopt where it is not known what was felt: without a track, and where the motors lead, which
/// turn for the course and not for what is near; a simulated person hears without a device.
std::optional<std::vector<Warning>> warnings_of(const Trial& trial) {
  const std::string settings = " " + text_of(start_of(trial), "settings") + " ";
  const bool simulated = text_of(start_of(trial), "pad") == "simulated";
  if (trial.track.empty() || settings.find(" feedback/lead=hand ") != settings.npos ||
      (!simulated && counts(is_soundless)(trial) != "0"))
    return std::nullopt;
  std::vector<Warning> found;
  for (const Row& row : trial.rows)
    if (row.type == "COLLISION" && is_mover(row.fields.get("class")))
      found.push_back(
          {felt_before(trial, row), told_before(trial, row.fields.get("class"), time_of(row))});
  return found;
}
double late_warnings(const Trial& trial) {
  const auto all = warnings_of(trial);
  const auto late = [](const Warning& one) { return one.felt < kFelt || one.told < kTold; };
  return all ? static_cast<double>(std::count_if(all->begin(), all->end(), late)) : kUnknown;
}
std::string warned(const Trial& trial) {
  const auto all = warnings_of(trial);
  std::vector<std::string> words;
  for (const Warning& one : all.value_or(std::vector<Warning>()))
    words.push_back(text_of(one.felt, 1) + "/" + text_of(one.told, 1));
  return all ? listed(words) : kNothing;
}

// What was said, and how the hands moved.

Of per_minute(int Speech::*count) {
  return [=](const Trial& trial) {
    return text_of(60.0 * (speech_of(trial).*count) / duration(trial), 1);
  };
}
double talk(const Trial& trial) { return speech_of(trial).talk / duration(trial); }
std::string turns_per_minute(const Trial& trial) {
  const auto found = directions_of(trial);
  return found ? text_of(60.0 * found->turns / (trial.end() - trial.begin()), 1) : kNothing;
}
std::size_t led_turns(const Trial& trial) { return turns_of(trial).left.size(); }
template <int Percent>
double residual(const Trial& trial) {
  return navvi_types::degrees(quantile(turns_of(trial).left, 0.01 * Percent));
}
double cue_to_action(const Trial& trial) { return quantile(turns_of(trial).late, 0.5); }
double motors(const Trial& trial) {
  double felt = 0.0;  // s
  for (std::size_t i = 0; i < trial.track.size(); ++i) {
    const TrackRow& row = trial.track[i];
    const double until = i + 1 < trial.track.size() ? trial.track[i + 1].time : trial.end();
    if (is_felt(row)) felt += until - row.time;
  }
  return felt / duration(trial);
}
int speechless(const Trial& trial) { return stands_of(trial).speechless; }
double still(const Trial& trial) { return stands_of(trial).longest; }
double still_since(const Trial& trial) { return stands_of(trial).since; }
std::string still_about(const Trial& trial) { return stands_of(trial).about; }

// What failed.

bool is_safe_stop(const Row& row) {
  // Wheels that had not turned yet were held, not stopped.
  return row.type == "SAFE_STOP" && row.fields.get("moved", "yes") == "yes" &&
         row.fields.get("held", "no") == "no";
}
bool is_device_loss(const Row& row) {
  // That feedback_node was silent is no message of a bag.
  return row.type == "DEVICE_LOST" && row.fields.get("device") != "feedback";
}
std::string sounds_played(const Trial& trial) {
  const std::string audio = text_of(start_of(trial), "audio");
  // A simulated person knows of sounds by message, also where no device plays them.
  const bool unheard =
      text_of(start_of(trial), "pad") == "simulated" && audio != "works" && audio != "simulated";
  return unheard ? kNothing : text_of(sums_of(trial), "sounds_played");
}

const char* kSpl = "Anderson et al. 2018, On Evaluation of Embodied Navigation Agents";
const char* kPaper = "the paper, Table III";

std::vector<Figure> all_figures() {
  constexpr auto stated = Figure::Kind::stated, reported = Figure::Kind::reported;
  std::vector<Figure> all = {
      {"trial", "", "name of its folder", "", name_of, stated},
      {"world", "", "name or file", "", as_begun("world"), stated},
      {"world_hash", "", "of the world that was built", "", as_begun("world_hash"), stated},
      {"seed", "", "draws the world, start and goal", "", as_begun("seed"), stated},
      {"operator", "", "what drives: pad, simulated, ...", "", as_begun("operator"), stated},
      {"participant", "", "a pseudonym", "", as_begun("participant"), stated},
      {"profile", "", "of the parameters", "", as_begun("profile"), stated},
      {"parameters", "", "that were set besides the profile's", "", as_begun("parameters"), stated},
      {"version", "", "of NavVI, with the commit", "", as_begun("version"), stated},
      {"audio", "", "works, missing, off or unknown", "", as_begun("audio"), stated},
      {"pad", "", "likewise; simulated where no person drives", "", as_begun("pad"), stated},
  };
  // Where the trial stands in a study, and on what it ran.
  for (const char* name : {"study", "plan", "group", "condition", "condition_order", "phase",
                           "session", "repeat", "attempt", "replaces", "cpu", "compiler", "bullet",
                           "libm", "audio_device", "voice", "pad_name", "phrases"})
    all.push_back({name, "", "as TRIAL_START has it", "", as_begun(name), stated});
  const std::vector<Figure> counted_ones = {
      {"started_utc", "", "ISO 8601", "", as_begun("utc"), stated},
      {"result", "", "reached, timeout, refused, aborted or invalid", "",
       last("TRIAL_END", "result", "aborted")},
      {"reason", "", "of the result", "", last("TRIAL_END", "reason", "no_end")},
      {"elapsed_s", "s", "simulated time from start to goal, or to the end", kPaper, elapsed},
      {"shelf_collision_count", "", "collisions with shelves", kPaper,
       of_contacts(counts("COLLISION", "shelf"))},
      {"obstacle_collision_count", "", "collisions with everything else", kPaper,
       of_contacts(counts("COLLISION", "obstacle"))},
      {"contacts", "", "collisions with anything", "", of_contacts(counts("COLLISION"))},
      {"contacts_per_100m", "", "collisions per 100 m driven", "",
       of_contacts(value(contacts_per_100m))},
      {"hits", "", "collisions by class", "", of_contacts(hits)},
      {"path_length_m", "m", "way driven", "", as_summed("path_length")},
      {"first_path_length_m", "m", "of the first path, if the goal was not changed", "",
       field_of(route_of, "first_path_length")},
      {"shortest_path_m", "m", "of the shortest path when the first one was planned, likewise", "",
       field_of(route_of, "shortest_path")},
      {"spl", "", "shortest over driven way where the goal was reached, else 0", kSpl, value(spl)},
      {"obstacle_proximity_count", "", "times that an obstacle came within 5 m", kPaper,
       counts("PROXIMITY_ENTER", "obstacle")},
      {"shelf_proximity_count", "", "times that a shelf came within 1 m", kPaper,
       counts("PROXIMITY_ENTER", "shelf")},
      {"mover_proximity_count", "", "times that a worker or vehicle came within 5 m", "",
       counts(is_near_mover)},
      {"least_gap_m", "m", "from the hull to anything", "", value(least_gap, 2)},
      {"late_warnings", "",
       "contacts with movers felt < 3 s or named < 2 s before; in English, where no motors lead",
       "", of_contacts(in_english(value(late_warnings, 0)))},
      {"warned", "", "s felt/named before each contact with a mover, likewise", "",
       of_contacts(in_english(warned))},
      {"stuck_count", "", "times that a cue reports being stuck", "", counts("STUCK")},
      {"replan_count", "", "times that the path was searched again", "",
       last("REPLAN", "count", "0")},
      {"reroute_count", "", "times that the path was replaced by one that leads elsewhere", "",
       as_summed("reroutes")},
      {"safe_stop_count", "", "times that the wheels were stopped for safety", "",
       counts(is_safe_stop)},
      {"round_trip", "s", "of the connection, median: what the robot reports to a command that answers it", "",
       last("TRIAL_END", "round_trip")},
      {"round_trip_99", "s", "highest 99th percentile of 5 s", "", last("TRIAL_END", "round_trip_99")},
      {"link_loss", "", "share of the commands that never came", "", last("TRIAL_END", "link_loss")},
      {"assisted_s", "s", "in which the robot slowed or steered by itself before what it would hit", "",
       time_in("ASSISTED", "does", "nothing", false)},
      {"device_loss_count", "", "losses of pad, audio or voice", "", counts(is_device_loss)},
      {"cues_spoken", "", "sentences", "", as_summed("cues_spoken")},
      {"sounds_played", "", "short sounds", "", sounds_played},
      {"patterns_felt", "", "patterns of the motors", "", as_summed("patterns_felt")},
      {"cues_per_min", "1/min", "sentences", "", per_minute(&Speech::cues)},
      {"words_per_min", "1/min", "words", "", per_minute(&Speech::words)},
      {"talk", "", "share of the time in which something is said", "", value(talk)},
      {"repeats", "", "times that a sentence was said again within 10 s, unasked", "",
       said(&Speech::repeats)},
      {"waits", "", "unasked words to wait or stop", "", said(&Speech::waits)},
      {"hasty", "", "of these, followed by another sentence within 2 s", "", said(&Speech::hasty)},
      {"at_odds", "",
       "times that straight on and a thing ahead were said within 2 s; known in English only", "",
       in_english(said(&Speech::at_odds))},
      {"turns_per_min", "1/min", "changes of the announced hour", "", turns_per_minute},
      {"flips", "", "directions that contradict the one just before", "",
       directed(&Directions::flips)},
      {"misled", "", "turns that are not the ones announced for their corners", "",
       directed(&Directions::misled)},
      {"reversed", "", "directions 4 hours or more from one within 4 s before", "",
       directed(&Directions::reversed)},
      {"following_s", "s", "in that state of the guidance", "", in_state("following")},
      {"blocked_s", "s", "in that state of the guidance", "", in_state("blocked")},
      {"make_room_s", "s", "in that state of the guidance", "", in_state("make_room")},
      {"no_route_s", "s", "in that state of the guidance", "", in_state("no_route")},
      {"off_mesh_s", "s", "in that state of the guidance", "", in_state("off_mesh")},
      {"led_turns", "", "turns on the spot of more than 15 deg, with somewhere to steer", "",
       tracked(led_turns)},
      {"residual_deg", "deg", "angle that these left, median", "", value(residual<50>, 1)},
      {"residual_90_deg", "deg", "90th percentile of this angle", "", value(residual<90>, 1)},
      {"cue_to_action_s", "s", "from a cue that asks for a turn to the turn, median", "",
       value(cue_to_action, 2)},
      {"motors", "", "share of the time in which a motor turns", "", tracked(motors, 3)},
      {"speechless", "", "pushes in vain for 3 s without a word or a sound", "",
       tracked(speechless)},
      {"still_s", "s", "the longest stay within 0.3 m", "", tracked(still, 1)},
      {"still_since_s", "s", "from the start to the begin of that stay", "",
       tracked(still_since, 1)},
      {"still_about", "", "what was about at its end", "", still_about},
  };
  all.insert(all.end(), counted_ones.begin(), counted_ones.end());
  for (const char* chain : {"sensed", "motors", "pattern", "words", "answer", "silence"})
    for (const char* part : {"p50", "p99", "max"})
      all.push_back({std::string(chain) + "_" + part + "_ms", "ms",
                     std::string("how long the person waited: ") + chain + ", " + part, "",
                     as_summed(std::string(chain) + "_" + part + "_ms"), reported});
  const std::vector<Figure> last_ones = {
      {"stopping_delay_s", "s", "that the person takes to stop a turn, as learnt last", "",
       as_summed("stopping_delay_s"), reported},
      {"stopping_spread_s", "s", "its standard deviation", "", as_summed("stopping_spread_s"),
       reported},
      {"turn_error_rad", "rad", "residual error of turns that a sound led, mean of the latest", "",
       as_summed("turn_error_rad"), reported},
      {"words_lead", "", "yes where words had taken over, as that was too much", "",
       as_summed("words_lead"), reported},
      {"missed_messages", "", "messages that were lost on their way", "",
       as_summed("missed_messages")},
      {"state_step", "", "of the world's last state", "", as_summed("state_step")},
      {"state_hash", "", "of the world's last state", "", as_summed("state_hash")},
      {"bag", "", "ok, bad or none", "", last("BAG_CLOSED", "state"), stated},
  };
  all.insert(all.end(), last_ones.begin(), last_ones.end());
  return all;
}

}  // namespace

const Row* Trial::first(const std::string& type) const {
  return found(rows.begin(), rows.end(), [&](const Row& one) { return one.type == type; });
}

const Row* Trial::last(const std::string& type) const {
  return found(rows.rbegin(), rows.rend(), [&](const Row& one) { return one.type == type; });
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
    summary.emplace_back(figure.name, figure.of(trial));
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
  if (first == std::string::npos || text.find('\n', first + 1) != text.size() - 1)
    return std::nullopt;
  const auto names = cells_of(std::string_view(text).substr(0, first));
  const auto cells = cells_of(std::string_view(text).substr(first + 1, text.size() - first - 2));
  if (!names || !cells || names->size() != cells->size()) return std::nullopt;
  Summary summary;
  for (std::size_t i = 0; i < names->size(); ++i) summary.emplace_back((*names)[i], (*cells)[i]);
  const bool whole = summary_csv(summary) == text && !cell_of(summary, "result").empty();
  return whole ? std::optional(summary) : std::nullopt;
}

std::string cell_of(const Summary& summary, const std::string& name) {
  const auto cell = std::find_if(summary.begin(), summary.end(),
                                 [&](const auto& one) { return one.first == name; });
  return cell == summary.end() ? "" : cell->second;
}

std::vector<std::string> differences(const Summary& summary, const Summary& recount) {
  std::set<std::string> left_out = {"bag"};
  // A summary without this column was counted before these had the meaning that they have now.
  if (cell_of(summary, "phrases").empty())
    left_out.insert({"first_path_length_m", "shortest_path_m", "spl", "contacts_per_100m",
                     "late_warnings", "warned", "at_odds"});
  std::vector<std::string> sentences;
  for (const auto& [name, cell] : summary)
    if (const std::string now = cell_of(recount, name); now != cell && left_out.count(name) == 0)
      sentences.push_back(name + " is " + cell + " in the summary and " +
                          (now.empty() ? "missing" : now) + " in the recount");
  return sentences;
}

}  // namespace navvi_study::record
