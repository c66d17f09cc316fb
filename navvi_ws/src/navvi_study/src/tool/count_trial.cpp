// count_trial journal|bag TRIAL_FOLDER: counts a trial again, from its journal and track or from
// its bag, and compares with summary.csv. Exit 0: equal. 1: differs. 2: cannot be compared.
// count_trial figures: prints name, unit, meaning and source of each figure, as JSON.

#include <ros/package.h>

#include <cstdio>
#include <cstring>
#include <navvi_files/child_process.hpp>
#include <navvi_files/json.hpp>
#include <stdexcept>
#include <string>

#include "record/journal.hpp"
#include "record/trial_folder.hpp"
#include "recount/recount.hpp"

namespace {

namespace study = navvi_study;
namespace fs = std::filesystem;

/// A line of how many messages the bag lacks, then the summary.
/// \throws std::runtime_error with a sentence
std::string recount(const fs::path& folder, bool from_bag) {
  study::recount::Recounted found;
  if (from_bag) {
    if (!fs::exists(folder / "trial.bag"))
      throw std::runtime_error("there is no closed trial.bag in " + folder.string());
    found = study::recount::trial_from_bag(
        folder / "trial.bag", ros::package::getPath("navvi_feedback") + "/config/phrases");
  } else {
    const auto bytes = navvi_files::read_file(folder / "journal.csv");
    if (!bytes) throw std::runtime_error("there is no journal.csv in " + folder.string());
    if (const auto damage = study::record::read_journal(*bytes).damage; !damage.empty())
      throw std::runtime_error("the journal is not whole: " + damage);
    found.trial = study::record::read_trial(folder);
  }
  return std::to_string(found.lost) + "\n" +
         study::record::summary_csv(study::record::summarize(found.trial));
}

void print_figures() {
  using navvi_files::json_text;
  std::vector<std::string> all;
  for (const study::record::Figure& figure : study::record::figures())
    all.push_back(navvi_files::json_object({{"name", json_text(figure.name)},
                                            {"unit", json_text(figure.unit)},
                                            {"meaning", json_text(figure.meaning)},
                                            {"source", json_text(figure.source)}}));
  std::printf("%s\n", navvi_files::json_list(all).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "figures") == 0) {
    print_figures();
    return 0;
  }
  const bool from_bag = argc == 3 && std::strcmp(argv[1], "bag") == 0;
  if (!from_bag && (argc != 3 || std::strcmp(argv[1], "journal") != 0)) {
    std::fprintf(stderr, "usage: count_trial journal|bag TRIAL_FOLDER, or count_trial figures\n");
    return 2;
  }
  const fs::path folder = argv[2];
  const auto summary =
      study::record::parse_summary(navvi_files::read_file(folder / "summary.csv").value_or(""));
  if (!summary) {
    std::fprintf(stderr, "There is no summary.csv in order in %s.\n", folder.c_str());
    return 2;
  }
  const navvi_files::Answer answer = navvi_files::run_in_child(
      [&] { return recount(folder, from_bag); }, "the bag is damaged: its reader crashed");
  const auto line = std::min(answer.text.find('\n'), answer.text.size() - 1);
  const auto recounted =
      answer.good ? study::record::parse_summary(answer.text.substr(line + 1)) : std::nullopt;
  if (!recounted) {
    std::fprintf(stderr, "Nothing can be counted again from the %s: %s.\n", argv[1],
                 answer.text.c_str());
    return 2;
  }
  auto sentences = study::record::differences(*summary, *recounted);
  if (!sentences.empty() && answer.text[0] != '0')
    sentences.push_back("the bag lacks " + answer.text.substr(0, line) +
                        " messages of odometry: its recorder was not in time");
  for (const auto& sentence : sentences) std::printf("%s\n", sentence.c_str());
  if (sentences.empty()) std::printf("The %s and the summary are equal.\n", argv[1]);
  return sentences.empty() ? 0 : 1;
}
