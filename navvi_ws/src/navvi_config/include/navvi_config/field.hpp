#pragma once

#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace navvi_config {

/// Closed interval of allowed numbers, in the field's unit. Numbers must be finite besides.
struct Range {
  double min = std::numeric_limits<double>::lowest();
  double max = std::numeric_limits<double>::max();
};

/// The allowed words. For a list field, each item must be one of them.
struct OneOf {
  std::vector<std::string> words;
};

/// Any value of the field's type.
struct Any {};

using Allowed = std::variant<Any, Range, OneOf>;

struct Field {
  std::string name;
  Allowed allowed;
  std::string unit;  ///< "m", "rad/s", ...; empty for none
  std::string help;
};

/// Visits the fields of a config struct. A struct describes itself once, and every reader and
/// writer is a visitor:
///
///     struct DriveConfig {
///       double max_speed = 1.0;
///       void describe(navvi_config::Visitor& visit) {
///         visit(max_speed, "max_speed", navvi_config::Range{0.05, 3.0}, "m/s", "at full stick");
///       }
///     };
class Visitor {
 public:
  virtual ~Visitor() = default;

  /// `value` may be a bool, an int, a double, a string, or a vector of doubles or strings.
  template <typename Value>
  void operator()(Value& value, std::string name, Allowed allowed, std::string unit,
                  std::string help) {
    visit({std::move(name), std::move(allowed), std::move(unit), std::move(help)}, value);
  }

  /// A struct within the struct: its fields stand under `name`.
  template <typename Config>
  void group(const std::string& name, Config& config) {
    enter(name);
    config.describe(*this);
    leave();
  }

 protected:
  virtual void visit(const Field& field, bool& value) = 0;
  virtual void visit(const Field& field, int& value) = 0;
  virtual void visit(const Field& field, double& value) = 0;
  virtual void visit(const Field& field, std::string& value) = 0;
  virtual void visit(const Field& field, std::vector<double>& value) = 0;
  virtual void visit(const Field& field, std::vector<std::string>& value) = 0;
  virtual void enter(const std::string& name) = 0;
  virtual void leave() = 0;
};

}  // namespace navvi_config
