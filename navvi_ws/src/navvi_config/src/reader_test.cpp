#include "navvi_config/reader.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace navvi_config {
namespace {

struct Inner {
  std::string curve = "log";
  std::vector<std::string> classes = {"box"};
  void describe(Visitor& visit) {
    visit(curve, "curve", OneOf{{"log", "linear"}}, "", "shape");
    visit(classes, "classes", OneOf{{"box", "shelf"}}, "", "what rumbles");
  }
};

struct Config {
  double speed = 1.0;
  int count = 3;
  bool on = false;
  Inner inner;
  void describe(Visitor& visit) {
    visit(speed, "speed", Range{0.1, 3.0}, "m/s", "speed at full stick");
    visit(count, "count", Range{0, 10}, "", "how many");
    visit(on, "on", Any{}, "", "whether");
    visit.group("inner", inner);
  }
};

std::string refusal(const std::string& yaml) {
  Config config;
  try {
    read(config, YAML::Load(yaml), "test.yaml");
  } catch (const ConfigError& error) {
    EXPECT_EQ(config.speed, 1.0) << "a refused document changed the config";
    return error.what();
  }
  return "";
}

/// What load_yaml says of a file with that content, from "line" on; empty if it takes it.
std::string refusal_of_file(const std::string& content) {
  const std::filesystem::path path = testing::TempDir() + "navvi_reader_test.yaml";
  std::ofstream(path) << content;
  std::string said;
  try {
    (void)load_yaml(path);
  } catch (const ConfigError& error) {
    said = error.what();
    EXPECT_EQ(said.rfind(path.string() + ", line ", 0), 0U) << said;
    said.erase(0, said.find("line "));
  }
  std::filesystem::remove(path);
  return said;
}

TEST(Reader, an_empty_document_keeps_every_default) {
  Config config;
  read(config, YAML::Load(""), "test.yaml");
  EXPECT_EQ(config.speed, 1.0);
  EXPECT_EQ(config.inner.curve, "log");
}

TEST(Reader, keys_that_are_given_overlay_those_that_are_not) {
  Config config;
  read(config, YAML::Load("speed: 2\ninner: {classes: [shelf, box]}\non: true"), "test.yaml");
  EXPECT_EQ(config.speed, 2.0);
  EXPECT_EQ(config.count, 3);
  EXPECT_TRUE(config.on);
  EXPECT_EQ(config.inner.classes, (std::vector<std::string>{"shelf", "box"}));
}

TEST(Reader, P1_every_bad_document_is_refused) {
  for (const char* yaml :
       {"speed: .nan", "speed: .inf", "speed: fast", "speed: [1]", "speed:", "count: 1.5",
        "count: 010", "count: 99999999999", "on: 7", "sped: 1", "inner: 3", "inner: {curve: exp}",
        "inner: {classes: box}", "inner: {classes: [wall]}", "inner: {x: 1}", "[1, 2]",
        "speed: 1.5\nspeed: 2.0", "inner: {curve: log, curve: log}"}) {
    EXPECT_NE(refusal(yaml), "") << yaml;
  }
}

TEST(Reader, a_refusal_names_line_key_and_what_is_allowed_or_known) {
  EXPECT_EQ(refusal("count: 1\nspeed: -4"),
            "test.yaml, line 2: \"speed\" is -4; allowed is 0.1 to 3 m/s.");
  EXPECT_EQ(refusal("count: 99999999999"),
            "test.yaml, line 1: \"count\" is 99999999999; allowed is a whole number, 0 to 10.");
  EXPECT_EQ(
      refusal("inner: {kurve: log}"),
      "test.yaml, line 1: the key \"inner/kurve\" is unknown; nearest is curve; known here "
      "are classes, curve.");
}

TEST(Reader, a_parameter_of_an_earlier_version_is_named_and_ignored_in_files_alone) {
  Config config;
  const YAML::Node before = YAML::Load("speed: 2\nmarkers: {path_width: 0.3}\nstale: 1");
  testing::internal::CaptureStderr();
  read(config, before, "test.yaml", Removed::ignored);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(config.speed, 2.0);
  EXPECT_NE(said.find("test.yaml, line 2: \"markers\" is of an earlier version and is ignored."),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("line 3: \"stale\""), std::string::npos) << said;
  EXPECT_EQ(refusal("stale: 1"),
            "test.yaml, line 1: the key \"stale\" is of an earlier version, and its value is "
            "fixed now.");
  EXPECT_THROW(read(config, YAML::Load("sped: 1"), "test.yaml", Removed::ignored), ConfigError);
}

TEST(Reader, an_error_cites_no_more_of_a_file_than_tells_which_value_is_meant) {
  const std::string letters(1000, 'x');
  for (const std::string& said : {refusal("speed: " + letters), refusal(letters + ": 1"),
                                  refusal_of_file("speed: *" + letters)}) {
    EXPECT_NE(said, "");
    EXPECT_LT(said.size(), 250U) << said;
  }
}

TEST(Reader, a_refusal_cites_no_control_character) {
  const std::string said = refusal("speed: \"\\e[31mred\"");
  EXPECT_NE(said.find("[31mred"), std::string::npos) << said;
  EXPECT_EQ(said.find('\x1b'), std::string::npos) << said;
}

TEST(Reader, P1_a_missing_file_and_a_broken_file_are_told_apart) {
  EXPECT_THROW((void)load_yaml("/nonexistent.yaml"), ConfigError);
  EXPECT_EQ(refusal_of_file("a: 1\n  b: 2\n"), "line 2: this is not YAML: illegal map value.");
  EXPECT_EQ(refusal_of_file(std::string(5000, '[')),
            "line 1: this is not YAML: it is nested too deep.");
}

TEST(Reader, what_stands_behind_the_first_document_of_a_file_is_not_passed_over) {
  EXPECT_EQ(refusal_of_file("a: 1\n---\na: 2\n"),
            "line 3: a second document begins; allowed is one in a file.");
  for (const char* one : {"---\na: 1\n...\n", "", "# nothing\n"})
    EXPECT_EQ(refusal_of_file(one), "") << one;
}

TEST(Reader, P1_a_file_that_begins_with_a_sign_of_lists_is_refused_and_not_read_without_end) {
  EXPECT_EQ(refusal_of_file(", a\n"),
            "line 1: this is not YAML: nothing can begin with this sign.");
  for (const char sign : std::string(",]}:?-!&*|>%@`\"'#"))
    for (const char* rest : {"", " a\n", "\n,\n", ",a", " ,"})
      (void)refusal_of_file(sign + std::string(rest));
  EXPECT_NE(refusal_of_file("a: 1\n, b\n"), "");
  EXPECT_NE(refusal_of_file("--- , a\n"), "");
}

TEST(Table, lists_each_field_with_its_group_default_and_range) {
  const std::vector<Row> rows = table<Config>();
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0].key, "speed");
  EXPECT_EQ(rows[0].allowed, "0.1 to 3 m/s");
  EXPECT_EQ(rows[3].key, "inner/curve");
  EXPECT_EQ(rows[3].allowed, "one of log, linear");
  const YAML::Node read = YAML::Load(json(rows));
  EXPECT_EQ(read[0]["parameter"].as<std::string>(), "speed");
  EXPECT_EQ(read[0]["allowed"].as<std::string>(), "0.1 to 3 m/s");
  EXPECT_EQ(read[0]["meaning"].as<std::string>(), "speed at full stick");
}

TEST(Words, become_keys_in_maps) {
  const YAML::Node node = read_words({"speed:=2", "inner/curve:=linear", "inner/name:=a:=b"});
  EXPECT_EQ(node["speed"].as<double>(), 2.0);
  EXPECT_EQ(node["inner"]["curve"].as<std::string>(), "linear");
  EXPECT_EQ(node["inner"]["name"].as<std::string>(), "a:=b");
}

TEST(Words, hold_lists_in_brackets) {
  const YAML::Node node = read_words({"classes:=[box, pedestal]", "none:=[]"});
  EXPECT_EQ(node["classes"].as<std::vector<std::string>>(),
            (std::vector<std::string>{"box", "pedestal"}));
  EXPECT_TRUE(node["none"].IsSequence());
  EXPECT_THROW(static_cast<void>(read_words({"classes:=[box"})), ConfigError);
}

TEST(Words, are_handed_on_as_one_line_of_YAML) {
  EXPECT_EQ(one_line(read_words({"a/b:=1.5", "c:=[x, y]", "a/d:=a: b"})),
            "{a: {b: 1.5, d: \"a: b\"}, c: [x, y]}");
}

TEST(Words, are_laid_over_what_is_there) {
  const YAML::Node base = YAML::Load("{a: {b: 1, c: 2}, d: [1, 2], e: 3}");
  overlay(base, read_words({"a/b:=5", "d:=[7]", "f/g:=8"}));
  EXPECT_EQ(one_line(base), "{a: {b: 5, c: 2}, d: [7], e: 3, f: {g: 8}}");
}

TEST(Words, without_a_name_or_with_one_twice_are_refused) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"speed"},
                                             {":=2"},
                                             {"a/:=1"},
                                             {"/a:=1"},
                                             {"a//b:=1"},
                                             {"/:=1"},
                                             {"a:=1", "a:=2"},
                                             {"a:=1", "a/b:=2"},
                                             {"a/b:=2", "a:=1"}})
    EXPECT_THROW(static_cast<void>(read_words(words)), ConfigError) << words.back();
}

}  // namespace
}  // namespace navvi_config
