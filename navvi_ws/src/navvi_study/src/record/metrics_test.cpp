#include "record/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace navvi_study::record {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

class Trial {
 public:
  Trial& add(double time, const char* type, const Fields& fields = Fields()) {
    rows.push_back({"trial-1", static_cast<std::uint32_t>(rows.size() + 1),
                    static_cast<std::int64_t>(time * kSecond), 0, type, fields});
    return *this;
  }
  std::vector<Row> rows;
};

Trial example() {
  Trial trial;
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

std::map<std::string, std::string> columns(const std::vector<Row>& rows) {
  const auto summary = summarize(rows);
  return {summary.begin(), summary.end()};
}

TEST(Summary, of_nothing_has_the_same_columns_and_no_figures) {
  const auto nothing = summarize({});
  const auto something = summarize(example().rows);
  ASSERT_EQ(nothing.size(), something.size());
  for (std::size_t i = 0; i < nothing.size(); ++i) {
    EXPECT_EQ(nothing[i].first, something[i].first);
  }
  EXPECT_EQ(columns({})["result"], "aborted");
}

TEST(Summary, where_nothing_tells_of_contacts_they_are_unknown_and_not_0) {
  for (const char* contacts : {"counted", "unknown"}) {
    Trial trial;
    trial.add(100.0, "TRIAL_START", Fields().set("contacts", contacts));
    auto summary = columns(trial.rows);
    const bool counted = contacts == std::string("counted");
    EXPECT_EQ(summary["shelf_collision_count"], counted ? "0" : "unknown");
    EXPECT_EQ(summary["obstacle_collision_count"], counted ? "0" : "unknown");
  }
}

TEST(Summary, counts_what_the_rows_say) {
  Trial trial = example();
  trial.add(106.0, "TRIAL_END", Fields().set("result", "reached").set("reason", "goal_reached"));
  auto summary = columns(trial.rows);
  EXPECT_EQ(summary["result"], "reached");
  EXPECT_EQ(summary["elapsed_s"], "6.000");
  EXPECT_EQ(summary["shelf_collision_count"], "1");
  EXPECT_EQ(summary["obstacle_collision_count"], "1");
  EXPECT_EQ(summary["obstacle_proximity_count"], "1");
  EXPECT_EQ(summary["path_length_m"], "4.500");
  EXPECT_EQ(summary["cues_spoken"], "3");
}

TEST(Summary, without_an_end_is_aborted) {
  EXPECT_EQ(columns(example().rows)["result"], "aborted");
}

TEST(Summary, reads_back_with_commas_and_quotes) {
  const auto summary = summarize(example().rows);
  const auto again = parse_summary(summary_csv(summary));
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, summary);
  EXPECT_TRUE(differences(summary, *again).empty());
}

TEST(Summary, that_was_cut_is_not_read) {
  const std::string text = summary_csv(summarize(example().rows));
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_FALSE(parse_summary(text.substr(0, length))) << length;
  }
}

TEST(Summary, names_the_columns_that_differ) {
  auto rows = example().rows;
  const auto before = summarize(rows);
  rows.erase(rows.begin() + 2);
  const auto sentences = differences(before, summarize(rows));
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_NE(sentences[0].find("shelf_collision_count"), std::string::npos);
}

TEST(Summary, of_an_older_version_may_lack_the_columns_that_came_later) {
  const auto now = summarize(example().rows);
  const auto without = [&](const std::string& column) {
    auto older = now;
    older.erase(std::remove_if(older.begin(), older.end(),
                               [&](const auto& cell) { return cell.first == column; }),
                older.end());
    return older;
  };
  for (const char* column : {"version", "started_utc", "reroute_count"})
    EXPECT_TRUE(differences(without(column), now).empty()) << column;
  EXPECT_FALSE(differences(without("result"), now).empty());
}

TEST(Events, stand_in_the_papers_words_with_onset_and_duration_first) {
  const std::string text = events_csv(example().rows);
  EXPECT_EQ(text.rfind("onset_s,duration_s,trial,participant,wall_clock_utc,trial_type,", 0), 0u);
  const auto holds = [&](const std::string& row) { return text.find(row) != std::string::npos; };
  const std::string who = "trial-1,n/a,n/a,";
  EXPECT_TRUE(holds("1.000,2.000," + who + "proximity to obstacle,1.000,n/a,n/a,n/a,left,"));
  EXPECT_TRUE(holds("2.500,0," + who + "collision with shelf,2.000,n/a,n/a,n/a,n/a,n/a,1,"));
  EXPECT_TRUE(holds("4.000,0," + who + "collision with obstacle,n/a,n/a,n/a,n/a,n/a,1,n/a,"));
  EXPECT_TRUE(holds("6.000,0," + who + "goal reached,n/a,n/a,n/a,n/a,n/a,n/a,n/a,6.000,"));
}

TEST(Events, tell_cues_by_their_words_and_how_long_they_were_heard) {
  Trial trial = example();
  trial.rows.front().fields.set("participant", "sub-01");
  trial.add(107.0, "CUE", Fields().set("id", "9").set("kind", "turn_now").set("text", "turn now"));
  trial.add(108.0, "CUE_END", Fields().set("id", "9").set("modality", "sound"));
  trial.add(108.25, "CUE_END", Fields().set("id", "9").set("stage", "ended"));
  trial.rows[7].fields.set("utc", "2026-01-31T12:00:00.250Z");
  EXPECT_NE(events_csv(trial.rows).find("7.000,1.250,trial-1,sub-01,2026-01-31T12:00:00.250Z,cue,"),
            std::string::npos);
  EXPECT_NE(events_csv(trial.rows).find(",turn now,turn_now\n"), std::string::npos);
}

TEST(Events, of_nothing_are_a_header) {
  const std::string text = events_csv({});
  EXPECT_EQ(text.find('\n'), text.size() - 1);
}

TEST(Summary, F1_sounds_that_no_device_played_to_a_simulated_person_were_not_played) {
  auto rows = example().rows;
  rows.back().fields.set("sounds_played", std::uint64_t{20}).set("path_length", 3.0);
  rows.front().fields.set("pad", "simulated").set("audio", "works");
  EXPECT_EQ(columns(rows)["sounds_played"], "20");
  auto silent = example().rows;
  silent.back().fields.set("sounds_played", std::uint64_t{20}).set("path_length", 3.0);
  silent.front().fields.set("pad", "simulated").set("audio", "missing");
  EXPECT_EQ(columns(silent)["sounds_played"], "n/a");
  EXPECT_EQ(columns(silent)["pad"], "simulated");
}

TEST(Summary, wheels_that_were_held_before_they_turned_are_no_safe_stop) {
  auto rows = example().rows;
  const auto before = std::stoi(columns(rows)["safe_stop_count"]);
  Row stop = rows.back();
  stop.type = "SAFE_STOP";
  stop.fields = Fields().set("reason", "command_lost").set("moved", "no");
  rows.push_back(stop);
  EXPECT_EQ(std::stoi(columns(rows)["safe_stop_count"]), before);
  rows.back().fields = Fields().set("reason", "command_lost").set("moved", "yes");
  EXPECT_EQ(std::stoi(columns(rows)["safe_stop_count"]), before + 1);
  rows.back().fields = Fields().set("reason", "clock_jumped").set("held", "yes").set("moved", "yes");
  EXPECT_EQ(std::stoi(columns(rows)["safe_stop_count"]), before) << "they stood already";
}

TEST(Summary, F4_counts_the_devices_that_were_lost) {
  auto rows = example().rows;
  const auto before = std::stoi(columns(rows)["device_loss_count"]);
  Row lost = rows.back();
  lost.type = "DEVICE_LOST";
  for (const char* device : {"speech", "pad", "feedback"}) {
    lost.fields = Fields().set("device", device);
    rows.push_back(lost);
  }
  EXPECT_EQ(std::stoi(columns(rows)["device_loss_count"]), before + 2);
}

}  // namespace
}  // namespace navvi_study::record
