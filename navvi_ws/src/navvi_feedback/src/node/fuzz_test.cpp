// Damaged files of a person, of places, phrases, questions and parameters; frames and messages
// of devices.

#include "fuzz_message.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include <navvi_files/files.hpp>

#include "lessons/questionnaire.hpp"
#include "navvi_feedback/menu/places_file.hpp"
#include "navvi_feedback/node/msg_conversion.hpp"
#include "node/node_config.hpp"
#include "person/person_file.hpp"
#include "process/frame.hpp"

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

TEST(FuzzFrames, of_the_voice_are_whole_or_the_last) {
  const std::string frame("\x22\x56\0\0\4\0\0\0abcd", 12);  // 22050 Hz, 4 bytes
  navvi_test::fuzz_bytes({frame + frame}, [](const std::string& damaged) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    static_cast<void>(!::send(ends[0], damaged.data(), damaged.size(), MSG_DONTWAIT));
    ::close(ends[0]);
    std::size_t read = 0;
    while (const auto got = process::receive(ends[1], process::Clock::now()))
      read += 8 + got->bytes.size();
    EXPECT_LE(read, damaged.size());
    ::close(ends[1]);
  });
}

TEST(FuzzMessages, J7_of_a_stick_are_in_range_or_dropped) {
  sensor_msgs::Joy joy;
  joy.axes = {0.5F, -1.0F};
  joy.buttons = {0, 1};
  navvi_test::fuzz_message(joy, [](const sensor_msgs::Joy& msg) {
    if (const auto input = from_msg(msg)) {
      for (const double axis : input->axes) EXPECT_LE(std::abs(axis), 1.001);
    }
  });
}

}  // namespace
}  // namespace navvi_feedback::node
