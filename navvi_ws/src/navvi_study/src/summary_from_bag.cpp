// summary_from_bag TRIAL_FOLDER: recounts a trial from its bag and compares with summary.csv.
// Exit 0: equal. 1: differs. 2: cannot be told.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <string>

#include "navvi_study/files.hpp"
#include "navvi_study/metrics.hpp"
#include "navvi_study/recount.hpp"

namespace {

namespace study = navvi_study;

/// The child's part: rosbag's reader may crash on a damaged file, and then only the child is gone.
int recount_into(int pipe, const std::filesystem::path& bag) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::string answer;
  int code = 0;
  try {
    answer = study::summary_csv(study::summarize(study::rows_from_bag(bag)));
  } catch (const std::exception& error) {
    answer = error.what();
    code = 2;
  }
  std::string_view rest = answer;
  return study::write_all(pipe, rest, study::SystemCalls::real()) == 0 ? code : 2;
}

struct Answer {
  bool good = false;
  std::string text;
};

Answer ask_child(const std::filesystem::path& bag) {
  int ends[2];
  if (::pipe(ends) != 0) return {false, "no pipe can be opened"};
  const pid_t child = ::fork();
  if (child < 0) return {false, "no process can be started"};
  if (child == 0) {
    ::close(ends[0]);
    ::_exit(recount_into(ends[1], bag));
  }
  ::close(ends[1]);
  Answer answer;
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(ends[0], buffer, sizeof buffer)) > 0;) {
    answer.text.append(buffer, static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  answer.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!WIFEXITED(status)) answer.text = "the bag is damaged: its reader crashed";
  return answer;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: summary_from_bag TRIAL_FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const auto text = study::read_file(folder / "summary.csv");
  const auto summary = text ? study::parse_summary(*text) : std::nullopt;
  if (!summary) {
    std::fprintf(stderr, "There is no summary.csv in order in %s.\n", folder.c_str());
    return 2;
  }
  if (!std::filesystem::exists(folder / "trial.bag")) {
    std::fprintf(stderr, "There is no closed trial.bag in %s.\n", folder.c_str());
    return 2;
  }
  const Answer answer = ask_child(folder / "trial.bag");
  const auto recount = answer.good ? study::parse_summary(answer.text) : std::nullopt;
  if (!recount) {
    std::fprintf(stderr, "Nothing can be recounted from the bag: %s.\n", answer.text.c_str());
    return 2;
  }
  const auto sentences = study::differences(*summary, *recount);
  for (const auto& sentence : sentences) std::printf("%s\n", sentence.c_str());
  if (sentences.empty()) std::printf("equal\n");
  return sentences.empty() ? 0 : 1;
}
