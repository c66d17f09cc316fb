// summary_from_journal TRIAL_FOLDER: recounts a trial from its journal and compares with
// summary.csv. Exit 0: equal. 1: differs. 2: cannot be compared.

#include <cstdio>
#include <navvi_files/files.hpp>

#include "record/journal.hpp"
#include "record/metrics.hpp"

int main(int argc, char** argv) {
  namespace study = navvi_study;
  if (argc != 2) {
    std::fprintf(stderr, "usage: summary_from_journal TRIAL_FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const auto bytes = navvi_files::read_file(folder / "journal.csv");
  if (!bytes) {
    std::fprintf(stderr, "journal.csv is missing in %s.\n", folder.c_str());
    return 2;
  }
  const auto contents = study::record::read_journal(*bytes);
  if (!contents.damage.empty()) {
    std::fprintf(stderr, "The journal is not whole: %s.\n", contents.damage.c_str());
    return 2;
  }
  const auto recount = study::record::summarize(contents.rows);
  std::printf("%s", study::record::summary_csv(recount).c_str());
  const auto text = navvi_files::read_file(folder / "summary.csv");
  const auto summary = text ? study::record::parse_summary(*text) : std::nullopt;
  if (!summary) {
    std::fprintf(stderr, "summary.csv is missing or damaged in %s.\n", folder.c_str());
    return 2;
  }
  const auto sentences = study::record::differences(*summary, recount);
  for (const auto& sentence : sentences) std::printf("%s\n", sentence.c_str());
  if (sentences.empty()) std::printf("equal\n");
  return sentences.empty() ? 0 : 1;
}
