#include "generate/layout_source.hpp"

#include <gtest/gtest.h>

#include "navvi_sim/read/world_source.hpp"
#include "read/layout_world.hpp"
#include "temp_folder.hpp"

namespace navvi_sim::generate {
namespace {

namespace fs = std::filesystem;

class LayoutFile : public testing::Test {
 protected:
  std::string write(const std::string& text) const {
    return folder_.write("hall.yaml", text);
  }
  WorldDescription world(const std::string& text) const {
    return read::load_world({write(text)}).world;
  }
  std::string sentence_of(const std::string& text) const {
    try {
      static_cast<void>(world(text));
    } catch (const WorldError& error) {
      return error.what();
    }
    return "";
  }

  navvi_test::TempFolder folder_;
};

TEST_F(LayoutFile, starts_from_its_preset_and_changes_what_it_names) {
  const LayoutSource source =
      read_layout(write("name: my hall\npreset: busy\nlayout:\n  length: 70\n  forklifts: 3\n"));
  EXPECT_EQ(source.name, "my hall");
  EXPECT_EQ(source.config.length, 70.0);
  EXPECT_EQ(source.config.forklifts, 3);
  EXPECT_EQ(source.config.pallet_robots, preset("busy")->pallet_robots);
  EXPECT_EQ(world("preset: busy").name, "hall");
  EXPECT_EQ(world("layout:\n  length: 34\n").things.size(),
            read::load_world({"easy"}).world.things.size());
}

TEST_F(LayoutFile, depends_on_the_seed_as_a_preset_does) {
  const std::string file = write("preset: narrow\nname: narrow\n");
  EXPECT_EQ(world_hash(read::load_world({file, "", 4}).world),
            world_hash(read::load_world({"narrow", "", 4}).world));
  EXPECT_NE(world_hash(read::load_world({file, "", 4}).world),
            world_hash(read::load_world({file, "", 5}).world));
}

TEST_F(LayoutFile, is_refused_in_one_sentence_with_file_line_and_what_is_allowed) {
  struct Bad {
    std::string text;
    int line;
  };
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += '[';
  std::string bomb = "layout:\n  length: &a [1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (char name = 'b'; name <= 'l'; ++name) {
    bomb += std::string("  x") + name + ": &" + name + " [";
    for (int i = 0; i < 9; ++i)
      bomb += std::string(i > 0 ? "," : "") + " *" + static_cast<char>(name - 1);
    bomb += "]\n";
  }
  const std::vector<Bad> all{
      {"preset: office", 1},
      {"preset: [busy]", 1},
      {"preset: busy\npreset: easy", 2},
      {"layout: 3", 1},
      {"layout: [length, 3]", 1},
      {"layout: {}\nthings: []", 2},
      {"layout:\n  length: 40\nlayout:\n  length: 50", 3},
      {"layout:\n  lenght: 40", 2},
      {"layout:\n  length: 40\n  length: 50", 3},
      {"layout:\n  length: .nan", 2},
      {"layout:\n  length: .inf", 2},
      {"layout:\n  length: -40", 2},
      {"layout:\n  length: 1e300", 2},
      {"layout:\n  length: 9.9", 2},
      {"layout:\n  length: 300.1", 2},
      {"layout:\n  length: long", 2},
      {"layout:\n  length: {a: 1}", 2},
      {"layout:\n  length:", 2},
      {"layout:\n  rows: 3.5", 2},
      {"layout:\n  rows: 010", 2},
      {"layout:\n  rows: -1", 2},
      {"layout:\n  rows: 99999999999999999999", 2},
      {"layout:\n  fill: 1.01", 2},
      {"layout:\n  forklifts: 1001", 2},
      {"layout:\n  pedestal_max: 0.31", 2},
      {"layout:\n\tlength: 40", 2},
      {"layout: {length: 40", 1},
      {"layout:\n  length: *nowhere", 2},
      {"layout: " + deep, 1},
      {bomb, 2},
  };
  for (const Bad& bad : all) {
    const std::string sentence = sentence_of(bad.text);
    const std::string shown = bad.text.substr(0, 60) + " -> " + sentence;
    EXPECT_NE(sentence.find("hall.yaml"), std::string::npos) << shown;
    EXPECT_NE(sentence.find("line " + std::to_string(bad.line)), std::string::npos) << shown;
    EXPECT_LT(sentence.size(), 1000u) << shown;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << shown;
  }
}

TEST_F(LayoutFile, that_contradicts_itself_is_refused_with_field_line_and_what_is_allowed) {
  struct Contradiction {
    std::string field;
    int line;
    std::string fields;
  };
  const std::vector<Contradiction> all{
      {"rows", 3, "aisle: 3\n  rows: 40"},
      {"blocks", 2, "blocks: 50"},
      {"bays", 2, "bays: 150"},
      {"aisle", 2, "aisle: 20"},
      {"cross-aisles", 2, "cross_aisle: 20\n  bays: 0"},
      {"docks", 2, "docks: 100"},
      {"walls", 2, "walls: 100"},
      {"door", 3, "walls: 1\n  door: 10"},
      {"clutter", 2, "clutter: 0.6\n  pedestals: 0.6"},
      {"pedestal_min", 2, "pedestal_min: 0.3\n  pedestal_max: 0.1"},
      {"pallets", 3, "aisle: 1.5\n  pallets: 0.5"},
      {"forklifts", 2, "forklifts: 500"},
      {"pallet_robots", 2, "pallet_robots: 1000"},
      {"walking_workers", 2, "walking_workers: 1000"},
      {"standing_workers", 2, "standing_workers: 1000"},
  };
  for (const Contradiction& one : all) {
    const std::string sentence = sentence_of("layout:\n  " + one.fields);
    for (const std::string& words :
         {"hall.yaml, line " + std::to_string(one.line), one.field, std::string("allowed")})
      EXPECT_NE(sentence.find(words), std::string::npos) << one.field << ": " << sentence;
  }
}

TEST_F(LayoutFile, is_told_which_keys_there_are_when_it_has_none_that_is_known) {
  for (const char* text : {"", "# nothing\n", "~", "[1, 2]", "hall", "colour: red"}) {
    const std::string sentence = sentence_of(text);
    EXPECT_NE(sentence.find("it needs preset or layout"), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find("line 0"), std::string::npos) << sentence;
  }
}

TEST_F(LayoutFile, N11_is_refused_when_it_is_too_large_before_it_is_read) {
  std::string text = "layout:\n  length: 40\n";
  text += "#" + std::string(10'000'000, 'x') + "\n";
  EXPECT_NE(sentence_of(text).find("1 MiB"), std::string::npos) << sentence_of(text);
}

TEST(LayoutSources, are_presets_and_layout_files_only) {
  EXPECT_TRUE(read::layout_source("maze"));
  EXPECT_TRUE(read::layout_source("warehouse"));
  EXPECT_FALSE(read::layout_source((fs::path(NAVVI_SIM_DIR) / "worlds/crossing.sdf").string()));
  EXPECT_THROW(static_cast<void>(read::layout_source("office")), WorldError);
}

}  // namespace
}  // namespace navvi_sim::generate
