#include "guide/publish_throttle.hpp"

#include <algorithm>

namespace navvi_nav::guide {
namespace {

constexpr double kPeriod = 0.09;  // s; a little less than 0.1, so that no tick of 20 Hz is missed
constexpr double kPolygonsPerSecond = 4000.0;  // of pictures of the mesh, some 200 bytes each

bool leads_elsewhere(const Guidance& a, const Guidance& b) {
  return a.state != b.state || a.refusal != b.refusal || a.plans != b.plans ||
         a.waypoint != b.waypoint;
}

}  // namespace

bool PublishThrottle::due(const Guidance& guidance, double time) {
  if (last_ && !leads_elsewhere(*last_, guidance) && time - last_time_ < kPeriod) return false;
  last_ = guidance;
  last_time_ = time;
  return true;
}

bool MeshThrottle::due(double time) const {
  const double period = std::max(period_, static_cast<double>(polygons_) / kPolygonsPerSecond);
  return !last_time_ || time - *last_time_ >= period;
}

void MeshThrottle::published(std::size_t polygons, double time) {
  polygons_ = polygons;
  last_time_ = time;
}

}  // namespace navvi_nav::guide
