#include "smooth/smoothing.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/util/Console.h>

#include <array>

namespace navvi_nav::smooth {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr std::uint_fast32_t kSeed = 1;  // the same always: equal input, equal path
constexpr double kRange = 0.3;           // share of the corners that may go at once
constexpr double kGain = 1e-6;           // m, less is rounding
constexpr int kPushes = 5;               // places tried on the way off an obstacle
constexpr double kCoarse[] = {0.6};      // m, steps of corners
constexpr double kFine[] = {0.3, 0.15};

Point unit(Point a) { return norm(a) > 0.0 ? (1.0 / norm(a)) * a : a; }

Point point_of(const ob::State* state) {
  const auto* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1]};
}

/// A motion between two states of a path is valid if the path is cheaper without those between.
class Cheaper : public ob::MotionValidator {
 public:
  Cheaper(const ob::SpaceInformationPtr& information, const std::vector<ob::State*>& states)
      : ob::MotionValidator(information), states_(states) {}
  void judge_by(const GuideCost& cost) { cost_ = &cost; }
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    const auto from = std::find(states_.begin(), states_.end(), a);
    const auto to = std::find(from, states_.end(), b);
    before_.clear();
    after_.clear();
    for (auto i = from - std::min<std::ptrdiff_t>(2, from - states_.begin());
         i != to + std::min<std::ptrdiff_t>(3, states_.end() - to); ++i) {
      before_.push_back(point_of(*i));
      if (i <= from || i >= to) after_.push_back(before_.back());
    }
    return cost_->less(after_, cost_->of(before_) - kGain);
  }
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last_valid) const override {
    last_valid.second = 0.0;
    return checkMotion(a, b);
  }

 private:
  const std::vector<ob::State*>& states_;
  const GuideCost* cost_ = nullptr;
  mutable Path before_, after_;
};

/// Moves corners and adds some as long as that makes the path cheaper.
class Settling {
 public:
  Settling(Path& path, const GuideCost& cost) : path_(path), cost_(cost) {}
  void run(double step) {
    before_ = {};
    for (std::size_t i = 0; i + 1 < path_.size(); ++i) add(i);
    for (std::size_t i = 1; i + 1 < path_.size(); ++i) move(i, step);
  }

 private:
  /// A corner beside one of the places of a leg where it comes near to something, comes nearest,
  /// and leaves it.
  void add(std::size_t i) {
    const Point a = path_[i];
    const Point leg = path_[i + 1] - a;
    if (cost_.leg(a, path_[i + 1]) - norm(leg) < 0.5 * cost_.config().kTurnPrice) return;
    const Point aside = unit({-leg.y, leg.x});
    for (const double share : cost_.near_places(a, path_[i + 1])) {
      for (const double by : {0.2, -0.2}) {
        if (replace(i + 1, 0, {a + share * leg + by * aside})) return;
      }
    }
  }
  /// One corner, or also the next by as much.
  void move(std::size_t i, double step) {
    const Point in = unit(path_[i] - path_[i - 1]);
    const Point out = unit(path_[i + 1] - path_[i]);
    for (const Point way : {unit(in - out), in, out, Point{-out.y, out.x}}) {
      for (const double by : {step, -step}) {
        if (replace(i, 1, {path_[i] + by * way}) ||
            (i + 2 < path_.size() && replace(i, 2, {path_[i] + by * way, path_[i + 1] + by * way})))
          break;
      }
    }
  }
  /// \returns true if it was cheaper to put `points` in the place of `count` corners from `i` on
  bool replace(std::size_t i, std::size_t count, const Path& points) {
    if (cost_.spent()) return false;
    const std::size_t from = i > 2 ? i - 3 : 0;
    const std::size_t to = std::min(path_.size(), i + count + 3);
    const auto at = [this](std::size_t k) {
      return path_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    Before& before = before_[count];
    if (before.i != i) {
      window_.assign(at(from), at(to));
      before = {i, cost_.of(window_)};
    }
    window_.assign(at(from), at(i));
    window_.insert(window_.end(), points.begin(), points.end());
    window_.insert(window_.end(), at(i + count), at(to));
    if (!cost_.less(window_, before.cost - kGain)) return false;
    path_.erase(at(i), at(i + count));
    path_.insert(at(i), points.begin(), points.end());
    before_ = {};
    return true;
  }

  /// What the part of the path costs in which points from `i` on are replaced.
  struct Before {
    std::size_t i = 0;  ///< 0: unknown, as the first point stays
    double cost = 0.0;
  };
  std::array<Before, 3> before_{};  // by the count of points
  Path& path_;
  const GuideCost& cost_;
  Path window_;
};

/// The path with each corner moved off what it turns round, to the preferred clearance or where
/// there is most.
Path pushed(const Path& path, const GuideCost& cost) {
  Path out = path;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Point in = unit(path[i] - path[i - 1]);
    const Point on = unit(path[i + 1] - path[i]);
    const Point off = unit(in - on);
    const double far = cost.preferred() / std::max(0.5, 0.5 * norm(in + on));
    double best = cost.gap(path[i]);
    for (int k = 1; k <= kPushes; ++k) {
      const Point at = path[i] + (far * k / kPushes) * off;
      const double gap = cost.gap(at);
      if (gap <= best + 0.01) continue;
      best = gap;
      out[i] = at;
    }
  }
  for (std::size_t i = 1; i < out.size(); ++i) {  // back where that would leave the mesh
    for (int k = 0; k < 3 && !std::isfinite(cost.leg(out[i - 1], out[i])); ++k) {
      out[i - 1] = 0.5 * (path[i - 1] + out[i - 1]);
      out[i] = 0.5 * (path[i] + out[i]);
    }
  }
  return std::isfinite(cost.of(out)) ? out : path;
}

}  // namespace

void SmoothingConfig::describe(navvi_config::Visitor& visit) {
  visit(enabled, "enabled", navvi_config::Any{}, "", "false: the path is the funnel's");
  cost.describe(visit);
}

/// OMPL leaves out corners.
class Smoother::Simplifier : public og::PathSimplifier {
 public:
  Simplifier() : og::PathSimplifier(information()), states_(si_) {
    cheaper_ = std::make_shared<Cheaper>(si_, states_.getStates());
    si_->setMotionValidator(cheaper_);
    si_->setup();
  }
  void begin(const GuideCost& cost) {
    rng_.setLocalSeed(kSeed);
    cheaper_->judge_by(cost);
  }
  void reduce(Path& path, int attempts) {
    states_.clear();
    ob::ScopedState<ob::RealVectorStateSpace> state(si_->getStateSpace());
    for (const Point point : path) {
      state->values[0] = point.x;
      state->values[1] = point.y;
      states_.append(state.get());
    }
    const auto most =
        static_cast<unsigned int>(attempts) * static_cast<unsigned int>(states_.getStateCount());
    if (!reduceVertices(states_, most, most, kRange)) return;
    path.clear();
    for (const ob::State* at : states_.getStates()) path.push_back(point_of(at));
  }

 private:
  static ob::SpaceInformationPtr information() {
    ompl::msg::noOutputHandler();
    auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
    plane->setBounds(-1.0, 1.0);  // nothing is drawn from it
    auto out = std::make_shared<ob::SpaceInformation>(plane);
    out->setStateValidityChecker([](const ob::State*) { return true; });  // motions are checked
    return out;
  }

  og::PathGeometric states_;
  std::shared_ptr<Cheaper> cheaper_;
};

Smoother::Smoother(int attempts)
    : attempts_(attempts), simplifier_(std::make_unique<Simplifier>()) {}
Smoother::Smoother(Smoother&&) noexcept = default;
Smoother::~Smoother() = default;

Path Smoother::sketch(const Path& path, const GuideCost& cost) const {
  const Path out = settled(path.size() > 2 ? pushed(path, cost) : path, kCoarse, cost);
  return cost.of(out) < cost.of(path) ? out : path;
}

Path Smoother::refine(const Path& path, const GuideCost& cost) const {
  return settled(path, kFine, cost);
}

/// The path when its corners were moved, added and left out, once with each of these steps (m).
template <typename Steps>
Path Smoother::settled(Path path, const Steps& steps, const GuideCost& cost) const {
  Settling settling(path, cost);
  simplifier_->begin(cost);
  for (const double step : steps) {
    settling.run(step);
    if (path.size() > 2 && attempts_ > 0) simplifier_->reduce(path, attempts_);
  }
  return path;
}

}  // namespace navvi_nav::smooth
