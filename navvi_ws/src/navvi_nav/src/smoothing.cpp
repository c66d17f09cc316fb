#include "navvi_nav/smoothing.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/objectives/StateCostIntegralObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/util/Console.h>

#include "navvi_nav/waypoints.hpp"

namespace navvi_nav {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr std::uint_fast32_t kSeed = 1;  // the same always: equal input, equal path
constexpr double kSpacing = 1.0;         // m, between points that may be moved
constexpr std::size_t kMaxStations = 25;

using State = ob::RealVectorStateSpace::StateType;

Point point_of(const ob::State* state) {
  const auto* values = state->as<State>()->values;
  return {values[0], values[1]};
}

class Validity : public ob::StateValidityChecker {
 public:
  Validity(const ob::SpaceInformationPtr& information, const Space& space, const Room& room)
      : ob::StateValidityChecker(information), space_(space), room_(room) {}
  bool isValid(const ob::State* state) const override {
    const Point point = point_of(state);
    return space_.segment_clear(point, point, room_.radius);
  }
  double clearance(const ob::State* state) const override {
    return space_.clearance(point_of(state)) - room_.radius;
  }

 private:
  Space space_;
  Room room_;
};

class Motion : public ob::MotionValidator {
 public:
  Motion(const ob::SpaceInformationPtr& information, const Space& space, const Room& room)
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
  Space space_;
  Room room_;
};

/// guide_cost as OMPL sees it.
class Clearance : public ob::OptimizationObjective {
 public:
  Clearance(const ob::SpaceInformationPtr& information, const Space& space, const Room& room,
            const SmoothingConfig& config)
      : ob::OptimizationObjective(information), space_(space), room_(room), config_(config) {}
  ob::Cost stateCost(const ob::State*) const override { return ob::Cost(1.0); }
  ob::Cost motionCost(const ob::State* a, const ob::State* b) const override {
    return ob::Cost(guide_cost({point_of(a), point_of(b)}, space_, room_, config_));
  }

 private:
  Space space_;
  Room room_;
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

ob::SpaceInformationPtr information_of(const Space& space, const Room& room) {
  const Floor& floor = *space.floor;
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
  information->setStateValidityChecker(std::make_shared<Validity>(information, space, room));
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

bool acceptable(const Path& path, const Path& original, const Space& space, const Room& room,
                double longest) {
  return path.size() >= 2 && path.front() == original.front() && path.back() == original.back() &&
         std::all_of(path.begin(), path.end(), [](Point p) { return finite(p); }) &&
         length_of(path) <= longest && clear(path, space, room.radius);
}

Path shortened(const Path& path, const ob::SpaceInformationPtr& information, unsigned int steps) {
  og::PathGeometric out = to_ompl(path, information);
  Simplifier simplifier(information,
                        std::make_shared<ob::PathLengthOptimizationObjective>(information));
  simplifier.reduceVertices(out, steps, steps);
  simplifier.shortcutPath(out, steps, steps, 0.33, 0.005);
  return from_ompl(out);
}

Path moved_away(const Path& path, const ob::SpaceInformationPtr& information, const Space& space,
                const Room& room, const SmoothingConfig& config) {
  og::PathGeometric out = to_ompl(path, information);
  Simplifier simplifier(information, std::make_shared<Clearance>(information, space, room, config));
  const auto steps = static_cast<unsigned int>(config.steps);
  simplifier.perturbPath(out, room.preferred, steps, steps);
  return from_ompl(out);
}

}  // namespace

void SmoothingConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"enabled", navvi_config::Any{}, "", "false: the path is the funnel's"}, enabled);
  visit({"steps", Range{1, 10000}, "", "upper limit of each of OMPL's loops"}, steps);
  visit({"clearance_weight", Range{0.0, 100.0}, "",
         "how much dearer a metre without any preferred clearance is"},
        clearance_weight);
  visit({"turn_price", Range{0.0, 20.0}, "m", "length a path may gain to save one turn"},
        turn_price);
  visit({"max_stretch", Range{1.0, 5.0}, "", "longest smoothed path, times the funnel's"},
        max_stretch);
  visit({"max_detour", Range{0.0, 20.0}, "m", "or so much longer than the funnel's"}, max_detour);
}

Path smooth(const Path& path, const Space& space, const Room& room, const SmoothingConfig& config) {
  if (!config.enabled || path.size() < 2) return path;
  ompl::msg::noOutputHandler();
  const double shortest = length_of(path);
  const double longest = std::max(config.max_stretch * shortest, shortest + config.max_detour);
  const auto information = information_of(space, room);
  const auto steps = static_cast<unsigned int>(config.steps);

  Path best = path;
  const Path shorter = shortened(path, information, steps);
  if (acceptable(shorter, path, space, room, shortest + 1e-9)) best = shorter;
  if (room.preferred <= 0.0) return best;

  const double spacing = std::max(kSpacing, length_of(best) / kMaxStations);
  const Path roomy =
      moved_away(dense(push_corners(best, space, room), spacing), information, space, room, config);
  const Path guide = choose_waypoints(candidates_along(roomy, space, room), space, room, config);
  if (acceptable(guide, path, space, room, longest)) return guide;
  return best;
}

}  // namespace navvi_nav
