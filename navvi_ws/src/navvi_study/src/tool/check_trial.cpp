// check_trial TRIAL_FOLDER: steps the recorded world with the recorded commands and compares its
// state each second. Exit 0: equal. 1: differs. 2: cannot be compared.

#include <cstdio>
#include <filesystem>
#include <navvi_files/child_process.hpp>
#include <navvi_files/files.hpp>
#include <navvi_types/scenario.hpp>
#include <string>

#include "record/figures.hpp"
#include "recount/repetition.hpp"
#include "trial/conditions.hpp"

namespace {

namespace study = navvi_study;

/// A sentence if the last state in the summary is not one of those in the bag.
std::string summary_differs(const study::record::Summary& summary,
                            const study::recount::RecordedSession& session) {
  using study::record::cell_of;
  const std::string step = cell_of(summary, "state_step"), hash = cell_of(summary, "state_hash");
  if (cell_of(summary, "world_hash") != session.world_hash)
    return "The world in the summary is not the one in the bag.";
  for (const auto& state : session.states) {
    if (std::to_string(state.step) == step && navvi_types::to_hex(state.hash) == hash) return "";
  }
  return "The summary's last state, " + hash + " after step " + step + ", is not in the bag.";
}

std::string check(const std::filesystem::path& folder, const study::record::Summary& summary) {
  const study::recount::RecordedSession session =
      study::recount::session_in_bag(folder / "trial.bag");
  const std::string difference = study::recount::first_difference(session);
  if (!difference.empty()) return difference;
  const std::string in_summary = summary_differs(summary, session);
  if (!in_summary.empty()) return in_summary;
  return "equal: " + std::to_string(session.states.size()) + " states, up to step " +
         std::to_string(session.states.back().step) + ", " +
         std::to_string(session.commands.size()) + " commands";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: check_trial TRIAL_FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const auto summary =
      study::record::parse_summary(navvi_files::read_file(folder / "summary.csv").value_or(""));
  if (!summary || !std::filesystem::exists(folder / "trial.bag")) {
    std::fprintf(stderr, "%s lacks a %s.\n", folder.c_str(),
                 summary ? "closed trial.bag" : "summary.csv in order");
    return 2;
  }
  const navvi_files::Answer answer = navvi_files::run_in_child(
      [&] { return check(folder, *summary); }, "the bag is damaged: its reader crashed");
  if (!answer.good) {
    std::fprintf(stderr, "This trial cannot be repeated: %s.\n", answer.text.c_str());
    return 2;
  }
  const bool equal = answer.text.rfind("equal", 0) == 0;
  for (const auto& [name, here] : study::trial::computer())
    if (const auto there = study::record::cell_of(*summary, name);
        !equal && !there.empty() && there != here)
      std::printf("It was recorded with another %s: %s; here it is %s.\n", name.c_str(),
                  there.c_str(), here.c_str());
  std::printf("%s\n", answer.text.c_str());
  return equal ? 0 : 1;
}
