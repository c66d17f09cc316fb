#pragma once

#include <map>
#include <navvi_types/cue_event.hpp>
#include <optional>
#include <string>

#include "record/row.hpp"

namespace navvi_study::batch {

/// Judges how much is said in a trial, and how well it can be obeyed.
class SpeechFigures {
 public:
  /// \param asked  the person has asked for it
  void hear(const navvi_types::CueEvent& cue, bool asked, double time);

  /// Adds, over `duration` s: `cues` and `words` a minute; `talk`, the share of the time in which
  /// something is said; `repeats`, how often a sentence was said again within 10 s without being
  /// asked for; `waits`, unasked words to stop, and, of them, `hasty`: those followed by another
  /// sentence within 2 s, before a person has obeyed; `at_odds`, how often "straight ahead" and
  /// that something is ahead were said within 2 s.
  void add_to(record::Fields& row, double duration) const;

 private:
  int cues_ = 0;
  int words_ = 0;
  int repeats_ = 0;
  int waits_ = 0;
  int hasty_ = 0;
  int at_odds_ = 0;
  double talk_ = 0.0;                        ///< s
  std::optional<double> speaks_since_;       ///< s
  std::optional<double> waited_;             ///< s, when the last cue was to wait or to stop
  std::optional<double> straight_;           ///< s, when straight ahead was said
  std::optional<double> ahead_;              ///< s, when something was said to be ahead
  std::map<std::string, double> last_said_;  ///< s, by text
};

}  // namespace navvi_study::batch
