#pragma once

#include <string>
#include <vector>

#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::people {

/// A trait in which people differ; doc/people.md tells the source of its numbers.
struct Trait {
  const char* name;  ///< of the parameter
  double& (*of)(SimulatedOperatorConfig&);
  double able, typical, struggling;  ///< the parameter of these types
  /// Of the drawn: lognormal around the typical with this standard deviation of the logarithm.
  double between;
  const char* unit;
};

[[nodiscard]] const std::vector<Trait>& traits();

/// The words that person/type takes.
[[nodiscard]] const std::vector<std::string>& person_types();

}  // namespace navvi_people::people
