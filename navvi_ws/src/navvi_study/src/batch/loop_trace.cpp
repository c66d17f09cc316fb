#include "batch/loop_trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <navvi_types/msg_conversion.hpp>
#include <ostream>
#include <utility>
#include <vector>

namespace navvi_study::batch {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
constexpr double kMoved = 0.5;         // m; a way-point that moved less is no news
constexpr double kMoversWithin = 8.0;  // m
constexpr double kThingsWithin = 1.5;  // m
constexpr std::size_t kMostMovers = 4;
constexpr std::size_t kMostThings = 3;

__attribute__((format(printf, 1, 2))) std::string text(const char* format, ...) {
  std::array<char, 400> buffer{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
  va_end(arguments);
  return buffer.data();
}

double away(const geometry_msgs::Point& a, const geometry_msgs::Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// Degrees clockwise from the nose.
double seen(const navvi_sim::physics::RobotState& robot, double x, double y) {
  return -kDegrees * std::remainder(std::atan2(y, x) - robot.yaw, 2.0 * M_PI);
}

std::string guidance_text(const navvi_msgs::Guidance& guidance) {
  std::string out = to_string(static_cast<navvi_types::Guidance::State>(guidance.state));
  const bool leads = guidance.state == navvi_msgs::Guidance::FOLLOWING ||
                     guidance.state == navvi_msgs::Guidance::BLOCKED ||
                     guidance.state == navvi_msgs::Guidance::MAKE_ROOM;
  if (!leads) return out + (guidance.detail.empty() ? "" : " (" + guidance.detail + ")");
  if (!guidance.blocked_by.empty())
    out += text(" by %s in %.1f m for %.1f s", guidance.blocked_by.c_str(),
                guidance.blocked_distance, guidance.blocked_for);
  return out + text(
                   ", steer %+.0f to %s %.2f,%.2f in %.1f m at %+.0f, then %+.0f; %.1f m left, "
                   "%.1f m off",
                   kDegrees * guidance.steer_angle, guidance.waypoint_is_goal ? "goal" : "corner",
                   guidance.waypoint.x, guidance.waypoint.y, guidance.waypoint_distance,
                   kDegrees * guidance.waypoint_angle, kDegrees * guidance.turn_angle,
                   guidance.goal_distance, guidance.path_offset);
}

std::string movers_text(const navvi_sim::physics::RobotState& robot,
                        const navvi_msgs::Obstacles& movers) {
  std::vector<std::pair<double, const navvi_msgs::Obstacle*>> near;
  for (const auto& mover : movers.obstacles) {
    const double distance = std::hypot(mover.pose.position.x - robot.position.x(),
                                       mover.pose.position.y - robot.position.y());
    if (distance <= kMoversWithin) near.emplace_back(distance, &mover);
  }
  std::sort(near.begin(), near.end());
  std::string out;
  for (std::size_t i = 0; i < std::min(near.size(), kMostMovers); ++i) {
    const auto& [distance, mover] = near[i];
    const double speed = std::hypot(mover->velocity.x, mover->velocity.y);
    out += text("%s%s#%u %.1f m at %+.0f", out.empty() ? "" : ", ", mover->thing_class.c_str(),
                mover->id, distance,
                seen(robot, mover->pose.position.x - robot.position.x(),
                     mover->pose.position.y - robot.position.y()));
    out += speed > 0.02 ? text(" going %.1f m/s to %+.0f", speed,
                               seen(robot, mover->velocity.x, mover->velocity.y))
                        : std::string(" standing");
  }
  return out;
}

std::string things_text(const navvi_msgs::Proximity& proximity) {
  std::string out;
  for (std::size_t i = 0; i < std::min(proximity.things.size(), kMostThings); ++i) {
    const auto& thing = proximity.things[i];
    if (thing.gap > kThingsWithin) break;
    out += text("%s%s %.2f m at %+.0f", out.empty() ? "" : ", ", thing.name.c_str(), thing.gap,
                -kDegrees * std::atan2(thing.nearest.y, thing.nearest.x));
  }
  return out;
}

}  // namespace

void LoopTrace::watch(const ClosedLoop& loop) {
  const ClosedLoop::Messages& told = loop.told();
  if (told.proximity) proximity_ = *told.proximity;
  if (told.obstacles) obstacles_ = *told.obstacles;
  if (loop.session().due(1.0)) tell_state(loop);
  tell_events(loop);
}

void LoopTrace::line(double time, const std::string& text) {
  if (time < from_ || time > to_) return;
  std::array<char, 16> clock{};
  std::snprintf(clock.data(), clock.size(), "%7.2f  ", time);
  out_ << clock.data() << text << '\n';
}

void LoopTrace::tell_events(const ClosedLoop& loop) {
  const ClosedLoop::Messages& told = loop.told();
  for (const auto& contact : told.contacts)
    line(loop.time(),
         "HIT " + contact.thing_class + " " + contact.name + text(" at %.2f m/s", contact.speed));
  if (told.guidance) tell_guidance(loop.time(), *told.guidance);
  for (const auto& cue : told.cues) {
    if (cue.modality == navvi_msgs::Cue::SOUND) {
      line(loop.time(),
           "  sounds " + cue.kind + text(", %.1f left %.1f right", cue.left, cue.right));
      continue;
    }
    static constexpr std::array<const char*, 5> kStages = {"", "says", "", "cuts", "drops"};
    const std::string stage = cue.stage < kStages.size() ? kStages[cue.stage] : "";
    if (!stage.empty())
      line(loop.time(), "  " + stage + " \"" + cue.text + "\" [" + cue.kind + "]");
  }
  if (loop.hand().repeat && !hand_repeat_) line(loop.time(), "  asks for the direction");
  hand_repeat_ = loop.hand().repeat;
}

void LoopTrace::tell_guidance(double time, const navvi_msgs::Guidance& guidance) {
  const bool other_state = guidance.state != guidance_.state;
  const bool elsewhere = away(guidance.waypoint, guidance_.waypoint) > kMoved;
  if (other_state || elsewhere) {
    const auto report = navvi_types::from_msg(guidance);
    const std::string why = guidance.plans != guidance_.plans && report
                                ? std::string("planned, ") + to_string(report->replan_reason)
                                : std::string("on the way");
    line(time, " * " + why + text(", reroute %u: ", guidance.reroutes) + guidance_text(guidance));
  }
  guidance_ = guidance;
}

void LoopTrace::tell_state(const ClosedLoop& loop) {
  const navvi_sim::physics::RobotState& robot = loop.session().world().now().robot;
  line(loop.time(),
       text("robot %.2f,%.2f heading %.0f, %.2f m/s, %+.0f deg/s | ", robot.position.x(),
            robot.position.y(), kDegrees * robot.yaw, robot.forward_speed(),
            -kDegrees * robot.turn_rate) +
           guidance_text(guidance_) + " | hand " + loop.person().doing() +
           text(", stick %+.2f right %+.2f forward | near ", -loop.hand().left,
                loop.hand().forward) +
           things_text(proximity_) + " | movers " + movers_text(robot, obstacles_) +
           (loop.perceived()
                ? " | seen " + movers_text(robot, navvi_types::to_msg(*loop.perceived()))
                : std::string()));
}

}  // namespace navvi_study::batch
