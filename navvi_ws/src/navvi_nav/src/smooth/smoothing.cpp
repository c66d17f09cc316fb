#include "smooth/smoothing.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/util/Console.h>

#include "smooth/waypoints.hpp"

namespace navvi_nav::smooth {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr std::uint_fast32_t kSeed = 1;  // the same always: equal input, equal path
constexpr double kSample = 0.2;          // m, between places where guide_cost looks
constexpr double kStride = 0.6;          // m, farthest that OMPL moves a point at once
constexpr double kRange = 0.5;           // share of the path that one shortcut may replace
constexpr double kSnap = 0.1;            // share of the path within which a corner is meant

using State = ob::RealVectorStateSpace::StateType;

Point point_of(const ob::State* state) {
  const auto* values = state->as<State>()->values;
  return {values[0], values[1]};
}

class Motion : public ob::MotionValidator {
 public:
  Motion(const ob::SpaceInformationPtr& information, const map::Space& space,
         const Clearances& room)
      : ob::MotionValidator(information), space_(space), room_(room) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return space_.segment_clear(point_of(a), point_of(b), room_.radius);
  }
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last_valid) const override {
    if (checkMotion(a, b)) return true;
    last_valid.second = 0.0;
    if (last_valid.first) si_->copyState(last_valid.first, a);
    return false;
  }

 private:
  map::Space space_;
  Clearances room_;
};

/// guide_cost and turn_price as OMPL sees them: each motion costs its leg and one turn.
class GuideCost : public ob::OptimizationObjective {
 public:
  GuideCost(const ob::SpaceInformationPtr& information, const map::Space& space,
            const Clearances& room, const SmoothingConfig& config)
      : ob::OptimizationObjective(information), space_(space), room_(room), config_(config) {}
  ob::Cost stateCost(const ob::State*) const override { return ob::Cost(0.0); }
  ob::Cost motionCost(const ob::State* a, const ob::State* b) const override {
    return ob::Cost(guide_cost({point_of(a), point_of(b)}, space_, room_, config_) +
                    config_.turn_price);
  }

 private:
  map::Space space_;
  Clearances room_;
  SmoothingConfig config_;
};

class Sampler : public ob::RealVectorStateSampler {
 public:
  explicit Sampler(const ob::StateSpace* space) : ob::RealVectorStateSampler(space) {
    rng_.setLocalSeed(kSeed);
  }
};

class Simplifier : public og::PathSimplifier {
 public:
  Simplifier(const ob::SpaceInformationPtr& information, const ob::OptimizationObjectivePtr& cost)
      : og::PathSimplifier(information, ob::GoalPtr(), cost) {
    rng_.setLocalSeed(kSeed);
  }
};

ob::SpaceInformationPtr information_of(const map::Space& space, const Clearances& room) {
  const map::Floor& floor = *space.floor;
  auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds bounds(2);
  const double cell = floor.cell_size();
  bounds.setLow(0, floor.origin().x * cell);
  bounds.setLow(1, floor.origin().y * cell);
  bounds.setHigh(0, (floor.origin().x + floor.columns()) * cell);
  bounds.setHigh(1, (floor.origin().y + floor.rows()) * cell);
  plane->setBounds(bounds);
  plane->setStateSamplerAllocator(
      [](const ob::StateSpace* of) { return std::make_shared<Sampler>(of); });
  auto information = std::make_shared<ob::SpaceInformation>(plane);
  information->setStateValidityChecker([space, room](const ob::State* state) {
    return space.segment_clear(point_of(state), point_of(state), room.radius);
  });
  information->setMotionValidator(std::make_shared<Motion>(information, space, room));
  information->setup();
  return information;
}

og::PathGeometric to_ompl(const Path& path, const ob::SpaceInformationPtr& information) {
  og::PathGeometric out(information);
  ob::ScopedState<ob::RealVectorStateSpace> state(information->getStateSpace());
  for (const Point point : path) {
    state->values[0] = point.x;
    state->values[1] = point.y;
    out.append(state.get());
  }
  return out;
}

Path from_ompl(const og::PathGeometric& path) {
  Path out;
  for (std::size_t i = 0; i < path.getStateCount(); ++i)
    out.push_back(point_of(path.getState(static_cast<unsigned int>(i))));
  return out;
}

/// OMPL moves points of the path at random and keeps what is cheaper, then leaves out the corners
/// that do not pay.
Path polished(const Path& path, const map::Space& space, const Clearances& room,
              const SmoothingConfig& config) {
  ompl::msg::noOutputHandler();
  const auto information = information_of(space, room);
  og::PathGeometric out = to_ompl(path, information);
  const auto steps = static_cast<unsigned int>(config.steps);
  SmoothingConfig any_turns = config;
  any_turns.turn_price = 0.0;
  Simplifier mover(information, std::make_shared<GuideCost>(information, space, room, any_turns));
  mover.perturbPath(out, kStride, steps, steps);
  Simplifier saver(information, std::make_shared<GuideCost>(information, space, room, config));
  saver.shortcutPath(out, steps, steps, kRange, kSnap);
  return from_ompl(out);
}

/// What the path is measured by: guide_cost and one turn_price for each leg.
double person_cost(const Path& path, const map::Space& space, const Clearances& room,
                   const SmoothingConfig& config) {
  return guide_cost(path, space, room, config) +
         config.turn_price * static_cast<double>(path.size());
}

/// The cylinders that may matter to a path within room.preferred of this one.
std::vector<Cylinder> cylinders_near(const Path& path, const map::Space& space,
                                     const Clearances& room) {
  Point low = path.front();
  Point high = low;
  for (const Point point : path) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  std::vector<Cylinder> out;
  for (const Cylinder& cylinder : *space.cylinders) {
    const double reach = cylinder.radius + 2.0 * (room.radius + std::max(room.preferred, 0.6));
    const Point at = cylinder.center;
    if (at.x > low.x - reach && at.x < high.x + reach && at.y > low.y - reach &&
        at.y < high.y + reach)
      out.push_back(cylinder);
  }
  return out;
}

}  // namespace

void SmoothingConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(enabled, "enabled", navvi_config::Any{}, "", "false: the path is the funnel's");
  visit(steps, "steps", Range{0, 10000}, "", "upper limit of each of OMPL's two loops");
  visit(clearance_weight, "clearance_weight", Range{0.0, 100.0}, "",
        "how much dearer a metre without any preferred clearance is");
  visit(turn_price, "turn_price", Range{0.0, 20.0}, "m", "length a path may gain to save one turn");
  visit(short_leg, "short_leg", Range{0.1, 10.0}, "m",
        "a leg shorter than this costs up to one turn_price more");
  visit(max_stretch, "max_stretch", Range{1.0, 5.0}, "",
        "longest smoothed path, times the shortest");
  visit(max_detour, "max_detour", Range{0.0, 20.0}, "m", "or so much longer than the shortest");
}

double guide_cost(const Path& path, const map::Space& space, const Clearances& room,
                  const SmoothingConfig& config) {
  if (room.preferred <= 0.0 || config.clearance_weight <= 0.0) return length_of(path);
  double sum = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Point leg = path[k] - path[k - 1];
    const double length = norm(leg);
    const int samples = std::max(1, static_cast<int>(std::ceil(length / kSample)));
    double prices = 0.0;
    for (int i = 0; i < samples; ++i) {
      const Point at = path[k - 1] + ((i + 0.5) / samples) * leg;
      double gap = space.floor->gap(space.floor->cell_at(at));
      for (const Cylinder& cylinder : *space.cylinders)
        gap = std::min(gap, distance(at, cylinder.center) - cylinder.radius);
      const double missing = room.missing(gap);
      prices += 1.0 + config.clearance_weight * missing * missing;
    }
    sum += length * prices / samples;
  }
  return sum;
}

Path smooth(const Path& path, const map::Space& space, const Clearances& room,
            const SmoothingConfig& config) {
  const double shortest = length_of(path);
  if (!config.enabled || shortest <= 0.0 || !clear(path, space, room.radius)) return path;
  const std::vector<Cylinder> cylinders = cylinders_near(path, space, room);
  const map::Space near{space.floor, &cylinders};
  const double longest = std::max(config.max_stretch * shortest, shortest + config.max_detour);
  const Channel channel(path, near, room);
  Path best = path;
  double cost = person_cost(path, near, room, config);
  const auto offer = [&](const Path& fresh) {
    if (fresh.size() < 2 || !channel.holds(fresh) || length_of(fresh) > longest) return;
    const double price = person_cost(fresh, near, room, config);
    if (price >= cost || !clear(fresh, space, room.radius)) return;
    best = fresh;
    cost = price;
  };
  offer(choose_waypoints(channel, near, room.radius, config));
  if (config.steps > 0) offer(polished(best, near, room, config));
  return best;
}

}  // namespace navvi_nav::smooth
