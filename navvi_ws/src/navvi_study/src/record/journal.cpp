#include "record/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

#include "record/figures.hpp"

namespace navvi_study::record {
namespace fs = std::filesystem;
namespace {

constexpr off_t kReserve = 1 << 20;

fs::path journal_in(const fs::path& folder) { return folder / "journal.csv"; }
fs::path reserve_in(const fs::path& folder) { return folder / "journal.reserve"; }

/// errno, or 0
int make_reserve(const fs::path& folder) {
  const int file =
      ::open(reserve_in(folder).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0) return errno;
  const int error = ::posix_fallocate(file, 0, kReserve);
  ::close(file);
  return error;
}

/// The place of the torn bytes that were set aside as the `i`-th. \param i  from 1
fs::path torn_in(const fs::path& folder, int i) {
  return folder / (i == 1 ? "journal.torn" : "journal.torn." + std::to_string(i));
}

/// A place for torn bytes that overwrites none but the same bytes.
fs::path place_for(const fs::path& folder, const std::string& bytes) {
  for (int i = 1;; ++i) {
    const auto there = navvi_files::read_file(torn_in(folder, i));
    if (!fs::exists(torn_in(folder, i)) || (there && *there == bytes)) return torn_in(folder, i);
  }
}

/// True if bytes set aside, now or before an earlier recovery was cut short, were more than one
/// unfinished row.
bool rows_were_lost(const fs::path& folder) {
  for (int i = 1;; ++i) {
    const auto bytes = navvi_files::read_file(torn_in(folder, i));
    if (!bytes) return false;
    if (bytes->find('\n') != std::string::npos) return true;
  }
}

/// An open file, closed at the end of its life; -1 if it could not be opened.
struct OpenFile {
  explicit OpenFile(int descriptor) : descriptor(descriptor) {}
  ~OpenFile() {
    if (descriptor >= 0) ::close(descriptor);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  const int descriptor;
};

/// Appends to what a crash left; `contents` has been read from `file`.
navvi_files::Problem mend(const fs::path& folder, int file, const std::string& bytes,
                          JournalContents& contents, Recovery& recovery,
                          const navvi_files::SystemCalls& calls) {
  if (!contents.damage.empty()) {
    const std::string tail = bytes.substr(contents.good_bytes);
    const fs::path aside = place_for(folder, tail);
    if (const auto problem = navvi_files::write_atomically(aside, tail, calls)) return problem;
    if (::ftruncate(file, static_cast<off_t>(contents.good_bytes)) != 0 || calls.fsync(file) != 0)
      return navvi_files::failure("shorten the journal", errno);
    recovery.changed = true;
    recovery.report +=
        contents.damage + "; the bytes from there on are in " + aside.filename().string() + ". ";
  }
  std::string lines;
  if (contents.good_bytes == 0) lines = std::string(kJournalHeader) + "\n";
  bool open = false;
  for (const auto& row : contents.rows) {
    if (row.type == "TRIAL_START") open = true;
    if (row.type == "TRIAL_END") open = false;
  }
  const bool damaged = rows_were_lost(folder);
  const bool said = !contents.rows.empty() && contents.rows.back().type == "TRIAL_END" &&
                    contents.rows.back().fields.get("reason") == "journal_damaged";
  if (open || (damaged && !said && !contents.rows.empty())) {
    const Row& last = contents.rows.back();
    // What the trial's own end could not write into its journal.
    const Summary told = parse_summary(navvi_files::read_file(folder / "summary.csv").value_or(""))
                             .value_or(Summary());
    const bool invalid = damaged || cell_of(told, "result") == "invalid";
    Fields fields;
    fields.set("result", invalid ? "invalid" : "aborted")
        .set("reason", damaged   ? "journal_damaged"
                       : invalid ? cell_of(told, "reason")
                                 : "ended_without_a_word");
    const Row end{last.trial, last.seq + 1, last.sim_ns, last.mono_ns, "TRIAL_END", fields};
    lines += format_row(end);
    contents.rows.push_back(end);
    recovery.report += "An open trial was closed as " + fields.get("result") + ". ";
  }
  if (lines.empty()) return std::nullopt;
  recovery.changed = true;
  std::string_view rest = lines;
  int error = navvi_files::write_all(file, rest, calls);
  if (error == 0 && calls.fsync(file) != 0) error = errno;
  if (error != 0) return navvi_files::failure("close the journal", error);
  return std::nullopt;
}

}  // namespace

Journal::Journal(const fs::path& folder, const std::string& trial, std::uint64_t min_free,
                 navvi_files::SystemCalls calls)
    : folder_(folder), trial_(trial), calls_(std::move(calls)) {
  std::error_code error;
  const auto space = fs::space(folder, error);
  if (error) throw std::runtime_error("no trial: the folder " + folder.string() + " is not there");
  if (space.available < min_free)
    throw std::runtime_error("no trial: less than " + std::to_string(min_free >> 20) +
                             " MB are free in " + folder.string());
  file_ = ::open(journal_in(folder).c_str(),
                 O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (file_ < 0)
    throw std::runtime_error("no trial: " + navvi_files::failure("create a journal", errno));
  int failed = ::flock(file_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  if (failed == 0) failed = make_reserve(folder);
  std::string header = std::string(kJournalHeader) + "\n";
  std::string_view rest = header;
  if (failed == 0) failed = navvi_files::write_all(file_, rest, calls_);
  if (failed == 0 && calls_.fdatasync(file_) != 0) failed = errno;
  navvi_files::Problem problem;
  if (failed != 0) problem = navvi_files::failure("write the journal", failed);
  if (!problem) problem = navvi_files::sync_folder(folder, calls_);
  if (!problem) problem = navvi_files::sync_folder(folder / "..", calls_);
  if (problem) {
    ::close(file_);
    throw std::runtime_error("no trial: " + *problem);
  }
}

Journal::~Journal() {
  ::close(file_);
  ::unlink(reserve_in(folder_).c_str());
}

bool Journal::full(std::uint64_t least) const {
  std::error_code error;
  return reserve_used_ || fs::space(folder_, error).available < least;
}

void Journal::give_up_reserve() {
  reserve_used_ = true;
  ::unlink(reserve_in(folder_).c_str());
}

int Journal::write(std::string_view line) {
  int error = navvi_files::write_all(file_, line, calls_);
  if (error == ENOSPC && !reserve_used_) {
    give_up_reserve();
    error = navvi_files::write_all(file_, line, calls_);
  }
  return error;
}

std::optional<Row> Journal::append(const std::string& type, const Fields& fields,
                                   std::int64_t sim_ns, std::int64_t mono_ns, bool essential) {
  if (broken()) return std::nullopt;
  Row row{trial_, static_cast<std::uint32_t>(rows_.size() + 1), sim_ns, mono_ns, type, fields};
  const off_t before = ::lseek(file_, 0, SEEK_END);
  int error = write(format_row(row));
  // A failed sync may have thrown the bytes away: asking again would say yes to nothing.
  if (error == 0 && essential && calls_.fdatasync(file_) != 0) error = errno;
  if (error != 0) {
    problem_ = navvi_files::failure("write the journal", error);
    // A row that may not last is not to be read as one that does.
    if (::ftruncate(file_, before) != 0) problem_ += ", nor shorten it";
    return std::nullopt;
  }
  rows_.push_back(row);
  return row;
}

JournalContents read_journal(std::string_view bytes) {
  JournalContents contents;
  const std::string header = std::string(kJournalHeader) + "\n";
  if (bytes.substr(0, header.size()) != header) {
    contents.torn = bytes == std::string_view(header).substr(0, bytes.size());
    contents.damage = contents.torn ? "the journal ends within its first line"
                                    : "the journal's first line is not that of a journal";
    return contents;
  }
  contents.good_bytes = header.size();
  while (contents.good_bytes < bytes.size()) {
    const std::string_view rest = bytes.substr(contents.good_bytes);
    const auto end = rest.find('\n');
    const auto row = end == rest.npos ? std::nullopt : parse_row(rest.substr(0, end));
    const bool follows = row && row->seq == contents.rows.size() + 1 &&
                         (contents.rows.empty() || row->trial == contents.rows.front().trial);
    if (!follows) {
      contents.torn = end == rest.npos;
      contents.damage =
          (contents.torn ? "the journal ends within row " : "the journal is damaged at row ") +
          std::to_string(contents.rows.size() + 1);
      return contents;
    }
    contents.rows.push_back(*row);
    contents.good_bytes += end + 1;
  }
  return contents;
}

Recovery recover(const fs::path& folder, const navvi_files::SystemCalls& calls) {
  Recovery recovery;
  const OpenFile file(
      ::open(journal_in(folder).c_str(), O_RDWR | O_APPEND | O_CLOEXEC | O_NOFOLLOW));
  if (file.descriptor < 0) {
    recovery.problem = navvi_files::failure("open the journal in " + folder.string(), errno);
    return recovery;
  }
  if (::flock(file.descriptor, LOCK_EX | LOCK_NB) != 0) {
    recovery.in_use = true;
    return recovery;
  }
  const auto bytes = navvi_files::read_file(journal_in(folder));
  if (!bytes) {
    recovery.problem = "cannot read the journal in " + folder.string();
    return recovery;
  }
  JournalContents contents = read_journal(*bytes);
  const auto problem = mend(folder, file.descriptor, *bytes, contents, recovery, calls);
  if (problem) recovery.problem = *problem;
  recovery.rows = contents.rows;
  ::unlink(reserve_in(folder).c_str());
  return recovery;
}

}  // namespace navvi_study::record
