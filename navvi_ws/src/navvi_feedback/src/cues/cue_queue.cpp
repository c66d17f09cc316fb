#include "cues/cue_queue.hpp"

#include <algorithm>

#include "cues/route_cues.hpp"

namespace navvi_feedback::cues {
namespace {

constexpr std::size_t kMaxWaiting = 2;

CueEvent event(std::uint32_t id, CueStage stage, const Cue& cue) {
  return {id, stage, navvi_types::Spoken(cue, cue.lesson), cue.text, cue.priority};
}

bool stops(const Cue& cue) { return family_of(cue.kind) == Family::halt; }

/// What a lost device makes untrue before it was said.
std::optional<Content> undone_by(const Content& lost) {
  if (lost == CueKind::proximity_lost) return CueKind::proximity_back;
  if (lost == CueKind::connection_lost) return Content(CueKind::back, About::connection);
  if (lost != CueKind::stick_lost) return std::nullopt;
  return lost.about == About::pad ? CueKind::pad_back : Content(CueKind::back, lost.about);
}

/// It does not wait for another of its priority.
bool at_once(const Cue& cue) { return cue.asked || stops(cue); }

}  // namespace

CueQueue::Step CueQueue::update(const std::vector<Cue>& fresh, bool speaker_busy, double time) {
  Step step;
  if (running_ && !speaker_busy) {
    step.events.push_back(event(running_->id, CueStage::ended, running_->cue));
    running_.reset();
  }
  drop_stale(time, step);
  for (const Cue& cue : fresh) enter(cue, time, step);
  drop_surplus(step);
  begin_next(step);
  return step;
}

CueQueue::Step CueQueue::clear() {
  Step step;
  if (running_) {
    step.stop = true;
    step.events.push_back(event(running_->id, CueStage::cut, running_->cue));
    running_.reset();
  }
  drop([](const Entry&) { return true; }, step);
  return step;
}

template <typename Which>
void CueQueue::drop(const Which& which, Step& step) {
  for (auto entry = waiting_.begin(); entry != waiting_.end();) {
    if (!which(*entry)) {
      ++entry;
      continue;
    }
    step.events.push_back(event(entry->id, CueStage::dropped, entry->cue));
    entry = waiting_.erase(entry);
  }
}

void CueQueue::enter(const Cue& cue, double time, Step& step) {
  const Entry entry{++last_id_, time, cue};
  step.events.push_back(event(entry.id, CueStage::queued, cue));
  if (stops(cue)) drop_ways(step);
  const std::optional<Content> untrue = undone_by(cue);
  drop([&](const Entry& other) { return untrue && Content(other.cue) == *untrue; }, step);
  const auto same = std::find_if(waiting_.begin(), waiting_.end(), [&](const Entry& other) {
    // Two things that were hit may be two messages of one content.
    if (cue.asked && other.cue.asked) return true;
    const bool either = tells_sight(other.cue.kind) && tells_sight(cue.kind);
    return (Content(other.cue) == Content(cue) || either) &&
           (cue.priority < Priority::important || other.cue.text == cue.text);
  });
  if (same != waiting_.end() && same->cue.goes_on && !cue.goes_on && !cue.asked) {
    step.events.push_back(event(entry.id, CueStage::dropped, cue));
    return;
  }
  if (same != waiting_.end()) {
    step.events.push_back(event(same->id, CueStage::dropped, same->cue));
    waiting_.erase(same);
  }
  const auto place = std::find_if(waiting_.begin(), waiting_.end(), [&](const Entry& other) {
    return other.cue.priority < cue.priority ||
           ((at_once(cue) || cue.goes_on) && other.cue.priority == cue.priority);
  });
  waiting_.insert(place, entry);
}

void CueQueue::drop_ways(Step& step) {
  drop([](const Entry& entry) { return is_way(family_of(entry.cue.kind)); }, step);
}

void CueQueue::drop_stale(double time, Step& step) {
  const auto stale = [&](const Entry& entry) { return time - entry.since > entry.cue.max_age; };
  const bool waits_on = std::any_of(waiting_.begin(), waiting_.end(), [&](const Entry& entry) {
    return entry.cue.goes_on && stale(entry);
  });
  drop(stale, step);
  if (waits_on) drop_ways(step);
}

void CueQueue::drop_surplus(Step& step) {
  const auto lesser = std::find_if(waiting_.begin(), waiting_.end(), [](const Entry& entry) {
    return entry.cue.priority < Priority::important;
  });
  // One place more for the cue that begins in this very step.
  const bool begins = !waiting_.empty() && (!running_ || at_once(waiting_.front().cue) ||
                                            waiting_.front().cue.priority > running_->cue.priority);
  const bool lesser_begins = begins && lesser == waiting_.begin();
  const auto room = static_cast<std::ptrdiff_t>(kMaxWaiting + (lesser_begins ? 1 : 0));
  for (auto surplus = waiting_.end() - lesser - room; surplus > 0; --surplus) {
    const auto last = std::find_if(waiting_.rbegin(), waiting_.rend(), [](const Entry& entry) {
      return entry.cue.priority < Priority::important && !entry.cue.goes_on;
    });
    if (last == waiting_.rend()) return;
    step.events.push_back(event(last->id, CueStage::dropped, last->cue));
    waiting_.erase(std::next(last).base());
  }
}

void CueQueue::begin_next(Step& step) {
  if (waiting_.empty()) return;
  const Entry& next = waiting_.front();
  if (running_) {
    if (running_->cue.priority == Priority::important ||
        (next.cue.priority <= running_->cue.priority && !next.cue.asked &&
         !(stops(next.cue) && !stops(running_->cue))))
      return;
    step.events.push_back(event(running_->id, CueStage::cut, running_->cue));
    step.stop = true;
  }
  const bool waits_on = running_ && running_->cue.goes_on;
  running_ = next;
  waiting_.pop_front();
  if (waits_on) drop_ways(step);
  step.events.push_back(event(running_->id, CueStage::started, running_->cue));
  step.start = running_->cue.text;
  step.asked = running_->cue.asked;
  step.scan = running_->cue.scan;
}

std::vector<CueEvent> HeardWords::of(std::vector<CueEvent> events, bool hears, bool heard) {
  std::vector<CueEvent> result;
  for (CueEvent& event : events) {
    if (event.id == unheard_) continue;
    if (event.stage == CueStage::started && !hears) {
      unheard_ = event.id;
      event.stage = CueStage::dropped;
    } else if (event.stage == CueStage::ended && !heard) {
      event.stage = CueStage::cut;
    }
    result.push_back(event);
  }
  return result;
}

}  // namespace navvi_feedback::cues
