#include "trial/trial_keeper.hpp"

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <cmath>
#include <navvi_config/reader.hpp>
#include <stdexcept>
#include <utility>

#include "record/trial_folder.hpp"

namespace navvi_study::trial {
namespace fs = std::filesystem;

constexpr std::int64_t kSecond = 1'000'000'000;  // ns
constexpr double kSilent = 1.0;                  // s
constexpr double kSayAgain = 5.0;                // s, between sentences on what is missing
constexpr double kDrain = 0.3;                   // s, for reports on their way when a trial ends
constexpr double kHurry = 8.0;  // s, for a recorder once all must stop; roslaunch waits 15 s

std::optional<std::size_t> TrialKeeper::Job::at(const Eigen::Vector2d& goal) const {
  std::vector<std::size_t> order = left;  // of two places at one spot that which is still to come
  for (std::size_t i = 0; i < places.size(); ++i) order.push_back(i);
  for (const std::size_t i : order)
    if ((places[i].at - goal).norm() < record::kSameGoal) return i;
  return std::nullopt;
}

TrialKeeper::TrialKeeper(const TrialNodeConfig& config, Outlets outlets, const Moment& now,
                         navvi_files::SystemCalls calls)
    : config_(config),
      outlets_(std::move(outlets)),
      calls_(std::move(calls)),
      now_(now),
      readiness_(config.require, config.sources),
      monitor_(config.monitor),
      flow_(config.limit) {
  check(config_);
  config_.out = fs::absolute(config_.out).lexically_normal().string();
  if (!config_.job.empty()) {
    job_.places = navvi_feedback::menu::read_places(config_.job);
    if (job_.places.empty())
      throw navvi_config::ConfigError(config_.job + ": a job must have at least one place.");
    for (std::size_t i = 0; i < job_.places.size(); ++i) job_.left.push_back(i);
    config_.once = false;
  }
  for (const auto& sentence : record::recover_trials(config_.out)) tell(Tone::warning, sentence);
  enter(Phase::waiting);
}

bool TrialKeeper::drops(std::int64_t stamp) {
  if (!monitor_.ahead(stamp, now_.ros_ns)) return false;
  if (!std::exchange(shown_.dropped, true))
    tell(Tone::warning, "A report is stamped " +
                            record::fixed(1e-9 * static_cast<double>(stamp - now_.ros_ns), 1) +
                            " s ahead of ROS time and was dropped; allowed is 1 s.");
  return true;
}

void TrialKeeper::enter(Phase phase) {
  phase_ = phase;
  phase_since_ = now_.wall();
}

void TrialKeeper::take(const Odometry& odometry, const Moment& now) {
  now_ = now;
  if (drops(odometry.stamp)) return;
  readiness_.saw_odometry(now.wall());
  tracker_.take_odometry(odometry);
  for (const auto& place : places_.take(odometry)) observe(place);
}

void TrialKeeper::take(const Correction& correction, const Moment& now) {
  now_ = now;
  for (const auto& place : places_.take(correction)) observe(place);
}

void TrialKeeper::take(const Guidance& guidance, const Moment& now) {
  now_ = now;
  const bool refused = guidance.state == Guidance::State::goal_refused && !drops(guidance.stamp);
  if (phase_ != Phase::running && refused && goals_.next && job_.places.empty() &&
      (guidance.goal - goals_.next->place).norm() < record::kSameGoal)
    goals_.next.reset();
  observe(guidance);
}

/// From now on it is sent until the guidance shows it.
void TrialKeeper::change_goal(const ChosenGoal& chosen) {
  goals_.now = chosen;
  goals_.tries = {};
  record(monitor_.change_goal(chosen.place, std::max(now_.ros_ns, monitor_.latest())));
}

void TrialKeeper::take(const Scenario& scenario, const Moment& now) {
  now_ = now;
  offered_.scenario = scenario;
  if (!active()) offered_.played = false;
}

void TrialKeeper::take(const ClockOffset& clock, const Moment& now) {
  now_ = now;
  if (phase_ != Phase::running) return;
  record({"CLOCK_OFFSET",
          record::Fields()
              .set("source", clock.source)
              .set("offset_ns", std::to_string(clock.offset_ns)),
          monitor_.latest(), false});
}

void TrialKeeper::take(const TrialRequest& request, const Moment& now) {
  now_ = now;
  if (request.kind == TrialRequest::Kind::begin) {
    if (state() == TrialState::State::ready) pressed_ = request.stamp;
  } else if (phase_ == Phase::running) {
    end({"aborted", "ended_by_person", monitor_.latest()});
  }
}

void TrialKeeper::take_goal(const Eigen::Vector2d& goal, const Moment& now, std::int64_t stamp) {
  now_ = now;
  const ChosenGoal chosen{goal, stamp};
  if (phase_ == Phase::running) {
    if (config_.locked) return end({"aborted", "goal_changed", monitor_.latest()});
    if (monitor_.goal_taken()) goals_.before = goals_.now;
    change_goal(chosen);
    goals_.tries.sent_elsewhere(now.wall());
  } else if (config_.locked && (offered_.scenario || !job_.places.empty())) {
    tell(Tone::warning, "A goal was set from outside, with no effect.");
  } else if (!offered_.scenario || offered_.played || config_.press_to_start) {
    // Also while a record is being closed: the next trial is to it.
    offered_.played = true;
    goals_.next = chosen;
    if (phase_ == Phase::armed && !config_.press_to_start) try_to_start();
  }
}

std::string TrialKeeper::missing() const {
  return boost::algorithm::join(readiness_.missing(now_.wall(), now_.ros_ns != 0), ", ");
}

bool TrialKeeper::may_say(double pause) {
  if (now_.wall() - shown_.said < pause) return false;
  shown_.said = now_.wall();
  return true;
}

void TrialKeeper::step(const Moment& now) {
  now_ = now;
  keep_track(monitor_.latest() - kSecond);
  switch (phase_) {
    case Phase::waiting:
      wait();
      break;
    case Phase::armed:
      try_to_start();
      break;
    case Phase::running:
      watch();
      break;
    case Phase::draining:
      if (now.wall() - phase_since_ >= kDrain) write_end();
      break;
    case Phase::closing:
      close();
      break;
    case Phase::done:
      break;
  }
  show_state();
}

TrialState::State TrialKeeper::state() {
  using State = TrialState::State;
  if (phase_ == Phase::running) return State::running;
  if (!config_.press_to_start) return active() ? State::running : State::free;
  if (phase_ != Phase::armed || !kept_.bag.ready(now_.wall()) || !missing().empty())
    return State::preparing;
  return goals_.next || job_.done() ? State::ready : State::choose_goal;
}

void TrialKeeper::show_state() {
  TrialState now{state()};
  if (std::exchange(shown_.state, now.state) == now.state) return;
  if (now.state == TrialState::State::ready && job_.here) {
    now.place = job_.places[*job_.here].name;
    now.task = job_.places[*job_.here].task;
  }
  outlets_.show(now);
}

void TrialKeeper::wait() {
  const std::string words = missing();
  if (words.empty()) return arm();
  // Between trials of a series a pause is allowed, but there must be a robot at all.
  const bool refuses = config_.once || !readiness_.saw_any_odometry();
  if (refuses && config_.patience > 0.0 && now_.wall() - phase_since_ > config_.patience) {
    tell(Tone::fatal, "No trial: after " + std::to_string(std::lround(config_.patience)) +
                          " s what is missing is still " + words + ".");
    return leave(3);
  }
  if (may_say(kSayAgain)) tell(Tone::warning, "No trial yet: waiting for " + words + ".");
}

void TrialKeeper::arm() {
  kept_.folder.clear();
  try {
    kept_.folder = record::create_trial_folder(config_.out, now_.utc_ns / kSecond);
    kept_.journal = std::make_unique<record::Journal>(
        kept_.folder, kept_.folder.filename().string(), record::Journal::kMinFree, calls_);
    kept_.track = std::make_unique<record::TrackFile>(kept_.folder, calls_);
  } catch (const std::runtime_error& error) {
    tell(Tone::fatal, error.what());
    return abandon(3);
  }
  kept_.bag = BagWatch(
      config_.record != "none" ? outlets_.start_recorder(kept_.folder / "trial.bag") : nullptr,
      now_.wall());
  kept_.bag_lost = false;
  enter(Phase::armed);
  shown_.said = phase_since_;
}

void TrialKeeper::try_to_start() {
  if (!kept_.bag.ready(now_.wall())) return;
  if (job_.done()) {
    if (config_.press_to_start && job_.here && !pressed_) return;
    std::string done = "The job is done: " + std::to_string(job_.places.size()) + " places";
    for (const auto at : job_.missed)
      done += (at == *job_.missed.begin() ? ", not reached: " : ", ") + job_.places[at].name;
    tell(job_.missed.empty() ? Tone::info : Tone::warning, done + ".");
    return abandon(0);
  }
  if (!job_.places.empty()) {
    if (!goals_.next) goals_.next = ChosenGoal{job_.places[job_.left.front()].at};
  } else if (offered_.scenario && !offered_.played) {
    offered_.played = true;
    goals_.next = ChosenGoal{offered_.scenario->goal};
  }
  if (!goals_.next) {
    if (may_say(6 * kSayAgain)) tell(Tone::info, "Ready for a trial: waiting for a goal.");
    return;
  }
  if (const std::string words = missing(); !words.empty()) {
    if (may_say(kSayAgain)) tell(Tone::warning, "No trial yet: waiting for " + words + ".");
    return;
  }
  if (!config_.press_to_start || pressed_) return start(*goals_.next);
  const double waited = now_.wall() - phase_since_;
  if (simulated() && config_.patience > 0.0 && waited > config_.patience) {
    tell(Tone::fatal, "No trial: the simulated operator has not begun it.");
    return abandon(3);
  }
  if (may_say(6 * kSayAgain)) tell(Tone::info, "Ready: press start, or enter, to begin the trial.");
}

void TrialKeeper::start(const ChosenGoal& chosen) {
  goals_.now = chosen;
  goals_.next.reset();
  goals_.before.reset();
  const Eigen::Vector2d& goal = goals_.now.place;
  TrialStart beginning = monitor_.start_now(now_.ros_ns, goal);
  beginning.hits_known = offered_.scenario && config_.sources.link.empty();
  monitor_.start(beginning);
  tracker_.start(beginning.stamp);
  listen();
  flow_.start(beginning.stamp);
  if (const auto deadline = flow_.deadline()) monitor_.end(*deadline);
  began_ = now_;
  ending_ = Ending();
  goals_.tries = GoalTries();
  enter(Phase::running);
  operator_seen_ = phase_since_;
  kept_.bag.expect_growth(phase_since_);
  kept_.feedback_silent = false;
  if (!record({"TRIAL_START", conditions(beginning), beginning.stamp})) return;
  record::Fields where = monitor_.place();
  where.set("goal_x", goal.x(), 6).set("goal_y", goal.y(), 6);
  if (!record({"GOAL_SET", where, beginning.stamp})) return;
  show_state();
  tell(Tone::info, "Trial " + kept_.folder.filename().string() + " has begun: goal at " +
                       record::fixed(goal.x(), 2) + ", " + record::fixed(goal.y(), 2) + ".");
  ask_for_goal();
}

record::Fields TrialKeeper::conditions(const TrialStart& beginning) {
  record::Fields fields = monitor_.place();
  kept_.settings = outlets_.settings();
  TrialNodeConfig config = config_;
  if (!outlets_.hears_contacts()) config.contacts = "unknown";
  add_conditions(fields, config, offered_.scenario, kept_.settings, beginning,
                 listener_ ? outlets_.phrases().filename().string() : "");
  fields.set("audio", readiness_.state_of("audio"));
  fields.set("pad", simulated() ? "simulated" : readiness_.state_of("pad"));
  // s of ROS time; the clock runs from TRIAL_START, which follows within a few hundredths of one
  if (const auto pressed = std::exchange(pressed_, std::nullopt))
    fields.set("pressed", 1e-9 * static_cast<double>(*pressed), 3);
  if (const auto at = job_.at(goals_.now.place)) {
    fields.set("job_place", static_cast<std::uint64_t>(*at + 1));
    fields.set("job_name", job_.places[*at].name).set("job_task", to_string(job_.places[*at].task));
  }
  fields.set("voice", readiness_.trait("speech", "voice"));
  fields.set("pad_name", readiness_.trait("pad", "name"));
  fields.set("pad_firmware", readiness_.trait("pad", "firmware"));
  fields.set("audio_device", readiness_.trait("audio", "device"));
  return fields;
}

/// By the words alone it is known where a sentence leads.
void TrialKeeper::listen() {
  const fs::path phrases = outlets_.phrases();
  if (listener_ || phrases.empty()) return;
  try {
    monitor_.understand(listener_.emplace(phrases));
  } catch (const std::exception& error) {
    tell(Tone::warning, std::string("Cues are recorded without their meaning: ") + error.what());
  }
}

/// What is stamped later may still come.
void TrialKeeper::keep_track(std::int64_t until) {
  if (active()) until = std::min(until, monitor_.ended().value_or(until));
  const record::Track rows = tracker_.rows_until(until);
  if (!active() || rows.empty()) return;
  if (const auto problem = kept_.track->append(rows)) tell(Tone::error, *problem);
}

void TrialKeeper::ask_for_goal() {
  const auto next = goals_.tries.next(monitor_.goal_taken(), now_.wall(), monitor_.round_trip());
  if (next == GoalTries::Next::send) outlets_.set_goal(goals_.now);
  if (next != GoalTries::Next::give_up) return;
  tell(Tone::error, "The goal was set several times, but the guidance does not show it.");
  end({"aborted", "goal_not_taken", monitor_.latest()});
}

void TrialKeeper::watch() {
  if (stall_.catches_up(now_.wall(), phase_since_)) return;
  watch_bag();
  const Signs seen = signs();
  watch_feedback(seen.feedback_silence);
  watch_settings();
  if (const auto ending = flow_.watch(seen)) return end(*ending);
  if (monitor_.goal_taken()) goals_.before.reset();  // given up
  ask_for_goal();
}

Signs TrialKeeper::signs() const {
  Signs signs;
  signs.now = now_.ros_ns;
  signs.latest = monitor_.latest();
  signs.disk_full = kept_.journal->full();
  signs.world_restarted = monitor_.world_restarted();
  signs.clock_jumped = monitor_.clock_jumped();
  signs.odometry_silence = readiness_.silence(now_.wall());
  signs.guidance_silence = readiness_.guidance_silence(now_.wall());
  signs.feedback_silence = readiness_.feedback_silence(now_.wall());
  if (simulated()) signs.operator_silence = now_.wall() - operator_seen_;
  return signs;
}

/// If feedback_node is silent for 1 s, warns and journals it. It may come back, as on a busy
/// machine; only its loss ends the trial.
void TrialKeeper::watch_feedback(double silence) {
  if (kept_.feedback_silent == (silence > kSilent)) return;
  kept_.feedback_silent = !kept_.feedback_silent;
  if (kept_.feedback_silent)
    tell(Tone::warning, "The guide is silent: feedback_node has not reported for a second.");
  record({kept_.feedback_silent ? "DEVICE_LOST" : "DEVICE_BACK",
          monitor_.place().set("device", "feedback"), monitor_.latest()});
}

/// No node obeys what is set while a condition is locked, but one that is started anew would.
void TrialKeeper::watch_settings() {
  if (!config_.locked || now_.wall() - kept_.settings_read < kSilent) return;
  kept_.settings_read = now_.wall();
  Settings settings = outlets_.settings();
  const Settings before = std::exchange(kept_.settings, settings);
  for (const auto& [name, value] : before) settings.try_emplace(name, "deleted");
  for (const auto& [name, value] : settings) {
    const auto old = before.find(name);
    if (old != before.end() && old->second == value) continue;
    tell(Tone::warning, "The parameter " + name + " was set from outside, with no effect.");
    record({"PARAMETER_SET", monitor_.place().set("name", name).set("value", value),
            monitor_.latest()});
  }
}

void TrialKeeper::watch_bag() {
  if (kept_.bag_lost || kept_.bag.growing(now_.wall())) return;
  kept_.bag_lost = true;
  tell(Tone::error, "The bag does not grow. The trial goes on; its summary says bag=bad.");
  record({"BAG_LOST", record::Fields(), monitor_.latest()});
}

void TrialKeeper::end(const Ending& ending) {
  if (!active()) return;
  monitor_.end(ending.stamp);
  ending_ = ending;
  ending_.stamp = *monitor_.ended();
  enter(Phase::draining);
  show_state();
}

void TrialKeeper::write_end() {
  const bool full = kept_.journal->full();
  if (full) kept_.journal->give_up_reserve();
  keep_track(ending_.stamp);
  // The goal may have been reached just before the end that was called first.
  ending_ = TrialFlow::last_word(ending_, monitor_.arrival(), full);
  if (const auto problem = kept_.track->sync()) {
    tell(Tone::error, *problem);
    if (!full) ending_ = {"invalid", "track_not_written", ending_.stamp};
  }
  record::Fields fields = monitor_.end_fields();
  fields.set("result", ending_.result).set("reason", ending_.reason);
  enter(Phase::closing);
  record({"TRIAL_END", fields, ending_.stamp});
  write_summary();
}

bool TrialKeeper::record(const Event& event) {
  if (kept_.journal->broken()) return false;
  record::Fields fields = event.fields;
  // By the monotonic clock from the start on: a clock that is set meanwhile changes no order.
  fields.set("utc", record::calendar(began_.utc_ns + now_.mono_ns - began_.mono_ns));
  // Once a second also as it stands, so that all clocks can be brought together.
  if (event.type == "PROGRESS") fields.set("calendar", record::calendar(now_.utc_ns));
  if (const auto row =
          kept_.journal->append(event.type, fields, event.sim_ns, now_.mono_ns, event.essential)) {
    outlets_.publish(*row);
    return true;
  }
  const bool ended = event.type == "BAG_CLOSED";
  tell(Tone::fatal, kept_.journal->problem() +
                        (ended ? ". The state of the bag is lost." : ". The trial is invalid."));
  exit_.code = 4;
  enter(Phase::closing);
  write_summary();
  return false;
}

void TrialKeeper::write_summary() {
  record::Trial kept = trial();
  auto& rows = kept.rows;
  if (kept_.journal->broken() && (rows.empty() || rows.back().type != "TRIAL_END")) {
    record::Row last =
        rows.empty() ? record::Row{kept_.folder.filename().string(), 0, 0, 0, "", {}} : rows.back();
    last.type = "TRIAL_END";
    last.fields = record::Fields().set("result", "invalid").set("reason", "journal_broken");
    rows.push_back(last);
  }
  if (const auto problem = record::write_results(kept_.folder, kept, calls_)) {
    tell(Tone::error, *problem);
    exit_.code = 4;
  }
}

void TrialKeeper::close() {
  if (exit_.asked && now_.wall() - *exit_.asked > kHurry) kept_.bag.kill();
  const double tail = exit_.asked ? kDrain : std::max(kDrain, config_.tail);
  if (kept_.bag.close(now_.wall() - phase_since_, tail)) finish();
}

void TrialKeeper::finish() {
  const std::string bag = kept_.bag.verdict();
  kept_.bag = BagWatch();
  if (!kept_.journal->broken()) {
    record({"BAG_CLOSED", record::Fields().set("state", bag), ending_.stamp});
    write_summary();
  }
  std::string screen = "Trial ended: " + kept_.folder.string();
  for (const auto& [name, cell] : record::summarize(trial()))
    screen += "\n  " + name + ": " + cell;
  tell(Tone::info, screen);
  kept_.journal.reset();
  enter(Phase::waiting);
  shown_.said = phase_since_;
  const bool reached = ending_.result == "reached";
  const auto at = job_.at(goals_.now.place);
  job_.here = reached || ending_.reason == "goal_at_start" ? at : std::nullopt;
  if (at && job_.here) job_.missed.erase(*at);
  if (at && !job_.here) job_.missed.insert(*at);
  // In a study each place is driven to once, and what breaks off a trial breaks off the job.
  if (at && (ending_.result != "aborted" || config_.locked))
    job_.left.erase(std::remove(job_.left.begin(), job_.left.end(), *at), job_.left.end());
  const bool broke_off = config_.locked && !reached && ending_.result != "timeout";
  if (config_.once || broke_off || exit_.asked || exit_.code != 0) leave(exit_.code);
}

void TrialKeeper::leave(int exit_code) {
  exit_.code = exit_code;
  enter(Phase::done);
}

/// No trial has begun: nothing is lost.
void TrialKeeper::abandon(int exit_code) {
  kept_.bag = BagWatch();
  kept_.journal.reset();
  kept_.track.reset();
  std::error_code error;
  fs::remove_all(kept_.folder, error);
  leave(exit_code);
}

void TrialKeeper::stop(const Moment& now, const std::string& crashed) {
  now_ = now;
  if (!exit_.asked) exit_.asked = now.wall();
  if (phase_ == Phase::waiting) return leave(exit_.code);
  if (phase_ == Phase::armed) return abandon(0);
  if (phase_ != Phase::running) return;
  const std::string reason = crashed.empty() ? TrialFlow::reason_of_stop(signs()) : crashed;
  end({"aborted", reason, monitor_.latest()});
}

}  // namespace navvi_study::trial
