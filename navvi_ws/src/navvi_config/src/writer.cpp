#include "navvi_config/writer.hpp"

#include <yaml-cpp/yaml.h>

#include <array>
#include <charconv>

namespace navvi_config {
namespace {

class YamlWriter : public Visitor {
 public:
  YamlWriter() { out_ << YAML::BeginMap; }

  void visit(const Field& field, bool& value) override { key(field.name) << value; }
  void visit(const Field& field, int& value) override { key(field.name) << value; }
  void visit(const Field& field, double& value) override { key(field.name) << exact(value); }
  void visit(const Field& field, std::string& value) override {
    key(field.name) << YAML::DoubleQuoted << value;
  }
  void visit(const Field& field, std::vector<double>& value) override {
    key(field.name) << YAML::Flow << YAML::BeginSeq;
    for (const double number : value) out_ << exact(number);
    out_ << YAML::EndSeq;
  }
  void visit(const Field& field, std::vector<std::string>& value) override {
    key(field.name) << YAML::Flow << YAML::BeginSeq;
    for (const std::string& word : value) out_ << YAML::DoubleQuoted << word;
    out_ << YAML::EndSeq;
  }

  [[nodiscard]] std::string text() {
    out_ << YAML::EndMap;
    return std::string(out_.c_str()) + "\n";
  }

 protected:
  void enter(const std::string& name) override { key(name) << YAML::BeginMap; }
  void leave() override { out_ << YAML::EndMap; }

 private:
  YAML::Emitter& key(const std::string& name) { return out_ << YAML::Key << name << YAML::Value; }

  YAML::Emitter out_;
};

}  // namespace

std::string exact(double number) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), end.ptr};
}

std::string write_fields(const std::function<void(Visitor&)>& describe) {
  YamlWriter writer;
  describe(writer);
  return writer.text();
}

}  // namespace navvi_config
