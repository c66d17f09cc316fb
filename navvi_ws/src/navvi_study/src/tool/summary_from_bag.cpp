// summary_from_bag TRIAL_FOLDER: recounts a trial from its bag and compares with summary.csv.
// Exit 0: equal. 1: differs. 2: cannot be compared.

#include <cstdio>
#include <navvi_files/files.hpp>
#include <string>

#include "record/child_process.hpp"
#include "record/metrics.hpp"
#include "recount/recount.hpp"

namespace {

namespace study = navvi_study;

std::string recount(const std::filesystem::path& bag) {
  return study::record::summary_csv(study::record::summarize(study::recount::rows_from_bag(bag)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: summary_from_bag TRIAL_FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const auto text = navvi_files::read_file(folder / "summary.csv");
  const auto summary = text ? study::record::parse_summary(*text) : std::nullopt;
  if (!summary) {
    std::fprintf(stderr, "summary.csv is missing or damaged in %s.\n", folder.c_str());
    return 2;
  }
  if (!std::filesystem::exists(folder / "trial.bag")) {
    std::fprintf(stderr, "A closed trial.bag is missing in %s.\n", folder.c_str());
    return 2;
  }
  const study::record::Answer answer = study::record::run_in_child(
      [&] { return recount(folder / "trial.bag"); }, study::record::kBagCrashed);
  const auto recounted = answer.good ? study::record::parse_summary(answer.text) : std::nullopt;
  if (!recounted) {
    std::fprintf(stderr, "Nothing can be recounted from the bag: %s.\n", answer.text.c_str());
    return 2;
  }
  const auto sentences = study::record::differences(*summary, *recounted);
  for (const auto& sentence : sentences) std::printf("%s\n", sentence.c_str());
  if (sentences.empty()) std::printf("The bag and the summary are equal.\n");
  return sentences.empty() ? 0 : 1;
}
