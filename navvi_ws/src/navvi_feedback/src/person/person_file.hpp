#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "navvi_config/reader.hpp"

namespace navvi_feedback::person {

/// What one person has set, kept from session to session: parameters of feedback_node, as YAML, in
/// $NAVVI_PEOPLE/NAME.yaml, or else ~/.navvi/people/NAME.yaml.
class PersonFile {
 public:
  /// \param describe  the parameters that the file may hold
  /// \param name  1 to 24 letters, digits, - and _, one of the former two first
  /// \throws navvi_config::ConfigError if the name is another, or no folder is known
  PersonFile(const std::string& name, navvi_config::Describe describe);
  template <typename Config>
  [[nodiscard]] static PersonFile of(const std::string& name) {
    return {name,
            [config = Config()](navvi_config::Visitor& visit) mutable { config.describe(visit); }};
  }

  /// What is in the file; an empty map if there is none.
  /// \throws navvi_config::ConfigError that names file, line, key and what is allowed
  [[nodiscard]] YAML::Node load() const;

  /// Puts values into the file, which tells what each one is; makes it and its folder if need be.
  /// Whatever happens, it holds the old values or the new ones, as a whole.
  /// \param words  such as "speaker/rate:=300"
  /// \throws navvi_config::ConfigError if they, or what is in the file, are not allowed;
  /// std::runtime_error with a sentence if the file cannot be written
  void save(const std::vector<std::string>& words) const;

 private:
  [[nodiscard]] std::string text(const YAML::Node& values) const;

  std::string name_;
  navvi_config::Describe describe_;
  std::filesystem::path path_;
};

}  // namespace navvi_feedback::person
