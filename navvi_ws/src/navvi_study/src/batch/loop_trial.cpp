#include "batch/loop_trial.hpp"

#include <rosbag/bag.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <navvi_config/reader.hpp>
#include <navvi_sim/node/msg_conversion.hpp>
#include <navvi_sim/setup/sim_node_config.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <stdexcept>
#include <utility>

#include "node/msg_conversion.hpp"
#include "record/trial_folder.hpp"

namespace navvi_study::batch {
namespace {

namespace fs = std::filesystem;

/// Every parameter of the loop, as those of nodes stand in a live record.
trial::Settings settings_of(navvi_people::loop::ClosedLoopConfig config) {
  trial::Settings settings;
  const auto table = navvi_config::table_of([&](auto& visit) { config.describe(visit); });
  for (const navvi_config::Row& row : table)
    settings[row.key] = row.default_value;
  return settings;
}

void must(const navvi_files::Problem& problem) {
  if (problem) throw std::runtime_error(*problem);
}

/// As sim_node publishes it, but for the places, which no reader of a bag needs.
navvi_types::Scenario scenario_of(const ClosedLoop& loop) {
  const navvi_sim::setup::SimNodeConfig& sim = loop.config().sim;
  const navvi_sim::scenario::StartAndGoal& ends = loop.scenario();
  return {loop.world().name, navvi_sim::world_hash(loop.world()),
          static_cast<std::uint64_t>(sim.seed), ends.goal, ends.start,
          loop.world().floor_height, {}, navvi_sim::setup::recipe(sim, ends)};
}

}  // namespace

/// The bag of a closed loop: what its parts tell each other, under the names of a live session.
class LoopBag {
 public:
  /// \throws rosbag::BagException if it cannot be written
  LoopBag(const fs::path& path, const ClosedLoop& loop)
      : loop_(loop), bag_(path.string(), rosbag::bagmode::Write) {
    bag_.setCompression(rosbag::compression::LZ4);
    bag_.write("/navvi/scenario", ros::TIME_MIN, navvi_types::to_msg(scenario_of(loop)));
  }

  /// Call it after every step of the loop. \param rows  new ones of the journal
  void watch(const std::vector<record::Row>& rows) {
    const auto& told = loop_.told();
    const navvi_sim::live::Session& session = loop_.session();
    write("/odom", told.odometry);
    if (loop_.config().sim.life.robot.imperfections.odometry_drifts()) {
      tf2_msgs::TFMessage frames;
      frames.transforms = {navvi_sim::node::odom_msg(session.world().now())};
      write("/tf", frames);
    }
    for (const auto& contact : told.contacts) write("/navvi/contacts", contact);
    if (told.proximity) write("/navvi/proximity", *told.proximity);
    if (told.link) write("/navvi/link", *told.link);
    if (told.obstacles) write("/navvi/obstacles", *told.obstacles);
    if (told.guidance) write("/navvi/guidance", *told.guidance);
    for (const auto& cue : told.cues) write("/navvi/cues", cue);
    const int drive = 65536 * told.drive.state + 256 * told.drive.reason + told.drive.assistance;
    if (drive != drive_) write("/navvi/drive_state", told.drive);
    drive_ = drive;
    const navvi_people::people::StickAndButtons& hand = loop_.hand();
    sensor_msgs::Joy joy;
    joy.header.stamp = ros::Time(loop_.time());
    joy.axes = {static_cast<float>(hand.left), static_cast<float>(hand.forward)};
    joy.buttons = {hand.repeat ? 1 : 0};
    write("/joy", joy);
    for (; hashes_ < session.hashes().size(); ++hashes_)
      write("/navvi/state_hash", navvi_types::to_msg(session.hashes()[hashes_]));
    if (commands_ < session.commands().size()) {
      write("/navvi/applied_commands", navvi_sim::node::applied_commands_msg(
                                           session.commands(), commands_, ros::Time(loop_.time())));
      commands_ = session.commands().size();
    }
    for (const record::Row& row : rows) write("/navvi/events", node::to_msg(row));
  }

 private:
  template <typename Message>
  void write(const char* topic, const Message& message) {
    bag_.write(topic, ros::Time(loop_.time()), message);
  }

  const ClosedLoop& loop_;
  rosbag::Bag bag_;
  std::size_t hashes_ = 0;  ///< in the bag, as are
  std::size_t commands_ = 0;
  int drive_ = -1;  ///< the last state, reason and assistance
};

LoopTrial::LoopTrial(trial::TrialNodeConfig config, const ClosedLoop& loop, fs::path phrases)
    : config_(std::move(config)),
      loop_(loop),
      phrases_(std::move(phrases)),
      monitor_(config_.monitor),
      flow_(config_.limit) {
  config_.operator_kind = "simulated";
  monitor_.understand(loop.person().listener());
}

LoopTrial::~LoopTrial() = default;

void LoopTrial::keep(const fs::path& folder, std::int64_t utc_ns) {
  folder_ = folder;
  utc_ns_ = utc_ns;
  fs::create_directories(folder);
  bag_ = std::make_unique<LoopBag>(folder / "trial.bag", loop_);
}

void LoopTrial::push(const trial::Event& event) {
  if (!begun_) return;
  record::Row row{folder_.filename().string(), static_cast<std::uint32_t>(seen_.rows.size() + 1),
                  event.sim_ns, event.sim_ns, event.type, event.fields};
  if (bag_) row.fields.set("utc", record::calendar(utc_ns_ + row.sim_ns));
  seen_.rows.push_back(std::move(row));
}

template <typename Report>
void LoopTrial::observe(const Report& report) {
  tracker_.observe(report);
  for (const trial::Event& event : monitor_.observe(report)) push(event);
}

template <typename Message>
void LoopTrial::observe_all(const std::vector<Message>& messages) {
  for (const Message& message : messages)
    if (const auto report = navvi_types::from_msg(message)) observe(*report);
}

bool LoopTrial::watch() {
  const ClosedLoop::Messages& told = loop_.told();
  if (!begun_ && loop_.begun()) begin();
  if (const auto odometry = navvi_types::from_msg(told.odometry))
    tracker_.take_odometry(*odometry);
  // Where the robot truly is, which the odometry may not know.
  observe(loop_.session().world().now().robot.odometry(0.0, now()));
  observe_all(told.contacts);
  if (told.proximity) observe_all<navvi_msgs::Proximity>({*told.proximity});
  tracker_.observe(trial::Hands{now(), loop_.hand().forward, loop_.hand().left,
                                loop_.hand().repeat});
  observe_all(told.cues);
  if (told.guidance) observe_all<navvi_msgs::Guidance>({*told.guidance});
  observe_all<navvi_msgs::DriveState>({told.drive});
  if (told.link) observe_all<navvi_msgs::LinkState>({*told.link});
  const auto& hashes = loop_.session().hashes();
  for (; hashes_ < hashes.size(); ++hashes_) observe(hashes[hashes_]);
  const trial::Ending over = ending();
  if (!over.result.empty()) end(over);
  if (bag_) bag_->watch({seen_.rows.begin() + static_cast<std::ptrdiff_t>(published_), seen_.rows.end()});
  published_ = seen_.rows.size();
  return over.result.empty();
}

void LoopTrial::begin() {
  const Eigen::Vector2d& goal = loop_.scenario().goal;
  start_ = monitor_.start_now(now(), goal);
  start_.hits_known = true;
  monitor_.start(start_);
  tracker_.start(start_.stamp);
  flow_.start(start_.stamp);
  begun_ = true;
  record::Fields fields = monitor_.place();
  if (bag_)
    trial::add_conditions(fields, config_, scenario_of(loop_),
                          settings_of(loop_.config()), start_, "");
  else
    fields.set("settings", "feedback/lead=" + loop_.config().feedback.lead(true));
  fields.set("phrases", phrases_.filename().string());
  fields.set("pad", "simulated").set("audio", "simulated");
  push({"TRIAL_START", fields, start_.stamp});
  fields = monitor_.place();
  fields.set("goal_x", goal.x(), 6).set("goal_y", goal.y(), 6);
  push({"GOAL_SET", fields, start_.stamp});
}

/// Without a result while the trial goes on.
trial::Ending LoopTrial::ending() const {
  if (!begun_) return {};
  if (const auto& arrival = monitor_.arrival()) return {arrival->result, arrival->reason, now()};
  if (const auto why = monitor_.refused()) return {"refused", *why, now()};
  if (loop_.person().gave_up()) return {"aborted", "ended_by_person", now()};
  if (const auto deadline = flow_.deadline(); deadline && now() >= *deadline)
    return {"timeout", "limit", *deadline};
  return {};
}

void LoopTrial::end(const trial::Ending& ending) {
  monitor_.end(ending.stamp);
  record::Fields fields = monitor_.end_fields();
  push({"TRIAL_END", fields.set("result", ending.result).set("reason", ending.reason),
        ending.stamp});
  seen_.track = tracker_.rows_until(ending.stamp);
}

const record::Trial& LoopTrial::finish() {
  if (!bag_) return seen_;
  push({"BAG_CLOSED", record::Fields().set("state", "ok"), now()});
  bag_.reset();
  std::string journal = std::string(record::kJournalHeader) + "\n";
  for (const record::Row& row : seen_.rows) journal += record::format_row(row);
  must(navvi_files::write_atomically(folder_ / "journal.csv", journal));
  must(navvi_files::write_atomically(folder_ / "track.npy", record::track_npy(seen_.track)));
  must(record::write_results(folder_, seen_));
  return seen_;
}

}  // namespace navvi_study::batch
