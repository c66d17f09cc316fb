// close_trials FOLDER: closes, as aborted, each trial in the folder whose trial_node ended without
// a word, and writes the results that are missing. Trials that are in order or still running stay
// as they are. Exit 0; 2 if there is no folder.

#include <sys/stat.h>

#include <cstdio>

#include "record/trial_folder.hpp"

int main(int argc, char** argv) {
  ::umask(S_IRWXG | S_IRWXO);  // a record is its owner's alone
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    std::fprintf(stderr, "close_trials: one argument is allowed, a folder that holds trials.\n");
    return 2;
  }
  for (const auto& sentence : navvi_study::record::recover_trials(argv[1]))
    std::printf("%s\n", sentence.c_str());
  return 0;
}
