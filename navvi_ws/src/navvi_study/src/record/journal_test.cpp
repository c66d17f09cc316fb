#include "record/journal.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <iterator>
#include <stdexcept>

#include "record/figures.hpp"
#include "record/trial_folder.hpp"
#include "temp_folder.hpp"

namespace navvi_study::record {
namespace {

namespace fs = std::filesystem;

class Folder : public testing::Test {
 protected:
  [[nodiscard]] fs::path journal() const { return path_ / "journal.csv"; }
  [[nodiscard]] std::string bytes() const { return navvi_files::read_file(journal()).value_or(""); }
  [[nodiscard]] Journal open() const { return Journal(path_, "trial-1", 0, calls_); }
  /// A finished trial's journal.
  std::string finished() {
    Journal journal = open();
    Fields fields;
    fields.set("world", "a;b").set("seed", std::uint64_t{3});
    EXPECT_TRUE(journal.append("TRIAL_START", fields, 100, 1, true));
    fields = Fields().set("kind", "shelf").set("count", std::uint64_t{1});
    EXPECT_TRUE(journal.append("COLLISION", fields, 200, 2, true));
    fields = Fields().set("result", "reached").set("reason", "goal_reached");
    EXPECT_TRUE(journal.append("TRIAL_END", fields, 300, 3, true));
    return bytes();
  }
  void put(const std::string& text) const {
    ASSERT_FALSE(navvi_files::write_atomically(journal(), text).has_value());
  }

  navvi_test::TempFolder folder_;
  const fs::path& path_ = folder_;
  navvi_files::SystemCalls calls_ = navvi_files::SystemCalls::real();
};

using AJournal = Folder;
using Recovering = Folder;

TEST_F(AJournal, reads_back_what_was_appended) {
  std::vector<Row> rows;
  {
    errno = EIO;  // of a call before
    Journal journal = open();
    ASSERT_TRUE(journal.append("TRIAL_START", Fields(), 1, 2, true));
    ASSERT_TRUE(journal.append("PROGRESS", Fields().set("x", 1.5), 3, 4, false));
    rows = journal.rows();
    EXPECT_EQ(fs::file_size(path_ / "journal.reserve"), std::uintmax_t{1} << 20);
  }
  const auto contents = read_journal(bytes());
  EXPECT_EQ(contents.damage, "");
  EXPECT_EQ(contents.rows, rows);
  EXPECT_FALSE(fs::exists(path_ / "journal.reserve")) << "the reserve is given back";
}

TEST_F(AJournal, is_never_opened_twice) {
  { Journal journal = open(); }
  EXPECT_THROW(open(), std::runtime_error);
  fs::rename(journal(), path_ / "journal.reserve");
  EXPECT_THROW(open(), std::runtime_error) << "its reserve is another's";
}

TEST_F(AJournal, of_a_folder_that_is_not_there_or_full_is_refused) {
  EXPECT_THROW(Journal(path_ / "none", "t", 0), std::runtime_error);
  EXPECT_THROW(Journal(path_, "t", std::uint64_t{1} << 60), std::runtime_error);
  EXPECT_THROW(Journal("/proc", "t", 0), std::runtime_error);
}

TEST_F(AJournal, L4_with_any_byte_changed_is_told_or_reads_the_same) {
  const std::string whole = finished();
  const auto rows = read_journal(whole).rows;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int flip : {1, 32, 128}) {
      std::string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ flip);
      const auto contents = read_journal(changed);
      ASSERT_FALSE(contents.damage.empty()) << "byte " << at;
      ASSERT_LE(contents.rows.size(), rows.size());
      for (std::size_t i = 0; i < contents.rows.size(); ++i) {
        ASSERT_EQ(contents.rows[i], rows[i]) << "byte " << at;
      }
    }
  }
}

TEST_F(AJournal, cut_anywhere_keeps_the_rows_before) {
  const std::string whole = finished();
  const auto rows = read_journal(whole).rows;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto contents = read_journal(std::string_view(whole).substr(0, length));
    const bool between_rows = length > 0 && whole[length - 1] == '\n';
    ASSERT_EQ(contents.damage.empty(), between_rows) << length;
    ASSERT_TRUE(between_rows || contents.torn) << length;
    for (std::size_t i = 0; i < contents.rows.size(); ++i) ASSERT_EQ(contents.rows[i], rows[i]);
  }
}

TEST_F(AJournal, L3_survives_interrupted_and_short_writes) {
  int turn = 0;
  calls_.write = [&turn](int file, const void* data, std::size_t size) -> ssize_t {
    if (++turn % 2 == 0) {
      errno = EINTR;
      return -1;
    }
    return ::write(file, data, std::min<std::size_t>(size, 7));
  };
  {
    Journal journal = open();
    ASSERT_TRUE(journal.append("TRIAL_START", Fields(), 1, 2, true));
  }
  EXPECT_EQ(read_journal(bytes()).rows.size(), 1u);
}

TEST_F(AJournal, is_on_the_disk_with_its_folders_before_a_trial_begins) {
  const std::vector<fs::path> all = {fs::canonical(path_) / "journal.csv", fs::canonical(path_),
                                     fs::canonical(path_).parent_path()};
  std::vector<fs::path> synced;
  std::size_t fails = all.size();
  calls_.fdatasync = calls_.fsync = [&](int file) {
    synced.push_back(fs::read_symlink("/proc/self/fd/" + std::to_string(file)));
    errno = EIO;
    return synced.size() - 1 == fails ? -1 : 0;
  };
  (void)open();
  EXPECT_EQ(synced, all);
  for (fails = 0; fails < all.size(); ++fails) {
    fs::remove(journal());
    synced.clear();
    EXPECT_THROW((void)open(), std::runtime_error) << all[fails];
  }
}

TEST_F(AJournal, that_lacks_a_row_or_has_one_of_another_trial_is_damaged_there) {
  std::string whole = finished();
  const auto second = whole.find("trial-1,2,");
  whole.erase(second, whole.find('\n', second) + 1 - second);
  EXPECT_EQ(read_journal(whole).rows.size(), 1u);
  EXPECT_EQ(read_journal(whole).damage, "the journal is damaged at row 2");
  whole.resize(second);
  whole += format_row({"trial-2", 2, 200, 2, "COLLISION", Fields()});
  EXPECT_EQ(read_journal(whole).damage, "the journal is damaged at row 2");
}

TEST_F(AJournal, L3_is_broken_for_good_after_a_failed_sync) {
  bool fail = false;
  int asked = 0;
  calls_.fdatasync = [&](int file) {
    ++asked;
    if (!fail) return ::fdatasync(file);
    errno = EIO;
    return -1;
  };
  Journal journal = open();
  ASSERT_TRUE(journal.append("TRIAL_START", Fields(), 1, 2, true));
  fail = true;
  const int before = asked + 1;
  EXPECT_TRUE(journal.append("PROGRESS", Fields(), 2, 3, false));
  EXPECT_FALSE(journal.append("COLLISION", Fields(), 3, 4, true));
  EXPECT_EQ(journal.problem(), navvi_files::failure("write the journal", EIO));
  fail = false;
  EXPECT_FALSE(journal.append("COLLISION", Fields(), 5, 6, true));
  EXPECT_EQ(asked, before) << "a failed sync is never asked again";
  EXPECT_TRUE(journal.broken());
  EXPECT_EQ(journal.rows().size(), 2u);
}

TEST_F(AJournal, L1_on_a_full_disk_gives_up_its_reserve_and_keeps_the_row) {
  bool full = false, has_room = true;
  int error = ENOSPC;
  calls_.write = [&](int file, const void* data, std::size_t size) -> ssize_t {
    if (full && (fs::exists(path_ / "journal.reserve") || !has_room)) {
      errno = error;
      return -1;
    }
    return ::write(file, data, size);
  };
  Journal journal = open();
  full = true;
  EXPECT_TRUE(journal.append("COLLISION", Fields(), 3, 4, true));
  EXPECT_TRUE(journal.full());
  EXPECT_FALSE(journal.broken());
  EXPECT_EQ(read_journal(bytes()).rows.size(), 1u);
  has_room = false;
  EXPECT_FALSE(journal.append("COLLISION", Fields(), 3, 4, true));
  error = EIO;
  full = false;
  fs::remove(this->journal());
  {
    Journal other = open();
    full = true;
    EXPECT_FALSE(other.append("COLLISION", Fields(), 3, 4, true));
    EXPECT_FALSE(other.full()) << "the reserve is for a full disk";
  }
  fs::remove(this->journal());
  EXPECT_THROW(open(), std::runtime_error) << "no header";
}

TEST_F(AJournal, knows_that_the_disk_is_full_before_a_row_does_not_fit) {
  const Journal journal = open();
  EXPECT_FALSE(journal.full());
  EXPECT_TRUE(journal.full(fs::space(path_).capacity + 1));
}

TEST_F(AJournal, that_may_grow_no_more_says_so_at_the_next_row) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    Journal journal = open();
    const rlimit small{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &small);
    for (int i = 0; i < 1000; ++i) {
      if (journal.append("PROGRESS", Fields().set("x", 1.0), i, i, false)) continue;
      ::_exit(journal.broken() ? 0 : 1);
    }
    ::_exit(2);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const auto contents = read_journal(bytes());
  EXPECT_EQ(contents.damage, "") << "nothing of the row that does not fit is left";
  EXPECT_GT(contents.rows.size(), 40u);
}

TEST_F(Recovering, leaves_a_whole_trial_as_it_is) {
  const std::string whole = finished();
  const Recovery recovery = recover(path_);
  EXPECT_FALSE(recovery.changed);
  EXPECT_EQ(recovery.problem, "");
  EXPECT_EQ(bytes(), whole);
}

TEST_F(Recovering, leaves_a_running_trial_alone) {
  Journal journal = open();
  ASSERT_TRUE(journal.append("TRIAL_START", Fields(), 1, 2, true));
  EXPECT_TRUE(recover(path_).in_use);
  EXPECT_TRUE(journal.append("TRIAL_END", Fields(), 3, 4, true));
}

TEST_F(Recovering, closes_a_trial_cut_anywhere_and_changes_nothing_the_second_time) {
  const std::string whole = finished();
  const auto first_row_end = whole.find('\n', whole.find('\n') + 1) + 1;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    for (const auto& entry : fs::directory_iterator(path_)) fs::remove(entry.path());
    put(whole.substr(0, length));
    const Recovery first = recover(path_);
    ASSERT_EQ(first.problem, "") << length;
    const std::string after = bytes();
    ASSERT_EQ(read_journal(after).damage, "") << length;
    const auto summary = summarize({read_journal(after).rows});
    if (length >= first_row_end) {
      ASSERT_EQ(read_journal(after).rows.back().fields.get("result"), "aborted") << length;
    }
    const Recovery second = recover(path_);
    ASSERT_FALSE(second.changed) << length;
    ASSERT_EQ(bytes(), after) << length;
  }
}

TEST_F(Recovering, calls_a_trial_with_damage_in_the_middle_invalid) {
  std::string whole = finished();
  whole[whole.find("COLLISION")] = 'X';
  put(whole);
  const Recovery recovery = recover(path_);
  EXPECT_EQ(recovery.rows.back().fields.get("result"), "invalid");
  EXPECT_NE(recovery.report.find("An open trial was closed as invalid"), std::string::npos);
  EXPECT_TRUE(fs::exists(path_ / "journal.torn")) << "nothing is deleted";
  EXPECT_FALSE(recover(path_).changed);
}

TEST_F(Recovering, calls_a_trial_with_damage_behind_its_end_invalid_and_one_without_rows_nothing) {
  const std::string header = std::string(kJournalHeader) + "\n";
  const std::string whole = finished();
  put(whole + "?\n");
  EXPECT_EQ(recover(path_).rows.back().fields.get("reason"), "journal_damaged");
  EXPECT_FALSE(recover(path_).changed);
  put(header + "?\n");
  EXPECT_TRUE(recover(path_).rows.empty());
  EXPECT_EQ(bytes(), header);
}

TEST_F(Recovering, sums_up_again_what_has_no_whole_summary) {
  const fs::path trial = path_ / "trial", summary = trial / "summary.csv";
  fs::create_directory(trial);
  ASSERT_FALSE(navvi_files::write_atomically(trial / "journal.csv", finished()));
  EXPECT_EQ(recover_trials(path_).size(), 1u);
  const std::string whole = navvi_files::read_file(summary).value();
  std::string retitled = whole;
  retitled[retitled.find("result")] = 'X';
  for (const std::string& damaged : {std::string(), whole.substr(0, whole.size() / 2),
                                     whole.substr(0, whole.size() - 1), retitled}) {
    ASSERT_FALSE(navvi_files::write_atomically(summary, damaged));
    EXPECT_EQ(recover_trials(path_).size(), 1u);
    EXPECT_EQ(navvi_files::read_file(summary).value(), whole);
  }
  EXPECT_TRUE(recover_trials(path_).empty());
}

TEST_F(Recovering, calls_an_open_trial_what_its_summary_does) {
  const std::string whole = finished();
  put(whole.substr(0, whole.find("trial-1,3,")));
  const Summary summary = {{"result", "invalid"}, {"reason", "r"}};
  ASSERT_FALSE(navvi_files::write_atomically(path_ / "summary.csv", summary_csv(summary)));
  const Recovery recovery = recover(path_);
  EXPECT_TRUE(recovery.changed);
  const Fields end = recovery.rows.back().fields;
  EXPECT_EQ(end.get("result") + " " + end.get("reason"), "invalid r");
}

TEST_F(Recovering, says_what_it_cannot_read_or_write) {
  EXPECT_NE(recover(path_).problem, "") << "there is no journal";
  put(finished().substr(0, 200));
  const std::string torn = bytes();
  int calls = 0, fails = -1;
  calls_.fsync = [&](int file) { return errno = EIO, calls++ == fails ? -1 : ::fsync(file); };
  EXPECT_EQ(recover(path_, calls_).problem, "");
  const int all = calls;
  EXPECT_EQ(all, 4) << "what is torn, its folder, the journal without it, and its end";
  for (fails = 0; fails < all; ++fails) {
    put(torn);
    calls = 0;
    fs::remove(path_ / "journal.torn");
    EXPECT_NE(recover(path_, calls_).problem, "") << fails;
  }
  fs::resize_file(journal(), std::uintmax_t{1} << 30);
  EXPECT_NE(recover(path_).problem, "") << "that is no journal";
}

TEST_F(Recovering, still_calls_it_invalid_if_it_was_itself_cut_short) {
  std::string whole = finished();
  whole[whole.find("reached")] = 'X';
  const std::string good = whole.substr(0, read_journal(whole).good_bytes);
  ASSERT_FALSE(
      navvi_files::write_atomically(path_ / "journal.torn", whole.substr(good.size())).has_value());
  put(good);
  EXPECT_EQ(recover(path_).rows.back().fields.get("result"), "invalid");
}

TEST_F(Recovering, sets_each_torn_end_aside_once_and_overwrites_none) {
  const std::string whole = finished();
  const auto aside = [&](const std::string& name) {
    return navvi_files::read_file(path_ / name).value_or("");
  };
  for (const char* torn : {"trial-1,4,a", "trial-1,4,b", "trial-1,4,a"}) {
    put(whole + torn);
    EXPECT_TRUE(recover(path_).changed);
  }
  EXPECT_EQ(aside("journal.torn"), "trial-1,4,a");
  EXPECT_EQ(aside("journal.torn.2"), "trial-1,4,b");
  EXPECT_FALSE(fs::exists(path_ / "journal.torn.3"));
  EXPECT_EQ(bytes(), whole);
}

TEST_F(Recovering, keeps_no_file_open) {
  const auto opened = [] {
    const fs::directory_iterator files("/proc/self/fd");
    return std::distance(begin(files), end(files));
  };
  put(finished());
  const auto before = opened();
  for (int i = 0; i < 5; ++i) (void)recover(path_);
  EXPECT_EQ(opened(), before);
}

TEST_F(Folder, a_file_is_replaced_as_a_whole_or_not_at_all) {
  const fs::path file = path_ / "summary.csv";
  ASSERT_FALSE(navvi_files::write_atomically(file, "old").has_value());
  calls_.fsync = [](int) {
    errno = EIO;
    return -1;
  };
  EXPECT_TRUE(navvi_files::write_atomically(file, "new", calls_).has_value());
  EXPECT_EQ(navvi_files::read_file(file).value(), "old");
  calls_ = navvi_files::SystemCalls::real();
  calls_.rename = [](const char*, const char*) {
    errno = EROFS;
    return -1;
  };
  EXPECT_TRUE(navvi_files::write_atomically(file, "new", calls_).has_value());
  EXPECT_EQ(navvi_files::read_file(file).value(), "old");
  EXPECT_FALSE(fs::exists(path_ / "summary.csv.tmp"));
}

TEST_F(Folder, two_trials_of_one_second_get_two_folders) {
  const auto first = create_trial_folder(path_ / "new" / "trials", 0);
  const auto second = create_trial_folder(path_ / "new" / "trials", 0);
  EXPECT_EQ(first.filename(), "trial-19700101T000000Z");
  EXPECT_EQ(second.filename(), "trial-19700101T000000Z-2");
  EXPECT_THROW((void)create_trial_folder("/proc/trials", 0), std::runtime_error);
}

}  // namespace
}  // namespace navvi_study::record
