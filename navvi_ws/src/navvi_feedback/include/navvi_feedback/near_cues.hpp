#pragma once

#include <map>
#include <utility>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_feedback/phrases.hpp"
#include "navvi_feedback/situation.hpp"

namespace navvi_feedback {

struct NearConfig {
  double distance = 1.0;    ///< m, gap
  double close = 0.35;      ///< m, gap
  double hysteresis = 0.2;  ///< m
  double forget = 2.0;      ///< s

  void describe(navvi_config::Visitor& visit);
};

/// Says when a shelf or a wall comes near (R-AUD-3): once a side at `distance`, once more at
/// `close`.
class NearCues {
 public:
  explicit NearCues(const NearConfig& config) : config_(config) {}

  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::vector<Utterance> update(const Situation& now, double time);

 private:
  enum class Level { none, near, close };
  struct Watch {
    Level said = Level::none;
    double last_near = 0.0;  ///< s, when the thing was last within reach
  };

  [[nodiscard]] Level level(double gap, Level said) const;

  NearConfig config_;
  std::map<std::pair<ThingClass, Side>, Watch> watches_;
};

}  // namespace navvi_feedback
