#pragma once

#include <algorithm>
#include <map>
#include <navvi_types/names.hpp>
#include <navvi_types/spoken.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "beat.hpp"
#include "cues/surroundings.hpp"

namespace navvi_feedback::core {

/// What sessions came to.
struct Verdict {
  std::set<std::string> complaints;  ///< rules that were broken
  int orders_of_way = 0;             ///< looks at which the order was to drive somewhere
  int waits = 0;                     ///< that were ended by "go on"
  double longest_wait = 0.0;         ///< s, for "go on" after the cause had gone
  double longest_wait_alone = 0.0;   ///< s, of these, with nothing that moves near
  double longest_owed = 0.0;         ///< s, at rest after "go on", for the next one
  int owed_again = 0;                ///< that were said to who had not moved since the one before

  void add(const Verdict& more) {
    complaints.insert(more.complaints.begin(), more.complaints.end());
    orders_of_way += more.orders_of_way;
    waits += more.waits;
    longest_wait = std::max(longest_wait, more.longest_wait);
    longest_wait_alone = std::max(longest_wait_alone, more.longest_wait_alone);
    longest_owed = std::max(longest_owed, more.longest_owed);
    owed_again += more.owed_again;
  }
};

/// For tests: a robot, its world and a voice about one Guide, and a judge of what is told. The
/// voice is navvi_types' model.
class SessionJudge : public Verdict {
 public:
  /// All that may happen to a person; steady until it is changed.
  struct Scene {
    Guidance guidance;
    std::optional<Velocity> velocity = Velocity{0.8, 0.0};  ///< nullopt: no odometry
    std::vector<NearThing> nearby;
    std::vector<Contact> contacts;  ///< begun since the last tick
    DriveState gate{DriveState::State::running};
    TrialState::State trial = TrialState::State::free;
    bool guided = true;    ///< guidance comes
    bool sensed = true;    ///< proximity comes
    bool stick = true;     ///< it is connected
    double forward = 0.8;  ///< stick
    bool sounds = true;
    Link audio = Link::alive;
    bool motors = true;
    std::optional<drive::Button> asked;
    std::vector<Content> notices;
  };

  explicit SessionJudge(const GuideConfig& config = {})
      : guide_(config, cues::Phrases(kEnglish)) {
    Guidance& guidance = now.guidance;
    guidance.state = Guidance::State::following;
    guidance.goal = guidance.waypoint = {20.0, 0.0};
    guidance.waypoint_is_goal = true;
    guidance.waypoint_distance = guidance.goal_distance = 20.0;
  }

  /// Lets go of the stick, and then drives until only news is told.
  void get_under_way() {
    const double forward = std::exchange(now.forward, 0.0);
    pass(0.5);
    now.forward = forward;
    pass(12.0);
    forget();
  }

  void forget() {
    words.clear();
    felt.clear();
    played.clear();
    complaints.clear();
  }

  void pass(double seconds) {
    for (const double end = time + seconds; time < end - 1e-9; time += kTick) tick();
  }

  Scene now;
  double time = 10.0;
  std::vector<std::string> words;    ///< texts that were begun
  std::set<std::string> felt;        ///< patterns
  std::set<std::string> played;      ///< earcons
 private:
  using Events = std::vector<CueEvent>;
  struct Known {
    double queued = 0.0;
    cues::Cue cue;
  };

  static constexpr double kTick = 0.02;

  void tick() {
    const bool same = (now.guidance.goal - last_.guidance.goal).norm() <= 0.5;
    if (!same) told_unseen_ = false;
    if (now.guided) guide_.take(now.guidance, time);
    if (now.velocity) guide_.take(Odometry{0, {}, *now.velocity}, time);
    if (now.sensed) guide_.take(Proximity{0, now.nearby}, time);
    guide_.take(now.gate, time);
    guide_.take(TrialState{now.trial}, time);
    for (const Contact& contact : now.contacts) guide_.take(contact, time);
    Devices input;
    input.hands.live = now.stick;
    input.hands.axes = {0.0, now.forward};
    input.hands.buttons = std::vector<bool>(20, false);
    input.sounds = now.sounds;
    input.audio = now.audio;
    input.motors = now.motors;
    input.states = now.notices;
    input.speaking = time < speaks_until_;
    if (now.asked) input.asked = {*now.asked};
    const Beat out = beat(guide_, input, time);
    const bool shut = now.gate.state == DriveState::State::stopped;
    const bool vain = now.stick && now.forward > 0.0 && (shut || guide_.parts().held_unarmed);
    held_in_vain_ = vain ? held_in_vain_ + kTick : 0.0;
    if (out.pattern) felt.insert(navvi_types::to_string(*out.pattern));
    if (out.pattern) felt_[*out.pattern] = time;
    touched_ = out.pattern.has_value();
    for (const sounds::Play& play : out.plays) played.insert(navvi_types::to_string(play.earcon));
    if (out.voice.stop) speaks_until_ = time;
    if (out.voice.start) speaks_until_ = navvi_types::spoken_at(time, out.voice.start->size());
    judge(out.cues, out.events);
    expect_what_matters();
    expect_release();
    expect_toward();
    expect_one_order(out);
    now.contacts.clear();
    now.asked.reset();
    last_ = now;
  }

  /// Rules of the voice: nothing important is cut or waits behind less; nothing is told late, or
  /// twice for nothing.
  void judge(const std::vector<cues::Cue>& fresh, const Events& events) {
    auto next = fresh.begin();
    for (const CueEvent& event : events) {
      if (event.stage == CueStage::queued) {
        known_[event.id] = {time, *next++};
        decided_[*event.content()] = time;
        const bool way = is_way(family_of(*event.kind())) && !known_[event.id].cue.asked;
        const bool same = now.guidance.state == last_.guidance.state;
        if (way && same && std::min({held_in_vain_, alive_, steady_}) > 1.0)
          complaints.insert("a way while the stick is held in vain");
        continue;
      }
      const Known known = known_.at(event.id);
      const bool important = known.cue.priority == Priority::important;
      if (event.stage == CueStage::cut && important) complaints.insert("an important cue was cut");
      if (event.stage != CueStage::started && event.id == released_) {
        if (event.stage == CueStage::ended && std::exchange(waits_, false)) ++waits;
        if (event.stage == CueStage::ended && std::exchange(owed_, true)) ++owed_again;
        released_ = 0;
      }
      if (event.stage == CueStage::ended && event.kind() == CueKind::toward_goal)
        told_unseen_ = true;
      if (event.stage == CueStage::ended && event.kind() == CueKind::goal_seen)
        told_unseen_ = false;
      if (event.stage != CueStage::started) {
        known_.erase(event.id);
        if (event.id == running_) running_ = 0;
        continue;
      }
      if (running_ != 0) complaints.insert("two cues at once");
      running_ = event.id;
      words.push_back(event.text);
      if (!navvi_types::speakable(event.text)) complaints.insert("unspeakable: " + event.text);
      says_way_ = says_way_ || (is_way(family_of(*event.kind())) && !known.cue.asked);
      if (time - known.queued > known.cue.max_age + kTick) complaints.insert("a stale cue");
      judge_wait(event, known.cue.asked);
      for (const auto& [id, other] : known_)
        if (id != event.id && !important && other.cue.priority == Priority::important)
          complaints.insert("an important cue waited behind a lesser one");
      const auto said = said_.find(event.text);
      static const std::set<CueKind> news = {
          CueKind::blocked,   CueKind::go_on,       CueKind::turn_now,    CueKind::obstacle_comes,
          CueKind::make_room, CueKind::new_route,   CueKind::rerouted,    CueKind::start,
          CueKind::toward_goal, CueKind::goal_seen};
      const bool reminds = known.cue.priority <= Priority::text || event.kind() == CueKind::stuck ||
                           event.kind() == CueKind::back_away ||
                           event.kind() == CueKind::release_stick;
      if (now.motors && !known.cue.asked && reminds && news.count(*event.kind()) == 0 &&
          said != said_.end() && time - said->second < 10.0 - kTick)
        complaints.insert("the same again: " + event.word());
      said_[event.text] = time;
      if (asks(*event.kind())) asked_for_ = *event.content();
    }
  }

  /// Something is to be done now.
  [[nodiscard]] static bool asks(CueKind kind) {
    using navvi_types::Ask;
    const Ask ask = traits(kind).ask;
    return traits(kind).shown ||
           (ask != Ask::nothing && ask != Ask::beware && ask != Ask::ready);
  }

  /// What is shown for some seconds is what the voice has begun, and nothing else since; or what
  /// the motors have instead, unless they told of a hit.
  [[nodiscard]] bool unsaid(const CueEvent& order) const {
    const navvi_types::CueTraits& kind = traits(*order.kind());
    const auto recent = [&](double at) { return time - at < 4.0 + 1.5 * kTick; };
    const auto said = said_.find(order.text);
    if (said != said_.end() && recent(said->second) && asked_for_ == *order.content()) return false;
    return !kind.felt || std::none_of(felt_.begin(), felt_.end(), [&](const auto& felt) {
      const auto& [pattern, at] = felt;
      const bool hit =
          pattern == haptics::Pattern::hit_shelf || pattern == haptics::Pattern::hit_obstacle;
      return recent(at) && (hit || pattern == *kind.felt);
    });
  }

  /// The rule that is taught: after "stop" or "wait" nothing but "go on", with the direction.
  void judge_wait(const CueEvent& begun, bool asked) {
    const std::string& text = begun.text;
    const auto begins = [&](const std::string& words) { return text.rfind(words, 0) == 0; };
    // Where the next turn is may be asked for at any time.
    const bool way =
        is_way(family_of(*begun.kind())) && !(asked && begun.kind() == CueKind::turn_ahead);
    if (begins("go on") && !(way && begins("go on, ")))
      complaints.insert("go on without a direction: " + text);
    if ((waits_ || (owed_ && !moves_on())) && way && !begins("go on, "))
      complaints.insert("a way without go on: " + begun.word());
    if (begins("stop") || begins("wait")) {
      waits_ = true;
      owed_ = false;
      released_ = 0;
    } else if (begins("go on, ")) {
      released_ = begun.id;
    }
  }

  /// Once the cause has gone, a person who waits hears "go on" within some seconds; and again, as
  /// it may have been missed, until the wheels have moved.
  void expect_release() {
    const bool over = now.guidance.is_followed() && alive_ > 0.0;
    const bool moves = std::any_of(now.nearby.begin(), now.nearby.end(),
                                   [](const NearThing& thing) { return thing.moving; });
    const bool due = over && held_in_vain_ == 0.0 && released_ == 0;
    waits_over_ = waits_ && due ? waits_over_ + kTick : 0.0;
    waits_alone_ = moves ? 0.0 : std::min(waits_alone_ + kTick, waits_over_);
    longest_wait = std::max(longest_wait, waits_over_);
    longest_wait_alone = std::max(longest_wait_alone, waits_alone_);
    if (moves_on()) owed_ = false;
    owed_over_ = owed_ && due ? owed_over_ + kTick : 0.0;
    longest_owed = std::max(longest_owed, owed_over_);
  }

  /// Whoever is led toward a goal that is not seen yet hears so as soon as nothing else is said.
  void expect_toward() {
    const bool leads = alive_ > 0.0 && now.guidance.state == Guidance::State::following;
    if (!leads || !now.guidance.ends_short || told_unseen_ || waits_ || held_in_vain_ > 0.0)
      silent_ = 0.0;
    else if (running_ == 0)
      silent_ += kTick;
    if (silent_ > 1.0) complaints.insert("led toward the unseen untold");
  }

  /// Voice, pad and sounds follow the order that banner, panel and plate show and have from nowhere
  /// else.
  void expect_one_order(const Beat& out) {
    const bool halts = out.pattern == haptics::Pattern::halt;
    const bool halt_begins = !std::exchange(feels_halt_, halts) && halts;
    if (std::exchange(beats_, (beats_ + 1) % 5) != 0 && !says_way_ && !halt_begins) return;
    using navvi_types::Ask;
    const std::optional<CueEvent> order = guide_.order();
    const CueKind kind = order ? *order->kind() : CueKind::lesson;
    const Ask ask = order ? traits(kind).ask : Ask::nothing;
    const bool drive = order && is_way(family_of(kind));
    const auto contradicts = [&](const char* what, bool wrong) {
      if (wrong) complaints.insert(std::string(what) + " against the order " + to_string(kind));
    };
    const bool goes_on =
        released_ != 0 || std::any_of(known_.begin(), known_.end(), [](const auto& known) {
          return known.second.cue.goes_on;
        });
    // The voice has ended a word a moment before it is noted.
    const bool waits = drive && waits_ && !goes_on;
    contradicts("a voice that said wait", std::exchange(waited_, waits) && waits);
    contradicts("a voice that says the way", says_way_ && family_of(kind) == cues::Family::halt);
    contradicts("a pad that says halt", drive && halt_begins);
    // As long as it is held; it is said again and again.
    const bool held = kind == CueKind::release_stick && now.forward > 0.0;
    contradicts("a voice that did not say it", order && traits(kind).shown && !held && unsaid(*order));
    const bool ticks = std::any_of(out.plays.begin(), out.plays.end(), [](const auto& play) {
      return play.earcon == sounds::Earcon::turn || play.earcon == sounds::Earcon::turn_click;
    });
    const bool rests = kind != CueKind::release_stick &&
                       (ask == Ask::halt || ask == Ask::begin || ask == Ask::rest);
    contradicts("ticks", ticks && (!order || rests || family_of(kind) == cues::Family::halt));
    contradicts("a guidance that does not lead", drive && now.guided && !now.guidance.is_followed());
    says_way_ = false;
    if (drive) ++orders_of_way;
  }

  /// On, not back.
  [[nodiscard]] bool moves_on() const {
    return now.velocity &&
           (now.velocity->linear > 0.05 || std::abs(now.velocity->angular) > 0.05);
  }

  [[nodiscard]] bool decided(const Content& content, double within) const {
    const auto found = decided_.find(content);
    return found != decided_.end() && time - found->second <= within;
  }

  /// Whatever matters is decided within its time, by rules that are written without the policy.
  void expect_what_matters() {
    const auto demand = [&](const Content& content, double within) {
      if (!decided(content, within)) complaints.insert("unsaid: " + to_string(content));
    };
    for (const Contact& contact : now.contacts) {
      const double before = hits_.count(contact.id) > 0 ? hits_[contact.id] : -1e9;
      if (time - before < 1.5) continue;
      hits_[contact.id] = time;
      demand({CueKind::collision, cues::about(contact.thing_class)}, kTick);
    }
    const bool simulated = now.velocity && last_.velocity;
    // A stick that comes and goes is lost until it is told to be back.
    const bool off = decided_[{CueKind::stick_lost, About::pad}] > decided_[CueKind::pad_back];
    plugged_ = now.stick ? plugged_ + kTick : 0.0;
    if (off && plugged_ > 5.0 + 2.0 * kTick) demand(CueKind::pad_back, kTick);
    alive_ = simulated && now.guided && now.stick && !off && now.trial == TrialState::State::free
                 ? alive_ + kTick
                 : 0.0;
    if (last_.stick && !now.stick && !off) demand({CueKind::stick_lost, About::pad}, 2.0 + kTick);
    if (alive_ > 2.0 && last_.gate.state == DriveState::State::running &&
        now.gate.state == DriveState::State::stopped)
      demand(CueKind::robot_stopped, 2.0 + kTick);
    const bool same = now.guidance.state == last_.guidance.state;
    steady_ = same && alive_ > 0.0 ? steady_ + kTick : 0.0;
    static const std::map<Guidance::State, Content> told = {
        {Guidance::State::arrived, CueKind::arrived},
        {Guidance::State::no_route, {CueKind::no_way, About::no_route}},
        {Guidance::State::off_mesh, CueKind::off_mesh},
        {Guidance::State::no_map, {CueKind::no_way, About::no_map}},
        {Guidance::State::map_stale, {CueKind::no_way, About::map_stale}},
        {Guidance::State::pose_stale, {CueKind::no_way, About::pose_stale}},
        {Guidance::State::blocked, CueKind::blocked},
        {Guidance::State::make_room, CueKind::make_room}};
    const auto kind = told.find(now.guidance.state);
    // A word to stop holds first, and one arrival is told once.
    const bool halted = decided(CueKind::obstacle_stop, 9.0) ||
                        (kind != told.end() && kind->second == CueKind::make_room &&
                         (decided(CueKind::blocked, 9.0) || held_in_vain_ > 0.0));
    const bool excused =
        kind == told.end() || halted || (kind->second == CueKind::arrived && arrived_);
    if (now.guidance.is_followed()) arrived_ = false;
    if (decided(CueKind::arrived, kTick)) arrived_ = true;
    if (!excused && alive_ > 3.0 && steady_ > 1.0 && steady_ < 1.0 + 1.5 * kTick)
      demand(kind->second, 5.0 + 1.0);
    const bool pushes = now.forward > 0.5 && now.velocity && now.velocity->linear == 0.0 &&
                        now.velocity->angular == 0.0 && now.stick && last_.velocity &&
                        last_.velocity->linear == 0.0;
    const bool told_why = touched_ || running_ != 0;
    in_vain_ = pushes && !told_why ? in_vain_ + kTick : 0.0;
    if (in_vain_ > 3.0) complaints.insert("pushed for 3 s in silence");
  }

  Guide guide_;
  double speaks_until_ = 0.0;
  std::map<std::uint32_t, Known> known_;
  std::uint32_t running_ = 0;
  std::map<Content, double> decided_;     ///< s
  std::map<std::string, double> said_;    ///< s, by text
  std::map<haptics::Pattern, double> felt_;  ///< s
  Content asked_for_;                        ///< by the voice, last
  std::map<std::uint32_t, double> hits_;  ///< s, by thing
  Scene last_;
  double alive_ = 0.0;    ///< s, since when all links have lived
  double plugged_ = 0.0;  ///< s, since when the stick is connected
  double steady_ = 0.0;   ///< s, of the guidance's state
  double in_vain_ = 0.0;  ///< s
  double silent_ = 0.0;   ///< s, while led untold toward a goal that is not seen yet
  bool told_unseen_ = false;
  double held_in_vain_ = 0.0;  ///< s, the stick is held and moves nothing
  bool touched_ = false;
  bool says_way_ = false;  ///< unasked, it has begun to since the last look at the order
  bool feels_halt_ = false;
  bool waited_ = false;  ///< at the last look the order was to drive, and the voice had said wait
  int beats_ = 0;
  bool arrived_ = false;
  bool waits_ = false;          ///< was told to, and has not heard "go on" to its end
  std::uint32_t released_ = 0;  ///< the cue that says it
  bool owed_ = false;           ///< "go on" was heard, and the wheels have not moved since
  double owed_over_ = 0.0;      ///< s, without another
  double waits_over_ = 0.0;     ///< s, though there is no cause any more
  double waits_alone_ = 0.0;    ///< s, of these, with nothing that moves near
};

}  // namespace navvi_feedback::core
