#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::read {

/// Tells what a model that others named is, by ordered patterns for its name.
class ClassRules {
 public:
  /// The rules of config/classes.yaml, built in.
  [[nodiscard]] static const ClassRules& standard();

  /// Reads a list of {class: WORD, names: [PATTERN, ...]}. In a pattern, * stands for any
  /// characters and ? for one.
  /// \throws WorldError with file, line, what is wrong and what is allowed
  [[nodiscard]] static ClassRules read(const std::filesystem::path& file);

  /// The first rule with a pattern that fits the whole of `name`, whatever its case, other than
  /// those for the class `not_this`, gives the class; nullopt: none fits.
  [[nodiscard]] std::optional<ThingClass> match(
      const std::string& name, std::optional<ThingClass> not_this = std::nullopt) const;

 private:
  friend class RuleReader;
  struct Rule {
    std::string pattern;  ///< in lower case
    ThingClass thing_class;
  };
  std::vector<Rule> rules_;
};

}  // namespace navvi_sim::read
