#pragma once

#include <filesystem>
#include <navvi_files/files.hpp>
#include <string>
#include <vector>

#include "record/row.hpp"

namespace navvi_study::record {

/// The one record of a trial: rows are only ever appended, each by one write. After the first error
/// it takes nothing more, because what the disk then holds is unknown.
class Journal {
 public:
  static constexpr std::uint64_t kMinFree = 50u << 20;  ///< bytes
  static constexpr std::uint64_t kPage = 4096;          ///< bytes, that a file grows by

  /// Creates `folder`/journal.csv, which must not exist, a reserve of 1 MiB beside it for the day
  /// the disk is full, and locks the journal against recovery by another process. \throws
  /// std::runtime_error with a sentence if that cannot be done, or less than `min_free` bytes are
  /// free
  Journal(const std::filesystem::path& folder, const std::string& trial,
          std::uint64_t min_free = kMinFree,
          navvi_files::SystemCalls calls = navvi_files::SystemCalls::real());
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// \param essential  it is on the disk on return; else it is written, but not waited for
  /// \return the row as written, or nullopt if it is not certainly on the disk; the journal is then
  /// broken for good
  [[nodiscard]] std::optional<Row> append(const std::string& type, const Fields& fields,
                                          std::int64_t sim_ns, std::int64_t mono_ns,
                                          bool essential);

  /// A sentence, empty while all is well.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] bool broken() const { return !problem_.empty(); }
  /// The reserve has been given up, or less than `least` bytes are free: end the trial.
  [[nodiscard]] bool full(std::uint64_t least = kPage) const;
  /// Frees the reserve for all that is still to be written.
  void give_up_reserve();
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

 private:
  [[nodiscard]] int write(std::string_view line);

  std::filesystem::path folder_;
  std::string trial_;
  navvi_files::SystemCalls calls_;
  int file_ = -1;
  bool reserve_used_ = false;
  std::string problem_;
  std::vector<Row> rows_;
};

/// What a journal's bytes hold.
struct JournalContents {
  std::vector<Row> rows;  ///< up to the first damage
  std::size_t good_bytes = 0;
  std::string damage;  ///< a sentence; empty if every byte is in order
  bool torn = false;   ///< the damage is no more than an unfinished last row
};

[[nodiscard]] JournalContents read_journal(std::string_view bytes);

struct Recovery {
  bool changed = false;
  bool in_use = false;  ///< a running trial holds it: untouched
  std::string report;   ///< sentences, for a person
  std::vector<Row> rows;
  std::string problem;  ///< empty, or why it could not be done
};

/// Puts a trial's folder in order after a crash: bytes after the last good row are set aside in
/// journal.torn*, an open trial is closed by TRIAL_END with result aborted (invalid where its
/// summary says so, or more than a torn last row was damaged). Nothing is deleted. Running it again
/// changes nothing.
[[nodiscard]] Recovery recover(
    const std::filesystem::path& folder,
    const navvi_files::SystemCalls& calls = navvi_files::SystemCalls::real());

}  // namespace navvi_study::record
