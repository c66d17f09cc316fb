#include "navvi_config/reader.hpp"

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "navvi_config/cited.hpp"
#include "navvi_files/json.hpp"
#include "removed_keys.hpp"

namespace navvi_config {
namespace {

constexpr std::uintmax_t kLargestFile = 1 << 20;  // bytes

std::string to_text(double number) {
  std::ostringstream out;
  if (number == std::round(number) && std::abs(number) < 1e15)
    out << std::fixed << std::setprecision(0);
  out << number;
  return out.str();
}

/// Of the words, the one that is at most two letters, and half of it, off; empty where none is.
std::string nearest(const std::string& word, const std::set<std::string>& words) {
  std::string found;
  std::size_t least = std::min<std::size_t>(3, word.size() / 2 + 1);
  for (const std::string& other : words) {
    std::vector<std::size_t> row(other.size() + 1);  // of Levenshtein's distances
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t corner = std::exchange(row[0], i + 1);
      for (std::size_t j = 0; j < other.size(); ++j)
        corner = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1,
                                                     corner + (word[i] == other[j] ? 0 : 1)}));
    }
    if (row.back() < least) std::tie(least, found) = std::pair(row.back(), other);
  }
  return found;
}

template <typename Items>
std::string join(const Items& items) {
  std::ostringstream out;
  for (const auto& item : items) out << (out.tellp() > 0 ? ", " : "") << item;
  return out.str();
}

std::string allowed_text(const Field& field) {
  if (const auto* range = std::get_if<Range>(&field.allowed)) {
    const std::string unit = field.unit.empty() ? "" : " " + field.unit;
    const Range all;
    if (range->max == all.max && range->min == all.min) return "a finite number";
    if (range->max == all.max) return to_text(range->min) + unit + " or more";
    return to_text(range->min) + " to " + to_text(range->max) + unit;
  }
  if (const auto* one_of = std::get_if<OneOf>(&field.allowed))
    return "one of " + join(one_of->words);
  return "";
}

/// Where a document begins: at its mark, and with its first content.
class Beginning : public YAML::EventHandler {
 public:
  [[nodiscard]] const YAML::Mark& mark() const { return mark_; }
  [[nodiscard]] int content_line() const { return 1 + (content_ ? *content_ : mark_.line); }

  void OnDocumentStart(const YAML::Mark& mark) override { mark_ = mark; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { at(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { at(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string&) override {
    at(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    at(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    at(mark);
  }
  void OnMapEnd() override {}

 private:
  void at(const YAML::Mark& mark) {
    if (!content_) content_ = mark.line;
  }

  YAML::Mark mark_ = YAML::Mark::null_mark();
  std::optional<int> content_;
};

/// Takes the value of each described field from the map at the present depth, and remembers the
/// keys that fields have, so that it can refuse all others.
class YamlReader : public Visitor {
 public:
  YamlReader(const YAML::Node& node, std::string source, Removed removed)
      : source_(std::move(source)), removed_(removed) {
    push(node, "");
  }

  void visit(const Field& field, bool& value) override { take(field, value); }
  void visit(const Field& field, int& value) override { take(field, value); }
  void visit(const Field& field, double& value) override { take(field, value); }
  void visit(const Field& field, std::string& value) override { take(field, value); }
  void visit(const Field& field, std::vector<double>& value) override { take(field, value); }
  void visit(const Field& field, std::vector<std::string>& value) override { take(field, value); }

  /// Refuses keys that no field has at the present depth.
  void finish() {
    const Level& level = levels_.back();
    std::set<std::string> seen;
    for (const auto& pair : level.node) {
      const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "(not a word)";
      if (!level.known.count(key)) {
        if (removed_keys().count(level.prefix + key) != 0) {
          if (removed_ == Removed::refused)
            throw ConfigError(where(pair.first) + ": the key \"" + level.prefix + key +
                              "\" is of an earlier version, and its value is fixed now.");
          std::cerr << "navvi: " << where(pair.first) << ": \"" << level.prefix << key
                    << "\" is of an earlier version and is ignored.\n";
          continue;
        }
        const std::string meant = nearest(cited(key), level.known);
        throw ConfigError(where(pair.first) + ": the key \"" + level.prefix + cited(key) +
                          "\" is unknown; " + (meant.empty() ? "" : "nearest is " + meant + "; ") +
                          "known here are " + join(level.known) + ".");
      }
      if (!seen.insert(key).second)
        throw ConfigError(where(pair.first) + ": the key \"" + level.prefix + key +
                          "\" is given twice.");
    }
  }

 protected:
  void enter(const std::string& name) override {
    const YAML::Node node = find(name);
    push(node ? node : YAML::Node(YAML::NodeType::Map), levels_.back().prefix + name + "/");
  }
  void leave() override {
    finish();
    levels_.pop_back();
  }

 private:
  struct Level {
    YAML::Node node;
    std::string prefix;
    std::set<std::string> known;
  };

  void push(const YAML::Node& node, const std::string& prefix) {
    if (node.IsNull() || node.IsMap()) {
      levels_.push_back({node.IsMap() ? node : YAML::Node(YAML::NodeType::Map), prefix, {}});
      return;
    }
    throw ConfigError(where(node) + ": there must be a map of keys and values" +
                      (prefix.empty() ? "." : " under \"" + prefix + "\"."));
  }

  [[nodiscard]] std::string where(const YAML::Node& node) const {
    const YAML::Mark mark = node.Mark();
    return mark.is_null() ? source_ : source_ + ", line " + std::to_string(mark.line + 1);
  }

  YAML::Node find(const std::string& name) {
    Level& level = levels_.back();
    level.known.insert(name);
    for (const auto& pair : level.node) {  // operator[] would hide a repeated key
      if (pair.first.IsScalar() && pair.first.Scalar() == name) return pair.second;
    }
    return YAML::Node(YAML::NodeType::Undefined);
  }

  [[noreturn]] void refuse(const Field& field, const YAML::Node& node,
                           const std::string& allowed) const {
    const std::string given = node.IsScalar() ? cited(node.Scalar())
                              : node.IsNull() ? "nothing"
                                              : "a list or map";
    throw ConfigError(where(node) + ": \"" + levels_.back().prefix + field.name + "\" is " + given +
                      "; allowed is " + allowed + ".");
  }

  template <typename Value>
  void take(const Field& field, Value& value) {
    if (const YAML::Node node = find(field.name)) decode(field, node, value);
  }

  template <typename Value>
  void decode(const Field& field, const YAML::Node& node, Value& value,
              const std::string& allowed) const {
    if (!YAML::convert<Value>::decode(node, value)) refuse(field, node, allowed);
  }
  void decode(const Field& field, const YAML::Node& node, bool& value) const {
    decode(field, node, value, "true or false");
  }
  void decode(const Field& field, const YAML::Node& node, int& value) const {
    const std::string range = allowed_text(field);
    const std::string whole = "a whole number" + (range.empty() ? "" : ", " + range);
    decode(field, node, value, whole);
    const std::string digits = node.Scalar().substr(node.Scalar().find_first_not_of("+-"));
    const bool octal = digits.front() == '0' && digits.find_first_not_of('0') != digits.npos;
    if (octal) refuse(field, node, whole);
    check(field, node, value);
  }
  void decode(const Field& field, const YAML::Node& node, double& value) const {
    decode(field, node, value, "a number");
    check(field, node, value);
  }
  void decode(const Field& field, const YAML::Node& node, std::string& value) const {
    decode(field, node, value, "a text");
    const auto* one_of = std::get_if<OneOf>(&field.allowed);
    if (one_of && std::count(one_of->words.begin(), one_of->words.end(), value) == 0)
      refuse(field, node, allowed_text(field));
  }
  template <typename Item>
  void decode(const Field& field, const YAML::Node& node, std::vector<Item>& value) const {
    if (!node.IsSequence()) refuse(field, node, "a list such as [a, b]");
    value.clear();
    for (const auto& item : node) decode(field, item, value.emplace_back());
  }

  void check(const Field& field, const YAML::Node& node, double number) const {
    const auto* range = std::get_if<Range>(&field.allowed);
    const Range limits = range ? *range : Range{};
    if (!std::isfinite(number) || number < limits.min || number > limits.max)
      refuse(field, node, range ? allowed_text(field) : "a finite number");
  }

  std::string source_;
  Removed removed_;
  std::vector<Level> levels_;
};

class TableWriter : public Visitor {
 public:
  void visit(const Field& field, bool& value) override {
    add(field, value ? "true" : "false");
    rows.back().allowed = "true or false";
  }
  void visit(const Field& field, int& value) override { add(field, std::to_string(value)); }
  void visit(const Field& field, double& value) override { add(field, to_text(value)); }
  void visit(const Field& field, std::string& value) override { add(field, value); }
  void visit(const Field& field, std::vector<double>& value) override {
    add(field, "[" + join(value) + "]");
  }
  void visit(const Field& field, std::vector<std::string>& value) override {
    add(field, "[" + join(value) + "]");
  }

  std::vector<Row> rows;

 protected:
  void enter(const std::string& name) override { groups_.push_back(groups_.back() + name + "/"); }
  void leave() override { groups_.pop_back(); }

 private:
  void add(const Field& field, const std::string& value) {
    rows.push_back({groups_.back() + field.name, value, allowed_text(field), field.help});
  }

  std::vector<std::string> groups_ = {""};
};

}  // namespace

std::string cited(const std::string& text) {
  constexpr std::size_t kMost = 60;  // bytes
  if (text.size() <= kMost) return text;
  std::size_t end = kMost - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // of UTF-8
  return text.substr(0, end) + "...";
}

YAML::Node load_yaml(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error)
    throw ConfigError("\"" + path.string() + "\" cannot be read: " + error.message() + ".");
  if (size > kLargestFile)
    throw ConfigError("\"" + path.string() + "\" is larger than 1 MiB, the most allowed.");
  std::ifstream file(path);
  if (!file || file.peek() == std::ifstream::traits_type::eof()) {
    if (size == 0) return YAML::Node();
    throw ConfigError("\"" + path.string() + "\" cannot be read.");
  }
  const auto not_yaml = [&](const YAML::Exception& problem, const std::string& why) {
    return ConfigError(path.string() + ", line " + std::to_string(problem.mark.line + 1) +
                       ": this is not YAML: " + why + ".");
  };
  try {
    // LoadAll() would make documents without end of a file whose first sign opens none.
    YAML::Parser parser(file);
    Beginning first, second;
    if (!parser.HandleNextDocument(first)) return YAML::Node();
    if (parser.HandleNextDocument(second)) {
      if (second.mark().pos == first.mark().pos)
        throw YAML::ParserException(first.mark(), "nothing can begin with this sign");
      throw ConfigError(path.string() + ", line " + std::to_string(second.content_line()) +
                        ": a second document begins; allowed is one in a file.");
    }
    file.clear();
    file.seekg(0);
    return YAML::Load(file);
  } catch (const YAML::DeepRecursion& problem) {
    throw not_yaml(problem, "it is nested too deep");
  } catch (const YAML::Exception& problem) {
    throw not_yaml(problem, cited(problem.msg));
  }
}

YAML::Node read_words(const std::vector<std::string>& words) {
  YAML::Node all(YAML::NodeType::Map);
  for (const std::string& word : words) {
    const std::size_t split = word.find(":=");
    const std::string name = "/" + word.substr(0, split) + "/";  // no key in it may be empty
    if (split == std::string::npos || name.find("//") != std::string::npos)
      throw ConfigError("\"" + word + "\" is not a parameter; parameters look like name:=value.");
    YAML::Node map = all;
    std::istringstream keys(word.substr(0, split));
    std::string key, last;
    std::getline(keys, last, '/');
    while (std::getline(keys, key, '/')) {
      if (map[last] && !map[last].IsMap())
        throw ConfigError("\"" + last + "\" is given both as a value and as a group.");
      map.reset(map[last]);
      last = key;
    }
    if (map[last]) throw ConfigError("\"" + word.substr(0, split) + "\" is given twice.");
    const std::string value = word.substr(split + 2);
    if (!value.empty() && value.front() == '[') {
      try {
        map[last] = YAML::Load(value);
      } catch (const YAML::Exception&) {
        throw ConfigError("\"" + word + "\" holds no list; allowed is a list such as [a, b].");
      }
    } else {
      map[last] = value;
    }
  }
  return all;
}

void overlay(YAML::Node base, const YAML::Node& values) {
  for (const auto& pair : values) {
    const std::string& key = pair.first.Scalar();
    if (pair.second.IsMap() && base[key].IsMap())
      overlay(base[key], pair.second);
    else
      base[key] = pair.second;
  }
}

void read_fields(const Describe& describe, const YAML::Node& node, const std::string& source,
                 Removed removed) {
  YamlReader reader(node, source, removed);
  describe(reader);
  reader.finish();
}

std::string json(const std::vector<Row>& rows) {
  using navvi_files::json_text;
  std::vector<std::string> objects;
  for (const Row& row : rows) {
    objects.push_back(navvi_files::json_object({{"parameter", json_text(row.key)},
                                   {"default", json_text(row.default_value)},
                                   {"allowed", json_text(row.allowed)},
                                   {"meaning", json_text(row.help)}}));
  }
  return navvi_files::json_list(objects);
}

std::vector<Row> table_of(const Describe& describe) {
  TableWriter writer;
  describe(writer);
  return writer.rows;
}

std::string one_line(const YAML::Node& node) {
  YAML::Emitter out;
  out.SetMapFormat(YAML::Flow);
  out.SetSeqFormat(YAML::Flow);
  out << node;
  return out.c_str();
}

}  // namespace navvi_config
