// Damaged records.

#include "fuzz.hpp"

#include <gtest/gtest.h>

#include <navvi_files/files.hpp>

#include "record/figures.hpp"
#include "record/journal.hpp"
#include "record/track.hpp"
#include "record/trial_folder.hpp"

namespace navvi_study::record {
namespace {

std::string text_of(const std::string& path) {
  return navvi_files::read_file(path).value_or("");
}

std::string journal() {
  std::string text = std::string(kJournalHeader) + "\n";
  std::uint32_t seq = 0;
  const auto add = [&](const std::string& type, const std::string& name, const std::string& value) {
    Row row{"trial-1", ++seq, seq * 1'000'000'000LL, seq * 1'000'000'000LL, type, {}};
    row.fields.set(name, value);
    text += format_row(row);
  };
  add("TRIAL_START", "participant", "sub-01");
  add("PROGRESS", "distance", "1.25");
  add("CUE", "text", "go on, \"straight\", 5 meters");
  add("TRIAL_END", "result", "reached");
  return text;
}

TEST(FuzzRecords, a_journal_is_put_in_order_once_and_loses_no_good_row) {
  navvi_test::fuzz({journal()}, "journal.csv", [](const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    const JournalContents before = read_journal(text_of(path));
    for (const Row& row : before.rows) {
      const std::string line = format_row(row);
      EXPECT_TRUE(parse_row(std::string_view(line).substr(0, line.size() - 1)) == row) << line;
    }
    const Recovery first = recover(folder);
    const std::string after = text_of(path);
    if (first.problem.empty()) {
      const JournalContents good = read_journal(after);
      EXPECT_EQ(good.damage, "");
      ASSERT_GE(good.rows.size(), before.rows.size());
      EXPECT_TRUE(std::equal(before.rows.begin(), before.rows.end(), good.rows.begin()));
    }
    EXPECT_FALSE(recover(folder).changed) << first.report;
    EXPECT_EQ(text_of(path), after);
    static_cast<void>(summarize(read_trial(folder)));
  });
}

TEST(FuzzRecords, a_track_and_a_summary_are_read_or_not) {
  Track track(5);
  track[1].cue = "straight";
  navvi_test::fuzz({track_npy(track)}, "track.npy", [](const std::string& path) {
    const auto read = parse_track(text_of(path));
    if (read) {
      EXPECT_EQ(parse_track(track_npy(*read))->size(), read->size());
    }
  });
  navvi_test::fuzz({summary_csv(summarize({}))}, "summary.csv", [](const std::string& path) {
    const std::string text = text_of(path);
    if (const auto read = parse_summary(text)) {
      EXPECT_EQ(summary_csv(*read), text);
    }
  });
}

}  // namespace
}  // namespace navvi_study::record
