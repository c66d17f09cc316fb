#include "batch/stand_figures.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_study::batch {
namespace {

constexpr double kStay = 0.3;    // m; who does not leave this circle stands still
constexpr double kInVain = 3.0;  // s
constexpr double kPushed = 0.2;  // of the stick
constexpr double kStill = 0.05;  // m/s and rad/s

}  // namespace

void StandFigures::watch(const navvi_people::loop::ClosedLoop& loop, double time,
                         const std::string& about) {
  push(loop);
  const Eigen::Vector2d& at = loop.session().world().now().robot.position;
  if (time - stay_since_ > still_) {
    still_ = time - stay_since_;
    still_at_ = stay_since_;
    why_ = about;
  }
  if ((at - stay_).norm() <= kStay) return;
  stay_ = at;
  stay_since_ = time;
}

/// A person who pushes in vain, and hears nothing, does not know why.
void StandFigures::push(const navvi_people::loop::ClosedLoop& loop) {
  const navvi_sim::physics::RobotState& robot = loop.session().world().now().robot;
  const bool pushes = std::max(std::abs(loop.hand().forward), std::abs(loop.hand().left)) > kPushed;
  const bool still = std::abs(robot.forward_speed()) < kStill && std::abs(robot.turn_rate) < kStill;
  if (!pushes || !still) pushed_.reset();
  if (!pushed_ && pushes && still) pushed_ = loop.time();
  if (!pushed_ || loop.time() - *pushed_ < kInVain) return;
  ++speechless_;
  pushed_ = loop.time();
}

void StandFigures::add_to(record::Fields& row) const {
  row.set("still", still_, 1).set("still_at", still_at_, 1).set("why", why_);
}

}  // namespace navvi_study::batch
