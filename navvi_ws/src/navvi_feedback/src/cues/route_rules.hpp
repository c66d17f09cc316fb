#pragma once

#include <initializer_list>
#include <optional>

#include "cues/bearing.hpp"
#include "cues/cue_config.hpp"
#include "cues/leg.hpp"
#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// One look at a way that leads on: its guidance is fresh, and the hour to where to steer is known.
struct Look {
  const RouteConfig& config;
  const Observation& now;
  const Bearing& bearing;
  double time;  ///< s, monotonic

  [[nodiscard]] const Guidance& guidance() const { return *now.guidance; }
  [[nodiscard]] int hour() const { return *bearing.hour(); }
  [[nodiscard]] bool by_sound() const { return now.lead != Lead::words; }
};

/// What a rule decides: nothing, so that the next one is asked; or what is said, be it nothing.
using Told = std::optional<Utterances>;
/// Tells one thing about the way, and the leg that it was told.
using Rule = Told (*)(const Look& look, Leg& leg);

/// The first decision counts.
[[nodiscard]] Utterances first_of(std::initializer_list<Rule> rules, const Look& look, Leg& leg);

// The strategies. Each returns what is said now; the leg knows of it.

/// Where words alone lead: whatever changes where to steer is said, and said again until it is
/// done. While the robot turns nothing is said but "straight ahead", early enough to stop a turn of
/// more than one hour by.
[[nodiscard]] Utterances words_lead(const Look& look, Leg& leg);
/// Where a sound leads to where to steer: words are for what it cannot tell. Each leg once, turns
/// of more than one hour, another route, and driving astray.
[[nodiscard]] Utterances sounds_lead(const Look& look, Leg& leg);
/// Where a display leads that lasts: words are for what is behind a change of the way.
[[nodiscard]] Utterances words_beside(const Look& look, Leg& leg);

// The rules that both strategies follow.

/// Something waits for the robot to make room.
[[nodiscard]] Told make_room(const Look& look, Leg& leg);
/// No more is said while the voice speaks.
[[nodiscard]] Told listen(const Look& look, Leg& leg);
[[nodiscard]] Told cancel_turn(const Look& look, Leg& leg);
[[nodiscard]] Told announce_turn(const Look& look, Leg& leg);

/// A person who was told to go straight stands.
[[nodiscard]] Told urge(const Look& look, Leg& leg);

// Parts of rules.

/// The direction, and the other route where that is news; or the turn that soon follows.
[[nodiscard]] Utterances tell_way(const Look& look, Leg& leg);
/// The corner is reached, and a turn soon after it is told with it.
[[nodiscard]] Utterances turn_now(const Look& look, Leg& leg);
/// It is told with the direction, at any time.
[[nodiscard]] Utterance make_room_now(const Look& look, Leg& leg);
/// The turn is announced by these words. \param hour  of the turn
[[nodiscard]] Utterance announce(const Content& what, Utterance way, int hour, const Look& look,
                                 Leg& leg);
/// Another route is news, and something blocks the old one.
[[nodiscard]] bool is_blocked(const Look& look, const Leg& leg);
/// Makes of the direction that of another route.
void reroute(Utterance& way, const Look& look, const Leg& leg);
/// Whether to say the direction, where both strategies agree; nullopt: they do not.
[[nodiscard]] std::optional<bool> direction_due(const Look& look, const Leg& leg);
/// The hour of the turn at the next corner, if it is near enough to be announced.
[[nodiscard]] std::optional<int> turn_within_reach(const Look& look);
/// A bend that a sound leads round needs no words. \param hour  of a turn
[[nodiscard]] bool worth_words(const Look& look, int hour);
/// A person who has just heard of what is ahead is not told to drive at it.
[[nodiscard]] bool hushed(const Look& look, const Leg& leg);

}  // namespace navvi_feedback::cues
