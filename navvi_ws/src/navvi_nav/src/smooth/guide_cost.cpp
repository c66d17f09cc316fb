#include "smooth/guide_cost.hpp"

#include <cstring>

#include "smooth/turns.hpp"

namespace navvi_nav::smooth {
namespace {

constexpr double kTouch = 1e-9;  // m, a point so near to the lines of a polygon is in it
constexpr double kNear = 10.0 * kTouch;
constexpr double kOnMesh = 1e-6;     // m, and an end so near to the mesh on it
constexpr double kShortLeg = 2.0;    // m, a shorter leg between corners costs up to a turn more
constexpr double kSample = 0.3;      // m, between places where clearance is measured
constexpr std::size_t kKept = 1024;  // legs, and points

const Point kNowhere{std::numeric_limits<double>::quiet_NaN(), 0.0};  // equal to no point

std::uint64_t hash_of(std::initializer_list<double> values) {
  std::uint64_t hash = 0;
  for (const double value : values) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    hash = (hash ^ (bits ^ (bits >> 29U))) * 0x9E3779B97F4A7C15U;
  }
  return hash >> 32U;
}

/// Share of the segment from `a` to `b` after which it leaves the polygon for good.
double exit_of(const mesh::Mesh& mesh, int polygon, Point a, Point b) {
  const std::vector<int>& corners = mesh.polygon(polygon).corners;
  double out = 1.0;
  Point from = mesh.at(corners.back());
  for (const int corner : corners) {
    const Point to = mesh.at(corner);
    const Point edge = to - from;
    const double at_b = cross(edge, b - from);
    if (at_b < 0.0 && at_b * at_b > kTouch * kTouch * dot(edge, edge)) {
      const double at_a = cross(edge, a - from);
      out = std::min(out, at_b < at_a ? at_a / (at_a - at_b) : -1.0);
    }
    from = to;
  }
  return out;
}

/// True if the point lies on the portal and not at an end of it.
bool is_within(Point point, Point right, Point left) {
  const Point along = left - right;
  const double length2 = dot(along, along);
  const double slack2 = kNear * kNear * length2;
  const double off = cross(along, point - right);
  const double from_right = dot(along, point - right);
  const double from_left = length2 - from_right;
  return off * off <= slack2 && from_right > 0.0 && from_right * from_right > slack2 &&
         from_left > 0.0 && from_left * from_left > slack2;
}

double gap_in(const map::Space& space, Point at) {
  double gap = space.floor->gap(space.floor->cell_at(at)) + 0.5 * space.floor->cell_size();
  for (const Cylinder& cylinder : *space.cylinders)
    gap = std::min(gap, distance(at, cylinder.center) - cylinder.radius);
  return gap;
}

/// The square of Floor::gap(), cells.
int gap2_in(const map::Floor& floor, Point at) {
  const map::Cell cell = floor.cell_at(at);
  const int x = cell.x - floor.origin().x, y = cell.y - floor.origin().y;
  const bool inside = x >= 0 && y >= 0 && x < floor.columns() && y < floor.rows();
  return inside ? floor.gap2_row(cell.y)[x] : 0;
}

int samples_of(Point a, Point b) {
  return std::max(1, static_cast<int>(std::ceil(distance(a, b) / kSample)));
}

}  // namespace

void GuideCostConfig::describe(navvi_config::Visitor& visit) {
  visit(preferred_clearance, "preferred_clearance", navvi_config::Range{0.0, 2.0}, "m",
        "room a guide path leaves beyond the robot's radius where there is room");
}

/// From polygon to polygon, and at each vertex round the fan of those that meet there.
std::optional<int> covers(const mesh::Mesh& mesh, int polygon, Point a, Point b) {
  const double step = 5.0 * kTouch / std::max(distance(a, b), kTouch);
  double reached = 0.0;
  std::vector<int> fan;
  std::size_t next = 0;
  for (int here = polygon;;) {
    const double exit = exit_of(mesh, here, a, b);
    if (exit >= 1.0) return here;
    const bool on = exit > reached + step;
    if (on) reached = exit;
    const Point at = a + reached * (b - a);
    const std::vector<mesh::Portal>& portals = mesh.polygon(here).portals;
    if (on) {
      fan.clear();
      next = 0;
      const auto across =
          std::find_if(portals.begin(), portals.end(), [&](const mesh::Portal& portal) {
            return is_within(at, mesh.at(portal.right), mesh.at(portal.left));
          });
      if (across != portals.end()) {
        here = across->to;
        continue;
      }
    }
    if (fan.empty()) fan.push_back(here);
    for (const mesh::Portal& portal : portals) {
      if (distance(at, nearest_on_segment(at, mesh.at(portal.right), mesh.at(portal.left))) <=
              kNear &&
          std::find(fan.begin(), fan.end(), portal.to) == fan.end())
        fan.push_back(portal.to);
    }
    if (++next == fan.size()) return std::nullopt;
    here = fan[next];
  }
}

GuideCost::GuideCost(const GuideCostConfig& config, const mesh::Mesh& mesh, const map::Space& space,
                     double radius)
    : config_(config),
      mesh_(mesh),
      space_(space),
      radius_(radius),
      wide_(static_cast<int>(std::ceil(
          std::pow((radius + config.preferred_clearance) / space.floor->cell_size(), 2.0)))),
      cylinders_(*space.cylinders),
      legs_(kKept, {kNowhere, kNowhere, 0.0}),
      placed_(kKept, {kNowhere, std::nullopt}) {
  std::sort(cylinders_.begin(), cylinders_.end(),
            [](const Cylinder& a, const Cylinder& b) { return a.center.x < b.center.x; });
  for (const Cylinder& cylinder : cylinders_) widest_ = std::max(widest_, cylinder.radius);
}

GuideCost::Placed& GuideCost::placed(Point point) const {
  return placed_[hash_of({point.x, point.y}) % kKept];
}

std::optional<int> GuideCost::polygon_at(Point point) const {
  Placed& known = placed(point);
  if (known.point == point) return known.polygon;
  const auto place = mesh_.locate(point, kOnMesh);
  known = {point, place ? std::optional(place->polygon) : std::nullopt};
  return known.polygon;
}

double GuideCost::leg(Point a, Point b, double most) const {
  Leg& known = legs_[hash_of({a.x, a.y, b.x, b.y}) % kKept];
  if (known.a == a && known.b == b) return known.cost;
  const double cost = measure(a, b, most);
  if (cost > most) return kNever;
  const std::optional<int> from = polygon_at(a);
  const std::optional<int> to = from ? covers(mesh_, *from, a, b) : std::nullopt;
  if (to) placed(b) = {b, to};
  known = {a, b, to ? cost : kNever};
  return known.cost;
}

double GuideCost::gap(Point at) const { return gap_in(space_, at); }

template <typename Visit>
void GuideCost::along(Point a, Point b, const Visit& visit) const {
  near_.clear();
  const double far = widest_ + radius_ + preferred();
  const auto first = std::partition_point(
      cylinders_.begin(), cylinders_.end(),
      [&](const Cylinder& cylinder) { return cylinder.center.x < std::min(a.x, b.x) - far; });
  for (auto i = first; i != cylinders_.end() && i->center.x <= std::max(a.x, b.x) + far; ++i) {
    if (distance(i->center, nearest_on_segment(i->center, a, b)) <
        i->radius + radius_ + preferred())
      near_.push_back(*i);
  }
  const int samples = samples_of(a, b);
  const map::Space near{space_.floor, &near_};
  for (int i = 0; i < samples; ++i) {
    const Point at = a + ((i + 0.5) / samples) * (b - a);
    const bool wide = near_.empty() && gap2_in(*space_.floor, at) >= wide_;
    if (!visit(wide ? preferred() : std::max(0.0, gap_in(near, at) - radius_))) return;
  }
}

double GuideCost::measure(Point a, Point b, double most) const {
  const double length = distance(a, b);
  const double step = length / samples_of(a, b);
  double cost = length;
  left_ -= 1.0;
  along(a, b, [&](double spare) {
    left_ -= step;
    if (spare >= preferred()) return true;
    const double missing = 1.0 - spare / preferred();
    cost += step * (config_.kClearanceWeight * missing * missing + tight_price(spare));
    return cost <= most;
  });
  return cost;
}

std::vector<double> GuideCost::near_places(Point a, Point b) const {
  const int samples = samples_of(a, b);
  int i = 0, first = -1, least = 0, last = 0;
  double nearest = preferred();
  along(a, b, [&](double spare) {
    if (spare < preferred()) {
      if (first < 0) first = i;
      last = i;
      if (spare < nearest) {
        nearest = spare;
        least = i;
      }
    }
    ++i;
    return true;
  });
  if (first < 0) return {};
  const auto share = [samples](int k) { return (k + 0.5) / samples; };
  return {share(least), share(first), share(last)};
}

Path GuideCost::known_end(const Path& path) const {
  if (path.size() < 2) return {};
  auto first = path.end() - 1;
  while (first - 1 != path.begin() && std::isfinite(leg(first[-1], first[0]))) --first;
  return {first, path.end()};
}

double GuideCost::tight(const Path& path) const {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step = distance(path[i - 1], path[i]) / samples_of(path[i - 1], path[i]);
    along(path[i - 1], path[i], [&](double spare) {
      if (spare < preferred()) sum += step * tight_price(spare);
      return true;
    });
  }
  return sum;
}

double GuideCost::turn(Point before, Point at, Point after) const {
  static const double at_bend = 0.5 + 0.5 * (1.0 - std::cos(kBend));
  const Point a = at - before;
  const Point b = after - at;
  const double lengths = norm(a) * norm(b);
  if (lengths <= 0.0) return 0.0;
  const double cosine = dot(a, b) / lengths;
  const double sine = std::abs(cross(a, b)) / lengths;
  const bool bend = cosine > 0.0 && sine < std::sin(kBend);
  return config_.kTurnPrice *
         (bend ? at_bend * sine / std::sin(kBend) : 0.5 + 0.5 * (1.0 - cosine));
}

double GuideCost::haste(Point a, Point b) const {
  return config_.kTurnPrice * std::max(0.0, 1.0 - distance(a, b) / kShortLeg);
}

double GuideCost::at_corners(const Path& path) const {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    sum += turn(path[i - 1], path[i], path[i + 1]);
    if (i > 1) sum += haste(path[i - 1], path[i]);
  }
  return sum;
}

double GuideCost::of(const Path& path) const {
  double sum = at_corners(path);
  for (std::size_t i = 1; i < path.size(); ++i) sum += leg(path[i - 1], path[i]);
  return sum;
}

bool GuideCost::less(const Path& path, double than) const {
  if (spent()) return false;
  double least = length_of(path);
  if (least < than) least += at_corners(path);
  for (std::size_t i = 1; i < path.size() && least < than; ++i) {
    const double length = distance(path[i - 1], path[i]);
    least += leg(path[i - 1], path[i], than - least + length) - length;
  }
  return least < than;
}

}  // namespace navvi_nav::smooth
