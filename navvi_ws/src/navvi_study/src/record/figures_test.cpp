#include "record/figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "record/events.hpp"

namespace navvi_study::record {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

class Made : public Trial {
 public:
  Made& add(double time, const char* type, const Fields& fields = Fields()) {
    rows.push_back({"trial-1", static_cast<std::uint32_t>(rows.size() + 1),
                    std::llround(time * kSecond), 0, type, fields});
    return *this;
  }
  /// A sentence, and of a direction its hour.
  Made& say(double time, const char* kind, const char* text, const char* asks = "other",
            int hour = 12, const char* within = "n/a") {
    return add(time, "CUE",
               Fields()
                   .set("modality", "speech")
                   .set("kind", kind)
                   .set("text", text)
                   .set("asks", asks)
                   .set("hour", std::to_string(hour))
                   .set("within", within));
  }
  Made& end(double time, const char* result = "reached") {
    return add(time, "TRIAL_END",
               Fields().set("result", result).set("reason", "goal_reached").set("path_length", 25.0)
                   .set("reroutes", "2").set("cues_spoken", "11").set("sounds_played", "5")
                   .set("patterns_felt", "3").set("missed_messages", "0")
                   .set("round_trip", "0.250").set("round_trip_99", "0.400")
                   .set("link_loss", "0.010").set("state_step", "6000").set("state_hash", "00ff"));
  }
};

Made example() {
  Made trial;
  trial.add(100.0, "TRIAL_START", Fields().set("world", "hall, \"big\"").set("seed", "7"));
  trial.add(101.0, "PROXIMITY_ENTER",
            Fields().set("kind", "obstacle").set("id", "4").set("zone", "left").set("x", 1.0));
  trial.add(102.5, "COLLISION", Fields().set("kind", "shelf").set("count", "1").set("x", 2.0));
  trial.add(103.0, "PROXIMITY_LEAVE", Fields().set("kind", "obstacle").set("id", "4"));
  trial.add(104.0, "COLLISION", Fields().set("kind", "obstacle").set("count", "1"));
  trial.add(105.0, "PROGRESS", Fields().set("path_length", 4.5).set("cues_spoken", "3"));
  trial.add(106.0, "GOAL_REACHED", Fields().set("elapsed", 6.0));
  return trial;
}

std::map<std::string, std::string> columns(const Trial& trial) {
  const auto summary = summarize(trial);
  return {summary.begin(), summary.end()};
}

/// A minute. The robot stands at x = 0 for 10 s, at 5 for 40 s, and at 9.
Made minute() {
  Made trial;
  trial.add(100.0, "TRIAL_START", Fields().set("phrases", "en.yaml").set("audio", "works"));
  trial.add(100.2, "GUIDANCE", Fields().set("state", "following"));
  trial.add(100.2, "ROUTE", Fields().set("first_path_length", 22.0).set("shortest_path", 20.0));
  trial.say(101.0, "straight", "drive straight, 2 meters", "go");
  trial.add(102.0, "CUE_END", Fields().set("modality", "speech"));
  trial.say(102.5, "shelf_near", "shelf ahead");  // at odds with "straight"
  trial.add(104.0, "CUE_END", Fields().set("modality", "speech"));
  trial.say(110.0, "blocked", "wait");
  trial.say(111.0, "direction", "1 o'clock", "turn", 1);  // hasty: 1 s after "wait"
  trial.say(112.0, "direction", "7 o'clock", "turn", 7);  // a flip, and reversed
  trial.say(113.0, "turn_ahead", "in 3 meters, 3 o'clock", "other", 3, "3.0");
  trial.say(114.0, "turn_now", "9 o'clock", "turn", 9);  // misled: 3 was announced
  trial.say(120.0, "shelf_near", "shelf on your left");
  trial.say(125.0, "shelf_near", "shelf on your left");  // a repeat
  trial.add(126.0, "COLLISION", Fields().set("kind", "shelf").set("class", "shelf"));
  trial.add(130.0, "GUIDANCE", Fields().set("state", "blocked"));
  trial.add(131.0, "PROXIMITY_ENTER", Fields().set("kind", "obstacle").set("class", "worker"));
  trial.add(131.0, "PROXIMITY_ENTER", Fields().set("kind", "obstacle").set("class", "box"));
  trial.add(131.0, "PROXIMITY_ENTER", Fields().set("kind", "shelf").set("class", "shelf"));
  trial.say(133.0, "shelf_near", "shelf on your left");  // asked for at 132.5
  trial.say(137.0, "obstacle_near", "worker on your right");
  trial.add(140.0, "GUIDANCE", Fields().set("state", "make_room"));
  trial.add(140.0, "COLLISION",
            Fields().set("kind", "obstacle").set("class", "worker").set("felt", 1.0));
  trial.add(141.0, "STUCK").add(142.0, "REPLAN", Fields().set("count", "4"));
  trial.add(143.0, "SAFE_STOP", Fields().set("moved", "yes"));
  trial.add(144.0, "DEVICE_LOST", Fields().set("device", "pad"));
  trial.add(145.0, "GUIDANCE", Fields().set("state", "no_route"));
  trial.add(150.0, "GUIDANCE", Fields().set("state", "off_mesh"));
  trial.add(152.0, "GUIDANCE", Fields().set("state", "following"));
  trial.add(153.0, "ASSISTED", Fields().set("does", "steers_left"));
  trial.add(154.0, "ASSISTED", Fields().set("does", "slows"));
  trial.add(154.5, "ASSISTED", Fields().set("does", "nothing"));
  trial.add(160.0, "GOAL_REACHED", Fields().set("elapsed", 60.0)).end(160.0);
  for (int i = 0; i <= 3000; ++i) {
    const double t = 0.02 * i;  // s since the start
    TrackRow row;
    row.time = 100.0 + t;
    row.x = i < 500 ? 0.0F : i < 2500 ? 5.0F : 9.0F;
    row.turn_rate = i >= 575 && i < 650 ? -1.0F : 0.0F;  // from 111.5 s to 113 s
    row.steer = 0.1F;
    row.cue = i == 550 || i == 600 ? "direction" : "";
    row.motor_left = i >= 1000 && i < 1300 ? 0.5F : 0.0F;           // for 6 s
    row.stick_forward = i >= 2050 && i < 2250 ? 0.5F : 0.0F;        // for 4 s, in vain
    row.asks = i == 1625 ? 1 : 0;
    row.gap = i == 1300 ? 0.42F : 1.2F;
    row.nearest = "shelf";
    row.state = "blocked";
    row.blocked_by = "worker";
    trial.track.push_back(row);
  }
  return trial;
}

TEST(Figures, are_as_counted_by_hand) {
  const std::vector<std::pair<const char*, const char*>> known = {
      {"result", "reached"},
      {"reason", "goal_reached"},
      {"elapsed_s", "60.000"},
      {"shelf_collision_count", "1"},
      {"obstacle_collision_count", "1"},
      {"contacts", "2"},
      {"contacts_per_100m", "8.000"},  // 2 in 25 m
      {"hits", "shelf 1 worker 1"},
      {"path_length_m", "25.000"},
      {"first_path_length_m", "22.000"},
      {"shortest_path_m", "20.000"},
      {"spl", "0.800"},  // 20 of 25
      {"obstacle_proximity_count", "2"},
      {"shelf_proximity_count", "1"},
      {"mover_proximity_count", "1"},
      {"least_gap_m", "0.42"},
      {"late_warnings", "1"},  // no motor turned while it was near, from 139 s on
      {"warned", "0.0/3.0"},   // "worker" was said at 137 s, the contact is at 140 s
      {"stuck_count", "1"},
      {"replan_count", "4"},
      {"reroute_count", "2"},
      {"safe_stop_count", "1"},
      {"round_trip", "0.250"},
      {"round_trip_99", "0.400"},
      {"link_loss", "0.010"},
      {"assisted_s", "1.500"},
      {"device_loss_count", "1"},
      {"cues_spoken", "11"},
      {"sounds_played", "5"},
      {"patterns_felt", "3"},
      {"cues_per_min", "11.0"},
      {"words_per_min", "34.0"},  // 4 + 2 + 1 + 2 + 2 + 5 + 2 + 4 + 4 + 4 + 4
      {"talk", "0.042"},          // 1 s + 1.5 s of 60 s
      {"repeats", "1"},
      {"waits", "1"},
      {"hasty", "1"},
      {"at_odds", "1"},
      {"turns_per_min", "3.0"},  // 12, 1, 7, 9 o'clock
      {"flips", "1"},
      {"misled", "1"},
      {"reversed", "1"},
      {"following_s", "37.800"},  // from 100.2 to 130 and from 152 to 160
      {"blocked_s", "10.000"},
      {"make_room_s", "5.000"},
      {"no_route_s", "5.000"},
      {"off_mesh_s", "2.000"},
      {"led_turns", "1"},
      {"residual_deg", "5.7"},  // 0.1 rad
      {"residual_90_deg", "5.7"},
      {"cue_to_action_s", "0.50"},  // from 111 to 111.5 s
      {"motors", "0.100"},          // 6 of 60 s
      {"speechless", "1"},
      {"still_s", "40.0"},
      {"still_since_s", "10.0"},
      {"still_about", "blocked by worker, shelf at 1.20 m, \"worker on your right\""},
      {"missed_messages", "0"},
      {"state_step", "6000"},
      {"state_hash", "00ff"}};
  auto summary = columns(minute());
  std::set<std::string> worked_out;
  for (const auto& [name, value] : known) {
    EXPECT_EQ(summary[name], value) << name;
    worked_out.insert(name);
  }
  for (const Figure& figure : figures())
    EXPECT_TRUE(figure.kind != Figure::Kind::counted || worked_out.count(figure.name) > 0)
        << figure.name << " is not worked out by hand";
}

TEST(Figures, of_a_record_without_a_track_are_not_known_where_they_need_one) {
  Made trial = minute();
  trial.track.clear();
  auto summary = columns(trial);
  for (const char* name :
       {"least_gap_m", "late_warnings", "warned", "flips", "turns_per_min", "led_turns",
        "residual_deg", "cue_to_action_s", "motors", "speechless", "still_s", "still_about"})
    EXPECT_EQ(summary[name], "n/a") << name;
  EXPECT_EQ(summary["waits"], "1");
}

TEST(Figures, tell_how_long_a_motor_had_turned_while_the_thing_was_near_that_was_hit) {
  Made trial = minute();
  for (const auto& [near, warned] : {std::pair{30.0, "20.0/3.0"}, {15.0, "15.0/3.0"}}) {
    for (Row& row : trial.rows)
      if (row.type == "COLLISION" && row.fields.get("class") == "worker")
        row.fields = Fields().set("class", "worker").set("felt", near);
    EXPECT_EQ(columns(trial)["warned"], warned);
    EXPECT_EQ(columns(trial)["late_warnings"], "0");
  }
}

TEST(Figures, tell_of_no_warning_by_motors_that_lead) {
  for (const char* lead : {"hand", "ticks"}) {
    Made trial = minute();
    trial.rows.front().fields.set("settings", std::string("cues/a=1 feedback/lead=") + lead);
    for (const char* name : {"late_warnings", "warned"})
      EXPECT_EQ(columns(trial)[name] == "n/a", lead == std::string("hand")) << name;
  }
}

TEST(Figures, tell_of_no_warning_where_a_person_is_led_by_motors_as_no_sound_device_is_open) {
  for (const char* pad : {"works", "simulated"})
    for (const char* lost : {"missing", "amid", "found", "not", "off"}) {
      Made trial = minute();
      Fields& start = trial.rows.front().fields;
      start = Fields().set("phrases", "en.yaml").set("pad", pad);
      const std::string word = lost;
      start.set("audio", word == "missing" || word == "off" ? word : "works");
      if (word == "amid") trial.add(120.0, "DEVICE_LOST", Fields().set("device", "audio"));
      if (word == "found") trial.add(120.0, "DEVICE_BACK", Fields().set("device", "audio"));
      const bool deaf = word != "not" && word != "off" && pad == std::string("works");
      for (const char* name : {"late_warnings", "warned"})
        EXPECT_EQ(columns(trial)[name] == "n/a", deaf) << name << ", " << pad << ", " << lost;
    }
}

TEST(Figures, of_words_are_not_known_in_another_language) {
  Made trial = minute();
  trial.rows.front().fields = Fields().set("phrases", "es.yaml");
  auto summary = columns(trial);
  for (const char* name : {"late_warnings", "warned", "at_odds"})
    EXPECT_EQ(summary[name], "n/a") << name;
  EXPECT_EQ(summary["repeats"], "1");
}

TEST(Figures, compare_no_way_with_the_path_to_a_goal_that_was_changed) {
  Made trial = minute();
  const auto set_goal = [&](double x, int decimals) {
    trial.add(100.0, "GOAL_SET", Fields().set("goal_x", x, decimals).set("goal_y", 0.0));
    return columns(trial);
  };
  const std::vector<std::pair<const char*, const char*>> known = {
      {"spl", "0.800"}, {"first_path_length_m", "22.000"}, {"shortest_path_m", "20.000"}};
  for (const double x : {9.1234567, 2.0, 9.1234567}) {
    auto summary = set_goal(x, trial.first("GOAL_SET") == nullptr ? 6 : 3);
    for (const auto& [name, value] : known) EXPECT_EQ(summary[name], x < 5.0 ? "n/a" : value);
  }
}

TEST(Figures, judge_turns_by_median_and_tail) {
  Made trial;
  trial.add(0.0, "TRIAL_START");
  double time = 0.0;
  const auto drive = [&](double seconds, float rate, float steer, float speed = 0.0F) {
    for (const double end = time + seconds; time < end; time += 0.02) {
      TrackRow row;
      row.time = time;
      row.turn_rate = rate;
      row.speed = speed;
      row.steer = steer;
      trial.track.push_back(row);
    }
  };
  for (const float left : {0.02F, 0.1F, 0.7F}) {
    drive(1.0, -1.0F, left);
    drive(1.0, 0.0F, left);
  }
  drive(0.1, -1.0F, 0.5F);  // 6 degrees: no turn
  drive(1.0, 0.0F, 0.5F);
  drive(1.0, -1.0F, 0.5F, 0.8F);  // a bend
  drive(1.0, 0.0F, 0.5F);
  auto summary = columns(trial.end(time));
  EXPECT_EQ(summary["led_turns"], "3");
  EXPECT_EQ(summary["residual_deg"], "5.7");
  EXPECT_EQ(summary["residual_90_deg"], "33.2");  // 0.1 + 0.8 (0.7 - 0.1) rad
  EXPECT_EQ(summary["cue_to_action_s"], "n/a");
}

TEST(Summary, of_nothing_has_the_same_columns_and_no_figures) {
  const auto nothing = summarize(Trial());
  const auto something = summarize(example());
  ASSERT_EQ(nothing.size(), something.size());
  for (std::size_t i = 0; i < nothing.size(); ++i) {
    EXPECT_EQ(nothing[i].first, something[i].first);
  }
  EXPECT_EQ(columns(Trial())["result"], "aborted");
}

TEST(Summary, where_nothing_tells_of_contacts_they_are_unknown_and_not_0) {
  for (const char* contacts : {"counted", "unknown"}) {
    Made trial;
    trial.add(100.0, "TRIAL_START", Fields().set("contacts", contacts));
    auto summary = columns(trial);
    const bool counted = contacts == std::string("counted");
    EXPECT_EQ(summary["contacts"], counted ? "0" : "unknown");
    for (const char* name : {"shelf_collision_count", "obstacle_collision_count", "hits",
                             "contacts_per_100m", "late_warnings", "warned"})
      EXPECT_EQ(summary[name] == "unknown", !counted) << name;
  }
}

TEST(Summary, without_an_end_is_aborted_and_has_the_sums_of_the_last_progress) {
  auto summary = columns(example());
  EXPECT_EQ(summary["result"], "aborted");
  EXPECT_EQ(summary["path_length_m"], "4.500");
  EXPECT_EQ(summary["cues_spoken"], "3");
}

TEST(Summary, reads_back_with_commas_and_quotes) {
  const auto summary = summarize(example());
  const auto again = parse_summary(summary_csv(summary));
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, summary);
  EXPECT_TRUE(differences(summary, *again).empty());
}

TEST(Summary, that_was_cut_is_not_read) {
  const std::string text = summary_csv(summarize(example()));
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_FALSE(parse_summary(text.substr(0, length))) << length;
  }
}

TEST(Summary, names_the_columns_that_differ) {
  Made trial = example();
  const auto before = summarize(trial);
  trial.rows[2].fields = Fields().set("kind", "obstacle");
  const auto sentences = differences(before, summarize(trial));
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_NE(sentences[0].find("shelf_collision_count"), std::string::npos);
}

TEST(Summary, of_an_older_version_may_lack_columns) {
  auto older = summarize(example());
  older.erase(older.begin() + 10);
  EXPECT_TRUE(differences(older, summarize(example())).empty());
}

TEST(Summary, that_was_counted_before_figures_had_their_meaning_is_compared_without_them) {
  const auto now = summarize(minute());
  for (const bool before : {true, false}) {
    auto summary = now;
    for (auto& [name, cell] : summary)
      if (name == "warned" || name == "spl") cell = "0.7";
    if (before)
      summary.erase(std::find_if(summary.begin(), summary.end(),
                                 [](const auto& one) { return one.first == "phrases"; }));
    EXPECT_EQ(differences(summary, now).size(), before ? 0U : 2U);
    for (auto& [name, cell] : summary)
      if (name == "elapsed_s") cell = "1.000";
    EXPECT_EQ(differences(summary, now).size(), before ? 1U : 3U);
  }
}

TEST(Events, stand_in_the_papers_words_with_onset_and_duration_first) {
  const std::string text = events_csv(example());
  EXPECT_EQ(text.rfind("onset_s,duration_s,trial,participant,wall_clock_utc,trial_type,", 0), 0u);
  const auto holds = [&](const std::string& row) { return text.find(row) != std::string::npos; };
  const std::string who = "trial-1,n/a,n/a,";
  EXPECT_TRUE(holds("1.000,2.000," + who + "proximity to obstacle,1.000,n/a,n/a,n/a,left,"));
  EXPECT_TRUE(holds("2.500,0," + who + "collision with shelf,2.000,n/a,n/a,n/a,n/a,n/a,1,"));
  EXPECT_TRUE(holds("4.000,0," + who + "collision with obstacle,n/a,n/a,n/a,n/a,n/a,1,n/a,"));
  EXPECT_TRUE(holds("6.000,0," + who + "goal reached,n/a,n/a,n/a,n/a,n/a,n/a,n/a,6.000,"));
}

TEST(Events, tell_cues_by_their_words_and_how_long_they_were_heard) {
  Made trial = example();
  trial.rows.front().fields.set("participant", "sub-01");
  trial.add(107.0, "CUE", Fields().set("id", "9").set("kind", "turn_now").set("text", "turn now"));
  trial.add(108.0, "CUE_END", Fields().set("id", "9").set("modality", "sound"));
  trial.add(108.25, "CUE_END", Fields().set("id", "9").set("stage", "ended"));
  trial.rows[7].fields.set("utc", "2026-01-31T12:00:00.250Z");
  EXPECT_NE(events_csv(trial).find("7.000,1.250,trial-1,sub-01,2026-01-31T12:00:00.250Z,cue,"),
            std::string::npos);
  EXPECT_NE(events_csv(trial).find(",turn now,turn_now\n"), std::string::npos);
}

TEST(Events, last_until_a_thing_left_and_not_until_that_was_certain) {
  Made trial = example();
  trial.rows.front().fields.set("leave_time", 0.5);
  EXPECT_NE(events_csv(trial).find("\n1.000,1.500,"), std::string::npos);
}

TEST(Events, have_no_end_where_none_is_recorded_of_them) {
  Made trial = example();
  const auto cue = [&](double time, const char* type, const char* modality) {
    trial.add(time, type, Fields().set("id", "3").set("modality", modality));
  };
  cue(107.0, "CUE", "speech");
  cue(108.0, "CUE", "sound");
  cue(150.0, "CUE", "speech");  // of a feedback_node that was started anew
  cue(151.0, "CUE_END", "speech");
  cue(152.0, "CUE_END", "sound");
  for (const char* row : {"\n7.000,n/a,", "\n8.000,n/a,", "\n50.000,1.000,"})
    EXPECT_NE(events_csv(trial).find(row), std::string::npos) << row;
}

TEST(Events, tell_what_was_done_how_late_it_was_and_by_whom) {
  Made trial = example();
  for (const auto& [type, field, value] :
       {std::tuple{"ASSISTED", "does", "slows"}, {"LINK_LATE", "late", "too_late"},
        {"INTRUDER", "node", "/teleop"}, {"PARAMETER_SET", "name", "sim/seed"}}) {
    trial.add(107.0, type, Fields().set(field, value));
    EXPECT_NE(events_csv(trial).find(std::string(",") + value + "\n"), std::string::npos) << type;
  }
}

TEST(Events, stand_in_the_order_of_their_onsets_however_late_they_came) {
  Made trial = example();
  trial.add(103.0, "CUE", Fields().set("id", "9").set("kind", "turn_now").set("text", "turn now"));
  std::istringstream lines(events_csv(trial));
  std::vector<double> onsets;
  std::string line;
  std::getline(lines, line);  // the header
  while (std::getline(lines, line)) onsets.push_back(std::stod(line));
  EXPECT_NE(std::find(onsets.begin(), onsets.end(), 3.0), onsets.end());
  EXPECT_TRUE(std::is_sorted(onsets.begin(), onsets.end()));
}

TEST(Events, of_nothing_are_a_header) {
  const std::string text = events_csv(Trial());
  EXPECT_EQ(text.find('\n'), text.size() - 1);
}

TEST(Summary, F1_sounds_that_no_device_played_to_a_simulated_person_were_not_played) {
  for (const auto& [audio, played] : {std::pair{"works", "20"}, {"missing", "n/a"}}) {
    Made trial;
    trial.add(100.0, "TRIAL_START", Fields().set("pad", "simulated").set("audio", audio));
    trial.add(105.0, "PROGRESS", Fields().set("path_length", 4.5).set("sounds_played", "20"));
    EXPECT_EQ(columns(trial)["sounds_played"], played) << audio;
    EXPECT_EQ(columns(trial)["pad"], "simulated");
  }
}

TEST(Summary, wheels_that_were_held_before_they_turned_are_no_safe_stop) {
  Made trial = example();
  trial.add(107.0, "SAFE_STOP", Fields().set("reason", "command_lost").set("moved", "no"));
  EXPECT_EQ(columns(trial)["safe_stop_count"], "0");
  trial.add(108.0, "SAFE_STOP", Fields().set("reason", "command_lost").set("moved", "yes"));
  EXPECT_EQ(columns(trial)["safe_stop_count"], "1");
  trial.add(109.0, "SAFE_STOP", Fields().set("held", "yes").set("moved", "yes"));
  EXPECT_EQ(columns(trial)["safe_stop_count"], "1") << "they stood already";
}

TEST(Summary, F4_counts_the_devices_that_were_lost) {
  Made trial = example();
  for (const char* device : {"speech", "pad", "feedback"})
    trial.add(107.0, "DEVICE_LOST", Fields().set("device", device));
  EXPECT_EQ(columns(trial)["device_loss_count"], "2");
}

}  // namespace
}  // namespace navvi_study::record
