// A trial whose program is killed, or whose disk fails, at each of its calls in turn, and one whose
// machine loses its power. The events that it has published come by a pipe, and are the judge.

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>
#include <navvi_files/cache.hpp>
#include <navvi_types/random.hpp>
#include <set>

#include "record/row.hpp"
#include "record/trial_folder.hpp"
#include "trials.hpp"

namespace navvi_study::trial {
namespace {

using Lines = std::vector<std::string>;

enum class Fault {
  none,
  kill_before,
  kill_half,
  kill_after,
  no_space,
  io,
  interrupted,
  short_write
};
constexpr std::array kFaults = {Fault::kill_before, Fault::kill_half, Fault::kill_after,
                                Fault::no_space,    Fault::io,        Fault::interrupted,
                                Fault::short_write};

/// A call that reached the disk.
struct Call {
  enum class Kind { write, sync, rename } kind;
  fs::path path;
  std::string bytes = {};  ///< that were written
  std::size_t place = 0;   ///< of these in the file
  fs::path to = {};        ///< new name
};

fs::path path_of(int file) {
  return fs::read_symlink("/proc/self/fd/" + std::to_string(file));
}

std::size_t place_of(int file) {
  struct stat is {};
  fstat(file, &is);
  const bool appends = (fcntl(file, F_GETFL) & O_APPEND) != 0;
  return static_cast<std::size_t>(appends ? is.st_size : lseek(file, 0, SEEK_CUR));
}

/// Calls of which one meets a fault, and which are noted where `calls` is given.
class Disk {
 public:
  explicit Disk(Fault fault = Fault::none, int at = 0, std::vector<Call>* calls = nullptr)
      : fault_(fault), at_(at), calls_(calls) {}

  /// So many were there.
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] navvi_files::SystemCalls calls() {
    const auto write = [this](int file, const void* bytes, std::size_t size) -> ssize_t {
      const std::string_view all(static_cast<const char*>(bytes), size);
      if (calls_) note({Call::Kind::write, path_of(file), std::string(all), place_of(file)});
      return meet(size, [&](std::size_t part) { return ::write(file, bytes, part); });
    };
    const auto sync = [this](int file) {
      if (calls_) note({Call::Kind::sync, path_of(file)});
      return static_cast<int>(meet(0, [&](std::size_t) { return ssize_t{::fsync(file)}; }));
    };
    const auto rename = [this](const char* from, const char* to) {
      if (calls_) note({Call::Kind::rename, from, "", 0, to});
      return static_cast<int>(meet(0, [&](std::size_t) { return ssize_t{::rename(from, to)}; }));
    };
    return {write, sync, sync, rename};
  }

 private:
  void note(Call call) { calls_->push_back(std::move(call)); }
  template <typename Do>
  ssize_t meet(std::size_t size, const Do& call) {
    if (++count_ != at_) return call(size);
    switch (fault_) {
      case Fault::kill_before:
        ::_exit(9);
      case Fault::kill_half:
        if (size > 0) call(size / 2);
        ::_exit(9);
      case Fault::kill_after:
        call(size);
        ::_exit(9);
      case Fault::short_write:
        return call(size > 1 ? size / 2 : size);
      case Fault::none:
        return call(size);
      default:
        errno = fault_ == Fault::no_space ? ENOSPC : fault_ == Fault::io ? EIO : EINTR;
        return -1;
    }
  }

  Fault fault_;
  int at_, count_ = 0;
  std::vector<Call>* calls_;
};

void put(std::string& bytes, std::size_t place, std::string_view part) {
  bytes.resize(std::max(bytes.size(), place + part.size()), '\0');
  bytes.replace(place, part.size(), part);
}

/// A disk of which only what was synced is certain. Of the rest each write may be there whole, up
/// to a sector's end, or not at all, and each new name or the old one.
class LostPower {
 public:
  explicit LostPower(navvi_types::Random& random) : random_(random) {}

  void take(const Call& call) {
    if (call.kind == Call::Kind::rename) {
      names_[call.to] = names_[call.path];
      names_.erase(call.path);
    } else if (call.kind == Call::Kind::write) {
      auto& file = names_[call.path];
      if (!file) file = std::make_shared<File>();
      put(file->now, call.place, call.bytes);
      file->pending.push_back(call);
    } else if (const auto file = names_.find(call.path); file != names_.end()) {
      file->second->synced = file->second->now;
      file->second->pending.clear();
    } else {
      const auto there = [&](const auto& name) { return name.first.parent_path() == call.path; };
      for (auto it = certain_.begin(); it != certain_.end();)
        it = there(*it) ? certain_.erase(it) : std::next(it);
      std::copy_if(names_.begin(), names_.end(), std::inserter(certain_, certain_.end()), there);
    }
  }
  /// Writes what is left of the folder `from` into `to`.
  void leave(const fs::path& from, const fs::path& to) {
    std::set<fs::path> all;
    for (const Names* names : {&names_, &certain_})
      for (const auto& [path, file] : *names) all.insert(path);
    for (const fs::path& path : all) {
      Names& names = random_.chance(0.5) ? names_ : certain_;
      const auto file = names.find(path);
      if (file == names.end()) continue;
      const fs::path copy = to / path.lexically_relative(from);
      fs::create_directories(copy.parent_path());
      std::ofstream(copy, std::ios::binary) << left_of(*file->second);
    }
  }

 private:
  struct File {
    std::string synced, now;
    std::vector<Call> pending;
  };
  using Names = std::map<fs::path, std::shared_ptr<File>>;

  std::string left_of(const File& file) {
    constexpr std::size_t kSector = 512;
    std::string bytes = file.synced;
    for (const Call& call : file.pending) {
      const std::size_t end = (call.place + call.bytes.size()) / kSector * kSector;
      const std::size_t whole = end > call.place ? end - call.place : 0;
      const double drawn = random_.uniform(0.0, 3.0);
      const std::size_t kept = drawn < 1.0 ? whole : call.bytes.size();
      if (drawn < 2.0) put(bytes, call.place, call.bytes.substr(0, kept));
    }
    return bytes;
  }

  navvi_types::Random& random_;
  Names names_, certain_;
};

class PowerLoss : public Trials {
 protected:
  /// A short trial that reaches its goal, in a folder of its own.
  void drive(const std::string& out, Disk& disk) {
    config_.out = (folder_ / out).string();
    calls_ = disk.calls();
    run();
    keeper_->take_goal({7.0, 1.0}, now());
    live(1.0, State::following, {7.0, 1.0});
    live(9.0, State::arrived, {7.0, 1.0});
    keeper_.reset();
  }
  /// In a process of its own. \return what it has published
  Lines drive_in_child(const std::string& out, Fault fault, int at) {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) return {};
    const pid_t child = ::fork();
    if (child == 0) {
      published_ = [&](const record::Row& row) {
        const std::string line = record::format_row(row);
        if (::write(pipe[1], line.data(), line.size()) < 0) ::_exit(1);
      };
      Disk disk(fault, at);
      drive(out, disk);
      ::_exit(0);
    }
    ::close(pipe[1]);
    Lines lines;
    FILE* from = ::fdopen(pipe[0], "r");
    std::array<char, 4096> line{};
    while (std::fgets(line.data(), line.size(), from)) lines.emplace_back(line.data());
    std::fclose(from);
    ::waitpid(child, nullptr, 0);
    return lines;
  }
  /// Changes a byte in the middle of the journal of a trial that has ended.
  void damage() const {
    const fs::path journal = fs::directory_iterator(folder_ / "cut")->path() / "journal.csv";
    std::string bytes = navvi_files::read_file(journal).value();
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(journal, std::ios::binary) << bytes;
  }
  /// Brings a folder of trials in order, as the next session does, and judges it.
  void judge(const fs::path& out, const Lines& published) {
    static_cast<void>(record::recover_trials(out));
    std::string journal;
    for (const auto& entry : fs::directory_iterator(out)) {
      const fs::path& trial = entry.path();
      if (!fs::exists(trial / "journal.csv")) continue;
      journal = navvi_files::read_file(trial / "journal.csv").value_or("");
      const record::JournalContents contents = record::read_journal(journal);
      EXPECT_EQ(contents.damage, "");
      const record::Trial kept = record::read_trial(trial);
      if (contents.rows.empty()) continue;
      const std::string summary = navvi_files::read_file(trial / "summary.csv").value_or("none");
      EXPECT_EQ(summary, record::summary_csv(record::summarize(kept))) << "as counted again";
      for (std::size_t i = 1; i < kept.track.size(); ++i)
        EXPECT_LT(kept.track[i].time, kept.track[i - 1].time + 0.06) << "no row is missing";
      EXPECT_NE(journal.find(",TRIAL_END,"), std::string::npos);
      const std::string result = record::cell_of(record::parse_summary(summary).value(), "result");
      const bool said = journal.find("result=reached") != std::string::npos;
      EXPECT_TRUE(result != "reached" || said) << journal;
    }
    for (const std::string& line : published) {
      const auto at = journal.find(line);
      EXPECT_NE(at, std::string::npos) << line;
      EXPECT_EQ(journal.find(line, at + 1), std::string::npos) << line;
    }
    EXPECT_EQ(record::recover_trials(out), Lines()) << "the second time";
  }
};

TEST_F(PowerLoss, L3_at_each_call_of_a_trial_its_disk_fails_or_it_is_killed) {
  Disk whole;
  drive("whole", whole);
  ASSERT_GT(whole.count(), 40);
  for (const Fault fault : kFaults) {
    for (int at = 1; at <= whole.count(); ++at) {
      SCOPED_TRACE("fault " + std::to_string(static_cast<int>(fault)) + " at call " +
                   std::to_string(at));
      const std::string out = "trial";
      judge(folder_ / out, drive_in_child(out, fault, at));
      if (HasFailure()) return;
      fs::remove_all(folder_ / out);
    }
  }
}

TEST_F(PowerLoss, L3_at_each_call_of_a_recovery_it_is_killed) {
  for (const int at : {12, 21, 34, 0}) {
    const Lines published = drive_in_child("cut", Fault::kill_half, at);
    if (at == 0) damage();
    for (int call = 1, last = 1; call <= last + 1; ++call) {
      SCOPED_TRACE("cut at " + std::to_string(at) + ", recovery at " + std::to_string(call));
      const fs::path out = folder_ / "again";
      fs::copy(folder_ / "cut", out, fs::copy_options::recursive);
      if (call == 1) {
        Disk whole;
        static_cast<void>(record::recover_trials(out, whole.calls()));
        last = whole.count();
        EXPECT_GT(last, 3);
      } else {
        const pid_t child = ::fork();
        Disk disk(Fault::kill_half, call - 1);
        if (child == 0) {
          static_cast<void>(record::recover_trials(out, disk.calls()));
          ::_exit(0);
        }
        ::waitpid(child, nullptr, 0);
      }
      judge(out, at == 0 ? Lines() : published);
      if (HasFailure()) return;
      fs::remove_all(out);
    }
    fs::remove_all(folder_ / "cut");
  }
}

TEST_F(PowerLoss, L3_leaves_every_event_that_was_published_as_lasting_and_figures_of_what_is_left) {
  std::vector<Call> calls;
  std::vector<std::pair<std::size_t, std::string>> lasting;
  published_ = [&](const record::Row& row) {
    if (calls.back().kind == Call::Kind::sync)
      lasting.emplace_back(calls.size(), record::format_row(row));
  };
  Disk whole(Fault::none, 0, &calls);
  drive("whole", whole);
  ASSERT_GT(lasting.size(), 4U);
  navvi_types::Random random(5);
  for (int i = 0; i < 400; ++i) {
    const auto end =
        static_cast<std::size_t>(random.uniform(1.0, static_cast<double>(calls.size() + 1)));
    SCOPED_TRACE("loss " + std::to_string(i) + " after call " + std::to_string(end));
    LostPower power(random);
    for (std::size_t at = 0; at < end; ++at) power.take(calls[at]);
    const fs::path out = folder_ / "left";
    fs::create_directories(out);
    power.leave(folder_ / "whole", out);
    Lines published;
    for (const auto& [at, line] : lasting)
      if (at <= end) published.push_back(line);
    judge(out, published);
    if (HasFailure()) return;
    fs::remove_all(out);
  }
}

TEST_F(PowerLoss, L3_a_world_that_was_kept_is_found_whole_or_not_at_all) {
  const std::string old(3000, 'a'), newer(2000, 'b');
  const auto cache = [](const fs::path& folder, const navvi_files::SystemCalls& calls) {
    return navvi_files::Cache({folder, 16, "one"}, calls);
  };
  const auto keep_both = [&](const fs::path& folder, Disk& disk) {
    for (const std::string& result : {old, newer}) cache(folder, disk.calls()).keep("hall", result);
  };
  const auto expect_whole = [&](const fs::path& folder) {
    const auto later = cache(folder, navvi_files::SystemCalls::real());
    const auto found = later.find("hall");
    EXPECT_TRUE(!found || *found == old || *found == newer);
    later.keep("hall", "newest");
    EXPECT_EQ(later.find("hall"), "newest");
    fs::remove_all(folder);
  };
  std::vector<Call> calls;
  Disk whole(Fault::none, 0, &calls);
  keep_both(folder_ / "whole", whole);
  ASSERT_EQ(whole.count(), 4);
  for (const Fault fault : kFaults) {
    for (int at = 1; at <= whole.count(); ++at) {
      SCOPED_TRACE("fault " + std::to_string(static_cast<int>(fault)) + " at " + std::to_string(at));
      const pid_t child = ::fork();
      if (child == 0) {
        Disk disk(fault, at);
        keep_both(folder_ / "kept", disk);
        ::_exit(0);
      }
      ::waitpid(child, nullptr, 0);
      expect_whole(folder_ / "kept");
    }
  }
  navvi_types::Random random(7);
  for (int i = 0; i < 200; ++i) {
    LostPower power(random);
    for (std::size_t at = 0; at <= static_cast<std::size_t>(i) % calls.size(); ++at)
      power.take(calls[at]);
    power.leave(folder_ / "whole", folder_ / "kept");
    expect_whole(folder_ / "kept");
  }
}

}  // namespace
}  // namespace navvi_study::trial
