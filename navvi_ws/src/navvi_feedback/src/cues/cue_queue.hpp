#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "cues/cue.hpp"
#include "navvi_feedback/cues/voice_order.hpp"

namespace navvi_feedback::cues {

/// Decides when each cue is spoken (R-AUD-6). A higher priority cuts a lower one; an equal or lower
/// one waits; nothing cuts an important one, a word to stop cuts all others, and what was asked for
/// does, too, and takes the place of what was asked for before. Below `important` at most two wait;
/// the least important is dropped first, but not what ends a wait. A newer cue of a content
/// replaces the waiting one, but an important one only if the text is the same, and what ends a
/// wait only if it does so, too. A word to stop drops all that waits to say where to steer, and so
/// does what ends a wait if it is not heard to its end. A cue that has waited beyond max_age is
/// dropped. Every cue that enters reaches exactly one of ended, cut, dropped.
class CueQueue {
 public:
  /// The order to the voice, and the events of the cues in order.
  struct Step : VoiceOrder {
    std::vector<CueEvent> events;
  };

  /// \param fresh         cues that were decided since the last call
  /// \param speaker_busy  the speaker still speaks the last text that it started
  /// \param time          s, of a clock that does not run backwards
  [[nodiscard]] Step update(const std::vector<Cue>& fresh, bool speaker_busy, double time);

  /// Ends all: the running cue is cut, the waiting ones are dropped.
  [[nodiscard]] Step clear();

  [[nodiscard]] bool empty() const { return !running_ && waiting_.empty(); }

 private:
  struct Entry {
    std::uint32_t id = 0;
    double since = 0.0;
    Cue cue;
  };

  void enter(const Cue& cue, double time, Step& step);
  template <typename Which>
  void drop(const Which& which, Step& step);
  void drop_ways(Step& step);
  void drop_stale(double time, Step& step);
  void drop_surplus(Step& step);
  void begin_next(Step& step);

  std::uint32_t last_id_ = 0;
  std::optional<Entry> running_;
  std::deque<Entry> waiting_;  ///< most important first, then oldest first
};

/// Keeps out of the record what nobody can have heard.
class HeardWords {
 public:
  /// \param hears  words that begin now reach somebody \param heard  so did the last, to their end
  /// \return the events; words that start unheard are dropped instead, and say no more, and those
  /// that end unheard are cut
  [[nodiscard]] std::vector<CueEvent> of(std::vector<CueEvent> events, bool hears, bool heard);

 private:
  std::optional<std::uint32_t> unheard_;  ///< the words that are timed without a device
};

}  // namespace navvi_feedback::cues
