// Damaged files of a person, of places, phrases, questions and parameters.

#include "fuzz.hpp"

#include <gtest/gtest.h>

#include <navvi_files/files.hpp>

#include "lessons/questionnaire.hpp"
#include "navvi_feedback/menu/places_file.hpp"
#include "node/node_config.hpp"
#include "person/person_file.hpp"

namespace navvi_feedback::node {
namespace {

std::string text_of(const std::string& path) {
  return navvi_files::read_file(path).value_or("");
}

TEST(FuzzFiles, places_are_read_or_refused) {
  const std::string places =
      "- {name: desk, x: 1.5, y: -2}\n- name: the door\n  x: 3\n  y: 4.25\n  do: scan\n";
  navvi_test::fuzz({places}, "a.yaml", [](const std::string& path) {
    static_cast<void>(menu::read_places(path));
  });
}

TEST(FuzzFiles, questions_are_read_or_refused) {
  const std::string tlx =
      NAVVI_FEEDBACK_CONFIG_DIR "/../../navvi_study/studies/questionnaires/tlx.yaml";
  navvi_test::fuzz({text_of(tlx)}, "a.yaml", [](const std::string& path) {
    static_cast<void>(lessons::read_questions(path));
  });
}

TEST(FuzzFiles, phrases_are_read_or_refused) {
  const std::string folder = NAVVI_FEEDBACK_CONFIG_DIR "/phrases/";
  navvi_test::fuzz({text_of(folder + "en.yaml"), text_of(folder + "es.yaml")}, "a.yaml",
                   [](const std::string& path) { cues::Phrases{path}; });
}

TEST(FuzzFiles, settings_of_a_person_are_read_or_refused_and_kept) {
  const navvi_test::TempFolder home;
  const auto people = [](const std::string& folder) {
    ::setenv("NAVVI_PEOPLE", folder.c_str(), 1);
    return person::PersonFile::of<PersonConfig>("ann");
  };
  people(home.string()).save({"speaker/rate:=300", "lead:=flow", "haptics/strength:=0.5"});
  navvi_test::fuzz({home.text("ann.yaml")}, "ann.yaml", [&](const std::string& path) {
    const person::PersonFile file = people(std::filesystem::path(path).parent_path());
    const std::string before = text_of(path);
    try {
      static_cast<void>(file.load());
    } catch (const navvi_config::ConfigError&) {
      EXPECT_THROW(file.save({"speaker/rate:=250"}), std::runtime_error);
      EXPECT_EQ(text_of(path), before);
      throw;
    }
    file.save({"speaker/rate:=250"});
    EXPECT_EQ(file.load()["speaker"]["rate"].as<double>(), 250.0);
  });
  ::unsetenv("NAVVI_PEOPLE");
}

}  // namespace
}  // namespace navvi_feedback::node
