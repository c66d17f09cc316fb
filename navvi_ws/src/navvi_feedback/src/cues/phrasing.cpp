#include "cues/phrasing.hpp"

#include <algorithm>
#include <set>

#include "cues/near_words.hpp"

namespace navvi_feedback::cues {
namespace {

/// Its words are a reminder: each of the others is for something that has just happened, be it the
/// same thing that is hit or waited for once more.
bool tells_nothing_new(const Utterance& utterance) {
  static const std::set<CueKind> reminders = {CueKind::stuck,     CueKind::stuck_unknown,
                                              CueKind::back_away, CueKind::release_stick,
                                              CueKind::press,     CueKind::choose_goal};
  const Priority priority = utterance.priority.value_or(traits(utterance.kind).priority);
  const bool introduces = traits(utterance.kind).ask == navvi_types::Ask::ready;
  return (priority <= Priority::text && !introduces) || reminders.count(utterance.kind) > 0;
}

/// Whether the person does without it, unless they ask.
bool muted(CueKind kind, const WordingConfig& wording) {
  return (!wording.way && family_of(kind) == Family::way) || (!wording.near && is_near(kind));
}

}  // namespace

void Phrasing::use(const WordingConfig& wording) {
  phrases_.use(wording);
  WordingConfig brief = wording;
  brief.verbosity = "brief";
  plates_.use(brief);
}

std::string Phrasing::shown(const Utterance& utterance) const {
  const Phrases& words = family_of(utterance.kind) == Family::way ? plates_ : phrases_;
  return words.say(utterance, utterance.fillings);
}

/// The farthest of what is around lose their distances, as far as there is no room for all.
Utterance Phrasing::shortened(Utterance around) const {
  std::vector<Utterance*> parts = {&around};
  for (Utterance& more : around.also) parts.push_back(&more);
  const auto farther = [](const Utterance* a, const Utterance* b) {
    return a->fillings.distance.value_or(0.0) > b->fillings.distance.value_or(0.0);
  };
  const auto all = [&] {
    std::string text;
    for (const Utterance* const part : parts)
      text += (text.empty() ? "" : ", ") + phrases_.say(*part, part->fillings);
    return text;
  };
  std::vector<Utterance*> farthest_first = parts;
  std::stable_sort(farthest_first.begin(), farthest_first.end(), farther);
  for (Utterance* const part : farthest_first)
    if (!speakable(all())) part->about = About::side;
  return around;
}

/// As much of it as may be spoken at once.
Phrasing::Sentence Phrasing::word(const Utterance& whole, bool again) const {
  const Utterance utterance = whole.kind == CueKind::around ? shortened(whole) : whole;
  Sentence told{phrases_.say(utterance, utterance.fillings, again), {}};
  const auto longer = [&](const std::string& joined) {
    const bool fits = speakable(joined);
    if (fits) told.text = joined;
    return fits;
  };
  const auto sounds_from = [&](const Utterance& part) {
    if (part.from)
      told.scan.push_back({earcon_of(part.fillings.thing.value_or(ThingClass::other)), *part.from});
  };
  sounds_from(utterance);
  // Phrases has seen to it that there is room.
  if (utterance.goes_on) told.text = phrases_.say(CueKind::go_on) + ", " + told.text;
  for (const Utterance& more : utterance.also)
    if (longer(told.text + ", " + phrases_.say(more, more.fillings))) sounds_from(more);
  return told;
}

std::vector<Cue> Phrasing::cues_of(const std::vector<Utterance>& utterances, const Observation& now,
                                   double time) {
  std::vector<Cue> cues;
  for (Utterance utterance : utterances) {
    utterance.fillings.keys = now.devices.keyboard;
    const navvi_types::CueTraits& usual = traits(utterance.kind);
    // An answer, and the end of a wait, are always said.
    const bool always = utterance.asked || utterance.goes_on;
    if (!always && muted(utterance.kind, phrases_.wording()) && !instead_of(utterance, now.sounds))
      continue;
    if (!always && too_soon(utterance, time)) continue;
    const auto age = [&](const std::string& text) {
      const auto same = last_text_.find(text);
      return time - (same == last_text_.end() ? kNever : same->second.last);
    };
    const auto sound = instead_of(utterance, now.sounds);
    Sentence told = word(utterance, false);
    const bool again = !utterance.asked && !sound && age(told.text) < same_text_;
    const bool felt = again && now.touch && tells_nothing_new(utterance);
    if (again && !felt)
      if (Sentence other = word(utterance, true); age(other.text) > age(told.text)) told = other;
    Cue cue{Content(utterance), told.text, utterance.priority.value_or(usual.priority),
            usual.max_age,      sound,     utterance.asked};
    cue.goes_on = utterance.goes_on;
    if (cue.goes_on) cue.max_age = traits(CueKind::go_on).max_age;
    cue.felt = felt;
    cue.scan = told.scan;
    if (!sound && !felt) {
      Times& times = last_text_[cue.text];
      times = {time, times.last};
      if (utterance.fillings.hour == 12) straight_said_ = time;
    }
    last_said_.note(utterance, time);
    cues.push_back(cue);
  }
  std::stable_sort(cues.begin(), cues.end(),
                   [](const Cue& a, const Cue& b) { return a.priority > b.priority; });
  return cues;
}

void Phrasing::forget(const CueEvent& event) {
  if (event.spoken()) last_said_.forget(*event.spoken());
  if (const auto said = last_text_.find(event.text); said != last_text_.end())
    said->second.last = said->second.before;
}

}  // namespace navvi_feedback::cues
