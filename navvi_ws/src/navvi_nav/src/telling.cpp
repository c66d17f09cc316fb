#include "navvi_nav/telling.hpp"

namespace navvi_nav {
namespace {

constexpr double kPeriod = 0.09;  // s; a little less than 0.1, so that no beat of 20 Hz is missed

bool leads_elsewhere(const Status& a, const Status& b) {
  return a.state != b.state || a.refusal != b.refusal || a.plans != b.plans ||
         !(a.heading.waypoint == b.heading.waypoint);
}

}  // namespace

bool Telling::due(const Status& status, double time) {
  if (told_ && !leads_elsewhere(*told_, status) && time - told_at_ < kPeriod) return false;
  told_ = status;
  told_at_ = time;
  return true;
}

}  // namespace navvi_nav
