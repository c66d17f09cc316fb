#pragma once

#include <navvi_types/random.hpp>
#include <string>
#include <vector>

#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::people {

/// A trait in which people differ, and what is known of it.
struct Trait {
  const char* name;  ///< of the parameter
  double& (*of)(SimulatedOperatorConfig&);
  double able, typical, struggling;  ///< the parameter of these types
  /// Of the drawn: lognormal around the typical with this standard deviation of the logarithm.
  double between;
  const char* unit;
  const char* source;   ///< publication, or "assumed"
  const char* people;   ///< who was measured
  const char* carried;  ///< over to a stick
};

[[nodiscard]] const std::vector<Trait>& traits();

/// The words that person/type takes.
[[nodiscard]] const std::vector<std::string>& person_types();

/// Gives a person the traits of its type; `drawn` ones are drawn from its seed: persons first, then
/// what each does. \param share  true: a share stays below 1
void become(SimulatedOperatorConfig& config, const std::string& type, int seed);

/// The table of doc/people.md, in Markdown.
[[nodiscard]] std::string traits_table();

}  // namespace navvi_people::people
