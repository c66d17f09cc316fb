#include "read/class_rules.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <navvi_config/reader.hpp>

#include "description/sentence.hpp"
#include "standard_classes.hpp"

namespace navvi_sim::read {
namespace {

constexpr std::size_t kMaxPatterns = 1'000;
constexpr std::size_t kMaxLength = 200;

/// Whether a pattern with * and ? fits all of a text. Goes back to the last * only, so that time
/// grows with the product of both lengths at most.
bool fits(const std::string& pattern, const std::string& text) {
  std::size_t p = 0;
  std::size_t star = std::string::npos;
  std::size_t after = 0;
  for (std::size_t t = 0; t < text.size();) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      after = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string::npos) {
      p = star + 1;
      t = ++after;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

}  // namespace

class RuleReader {
 public:
  explicit RuleReader(std::string source) : source_(std::move(source)) {}

  [[nodiscard]] ClassRules rules(const YAML::Node& list) const {
    if (!list.IsSequence() || list.size() == 0)
      refuse(list, "the rules are not a list; allowed is a list of {class: ..., names: [...]}");
    ClassRules result;
    for (const YAML::Node& item : list) add(item, result);
    return result;
  }

 private:
  [[noreturn]] void refuse(const YAML::Node& node, const std::string& what) const {
    throw WorldError(source_ + ", line " + std::to_string(std::max(0, node.Mark().line) + 1) +
                     ": " + what);
  }

  void add(const YAML::Node& item, ClassRules& result) const {
    if (!item.IsMap() || item.size() != 2 || !item["class"] || !item["names"])
      refuse(item, "a rule has other keys than class and names; allowed are these two, once each");
    const YAML::Node word = item["class"];
    const auto thing_class =
        navvi_types::from_word<ThingClass>(word.IsScalar() ? word.Scalar() : "");
    if (!thing_class)
      refuse(word, "'" + (word.IsScalar() ? word.Scalar() : "") + "' is not a class; allowed are " +
                       thing_class_words());
    const YAML::Node names = item["names"];
    if (!names.IsSequence() || names.size() == 0)
      refuse(names,
             "names is not a list; allowed is a list of one pattern or more, such as "
             "[\"*shelf*\"]");
    for (const YAML::Node& name : names) {
      if (!name.IsScalar() || name.Scalar().empty() || name.Scalar().size() > kMaxLength)
        refuse(name, "a pattern is not a word; allowed are 1 to " + std::to_string(kMaxLength) +
                         " characters");
      if (result.rules_.size() >= kMaxPatterns)
        refuse(name, "there are more than " + std::to_string(kMaxPatterns) +
                         " patterns; allowed is up to that");
      result.rules_.push_back({lower_case(name.Scalar()), *thing_class});
    }
  }

  std::string source_;
};

const ClassRules& ClassRules::standard() {
  static const ClassRules rules =
      RuleReader("config/classes.yaml").rules(YAML::Load(kStandardClasses));
  return rules;
}

ClassRules ClassRules::read(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw WorldError("the class rules " + file.string() +
                     " do not exist or are not a file; allowed is a YAML file");
  try {
    return RuleReader(file.string()).rules(navvi_config::load_yaml(file));
  } catch (const navvi_config::ConfigError& problem) {
    throw WorldError(problem.what());
  } catch (const YAML::Exception& problem) {
    throw WorldError(file.string() + ", line " + std::to_string(problem.mark.line + 1) +
                     ": cannot parse the rules as YAML: " + problem.msg);
  }
}

std::optional<ThingClass> ClassRules::match(const std::string& name,
                                            std::optional<ThingClass> not_this) const {
  const std::string plain = lower_case(name);
  for (const Rule& rule : rules_)
    if (rule.thing_class != not_this && fits(rule.pattern, plain)) return rule.thing_class;
  return std::nullopt;
}

}  // namespace navvi_sim::read
