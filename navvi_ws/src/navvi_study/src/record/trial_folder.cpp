#include "record/trial_folder.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "record/events.hpp"
#include "record/journal.hpp"

namespace navvi_study::record {
namespace fs = std::filesystem;

std::string calendar(std::int64_t utc_ns) {
  const std::time_t seconds = utc_ns / 1'000'000'000;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 40> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(text.data() + length, text.size() - length, ".%03dZ",
                static_cast<int>(utc_ns / 1'000'000 % 1000));
  return text.data();
}

fs::path create_trial_folder(const fs::path& out, std::time_t utc) {
  std::error_code error;
  fs::create_directories(out, error);
  if (error || !fs::is_directory(out))
    throw std::runtime_error("no trial: the folder " + out.string() + " cannot be made" +
                             (error ? ": " + error.message() : ""));
  std::tm calendar{};
  gmtime_r(&utc, &calendar);
  std::array<char, 40> name{};
  std::strftime(name.data(), name.size(), "trial-%Y%m%dT%H%M%SZ", &calendar);
  for (int i = 1; i < 1000; ++i) {
    const fs::path folder = out / (name.data() + (i == 1 ? "" : "-" + std::to_string(i)));
    const bool made = fs::create_directory(folder, error);
    if (error)
      throw std::runtime_error("no trial: nothing can be written into " + out.string() + ": " +
                               error.message());
    if (made) return folder;
  }
  throw std::runtime_error("no trial: 999 trials of this second are in " + out.string());
}

Trial read_trial(const fs::path& folder) {
  Trial trial;
  if (const auto bytes = navvi_files::read_file(folder / "journal.csv"))
    trial.rows = read_journal(*bytes).rows;
  trial.track = read_track(folder);
  return trial;
}

navvi_files::Problem write_results(const fs::path& folder, const Trial& trial,
                                    const navvi_files::SystemCalls& calls) {
  if (const auto problem =
          navvi_files::write_atomically(folder / "events.csv", events_csv(trial), calls)) {
    return problem;
  }
  return navvi_files::write_atomically(folder / "summary.csv", summary_csv(summarize(trial)),
                                        calls);
}

namespace {

/// Whether the summary is whole, and has the result of the trial and the state of its bag.
bool is_summed_up(const fs::path& folder, const Trial& trial) {
  const auto summary = parse_summary(navvi_files::read_file(folder / "summary.csv").value_or(""));
  const auto has = [&](const std::string& type, const std::string& field, const char* column) {
    const Row* row = trial.last(type);
    const std::string cell = cell_of(*summary, column);
    return row == nullptr || cell.empty() || cell == "invalid" || cell == row->fields.get(field);
  };
  return summary && has("TRIAL_END", "result", "result") && has("BAG_CLOSED", "state", "bag");
}

}  // namespace

std::vector<std::string> recover_trials(const fs::path& out,
                                        const navvi_files::SystemCalls& calls) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator it(out, error), end; !error && it != end; it.increment(error)) {
    if (it->is_directory(error) && !it->is_symlink(error) &&
        fs::is_regular_file(it->path() / "journal.csv", error)) {
      folders.push_back(it->path());
    }
  }
  std::sort(folders.begin(), folders.end());
  std::vector<std::string> sentences;
  for (const auto& folder : folders) {
    const Recovery recovery = recover(folder, calls);
    if (recovery.in_use) continue;
    std::string said = recovery.problem.empty() ? recovery.report : recovery.problem;
    if (recovery.problem.empty() && !recovery.rows.empty() &&
        (recovery.changed || !is_summed_up(folder, {recovery.rows}))) {
      if (const auto problem = write_results(folder, {recovery.rows, read_track(folder)}, calls))
        said += *problem;
      if (said.empty()) said = "Its summary lacked the journal's last rows and has them now.";
    }
    if (!said.empty()) sentences.push_back(folder.filename().string() + ": " + said);
  }
  return sentences;
}

}  // namespace navvi_study::record
