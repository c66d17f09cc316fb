// Worlds that nobody means well with.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <random>

#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

class HostileWorld : public SdfFolder {};

std::string repeated(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

TEST_F(HostileWorld, is_refused_with_one_sentence_that_names_the_file) {
  const std::string deep = repeated("<model name='m'>", 90) + repeated("</model>", 90);
  write("folder.dae/x", "");
  ASSERT_EQ(mkfifo((folder_ / "pipe.world").c_str(), 0600), 0);
  std::filesystem::create_directories(folder_ / "dir.world");
  write("big.world", "<sdf version='1.6'><world name='w'>" + repeated(" ", 21'000'000));
  const std::vector<std::string> files{
      (folder_ / "none.world").string(),
      (folder_ / "dir.world").string(),
      (folder_ / "pipe.world").string(),
      (folder_ / "big.world").string(),
      write("empty.world", ""),
      write("zeros.world", std::string(1000, '\0')),
      write("noise.world", "\x89PNG\r\n\x1a\n\xff\xfe\x00\x01"),
      write("two.world", "<sdf version='1.6'/><sdf version='1.6'/>"),
      write("bomb.world",
            "<!DOCTYPE l [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;'>]><sdf version='1.6'>"
            "<world name='&b;'><model name='&b;'/></world></sdf>"),
      write("outside.world",
            "<!DOCTYPE l [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><sdf version='1.6'><world "
            "name='&a;'/></sdf>"),
      write("nested.world", "<sdf version='1.6'><world name='w'>" + repeated("<model>", 5000)),
      write("text.world", "<sdf version='1.6'><world name='w'>" + repeated("<a>", 5000)),
      write_world(deep),
      write("unclosed.world", "<sdf version='1.6'><world name='w'><model name='a'>"),
  };
  for (const std::string& file : files) {
    const std::string sentence = sentence_of(file);
    EXPECT_NE(sentence.find(file.substr(file.rfind('/') + 1)), std::string::npos)
        << file << ": " << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    EXPECT_LT(sentence.size(), 600U) << sentence;
  }
}

TEST_F(HostileWorld, of_includes_that_lead_nowhere_round_or_out_is_refused) {
  write_model("a", "<include><uri>model://b</uri></include>");
  write_model("b", "<include><uri>model://a</uri></include>");
  write_model("self", "<include><uri>model://self</uri></include>");
  write("models/no_file/model.config", "<model><sdf>none.sdf</sdf></model>");
  write("models/no_config/other.sdf", "<sdf version='1.6'/>");
  write("models/empty/model.sdf", "<sdf version='1.6'/>");
  write("models/urdf/model.sdf", "<robot name='r'/>");
  for (int i = 0; i < 40; ++i)
    write_model("chain" + std::to_string(i),
                "<include><uri>model://chain" + std::to_string(i + 1) + "</uri></include>");
  write_model("chain40", cube_);
  for (int i = 0; i < 30; ++i)
    write_model(
        "tree" + std::to_string(i),
        repeated("<include><uri>model://tree" + std::to_string(i + 1) + "</uri></include>", 10));
  write_model("tree30", cube_);
  for (const char* uri :
       {"model://none", "", "model://", "http://example.org/model", "model://a", "model://self",
        "model://no_file", "model://no_config", "model://empty", "model://urdf", "model://chain0",
        "model://tree0", "model://../models/a", "model:///etc", "/dev/null", "/dev/zero", "."}) {
    const std::string sentence = sentence_of(
        write_world(ground_ + "\n<include><uri>" + std::string(uri) + "</uri></include>"));
    EXPECT_NE(sentence, "") << uri;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(folder_.string()), std::string::npos) << sentence;
  }
}

/// A small world with something of everything.
constexpr const char* kSmall = R"(<?xml version='1.0'?>
<sdf version='1.9'><world name='w'><light name='sun' type='point'/>
<frame name='f'><pose relative_to='crate'>1 0 0 0 0 0</pose></frame>
<model name='ground'><link name='l'><collision name='c'><pose>0 0 -0.05 0 0 0</pose><geometry>
<box><size>20 20 0.1</size></box></geometry></collision></link></model>
<model name='crate' placement_frame='l'><pose degrees='true'>2 0 0.5 0 0 30</pose><link name='l'>
<collision name='c'><geometry><cylinder><radius>0.4</radius><length>1</length></cylinder></geometry>
</collision><visual name='v'/></link><joint name='j' type='fixed'><parent>world</parent><child>l
</child></joint></model>
<model name='shelf'><pose relative_to='f'>0 3 1 0 0 0</pose><link name='l'><collision name='c'>
<geometry><mesh><uri>m.obj</uri><scale>1 1 2</scale></mesh></geometry></collision></link><model
 name='in'><link name='k'><collision name='d'><geometry><capsule><radius>0.1</radius><length>1</length>
</capsule></geometry></collision></link></model></model>
<include><uri>model://part</uri><name>p1</name><pose>0 -3 0 0 0 0</pose></include>
<model name='post'><link name='l'><collision name='c'><geometry><polyline><height>1</height>
<point>0 0</point><point>1 0</point><point>0 1</point></polyline></geometry></collision></link>
<plugin name='p' filename='gz-sim-trajectory-follower-system'><loop>true</loop><waypoints>
<waypoint>4 0</waypoint><waypoint>4 4</waypoint></waypoints></plugin></model>
<actor name='ann'><script><loop>true</loop><delay_start>1</delay_start><trajectory id='0' type='w'>
<waypoint><time>0</time><pose>0 0 1 0 0 0</pose></waypoint><waypoint><time>3</time>
<pose>3 0 1 0 0 0</pose></waypoint></trajectory></script></actor>
<state world_name='w'><model name='post'><pose>1 1 0 0 0 0</pose></model></state>
</world></sdf>)";

/// One change of some kind at a random place.
std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::vector<std::string> words{"nan",
                                       "-1",
                                       "1e999",
                                       "1e-320",
                                       "0",
                                       "",
                                       "-0",
                                       "99999999999999999999",
                                       "<",
                                       ">",
                                       "/>",
                                       "</",
                                       "'",
                                       "&",
                                       "&#0;",
                                       "<model name='x'>",
                                       "</model>",
                                       "<!--",
                                       "]]>",
                                       "model://",
                                       "..",
                                       "__model__",
                                       "l",
                                       "world",
                                       "crate",
                                       "::",
                                       "\xff",
                                       "true",
                                       "<include/>",
                                       "<pose/>",
                                       "relative_to='f'"};
  if (text.empty()) return "<";
  const std::size_t at = below(text.size());
  switch (below(6)) {
    case 0:
      return text.erase(at, 1 + below(20));
    case 1:
      return text.insert(at, words[below(words.size())]);
    case 2:
      text[at] = static_cast<char>(below(256));
      return text;
    case 3:
      return text.insert(at, text.substr(below(text.size()), below(200)));
    case 4:
      return text.substr(0, at);
    default: {  // a word between > and < is replaced
      const std::size_t open = text.find('>', at);
      const std::size_t close = open == std::string::npos ? open : text.find('<', open);
      if (close == std::string::npos) return text;
      return text.replace(open + 1, close - open - 1, words[below(words.size())]);
    }
  }
}

TEST_F(HostileWorld, however_it_is_mangled_is_read_or_refused_with_a_sentence) {
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n");
  write_model("part", cube_);
  ASSERT_EQ(sentence_of(write("a.world", kSmall)), "");
  int read = 0;
  int refused = 0;
  std::mt19937 random(20260101);
  for (int i = 0; i < 800; ++i) {
    std::string text = kSmall;
    const std::size_t changes = i % 3 == 0 ? 3 : 1;
    for (std::size_t k = 0; k < changes; ++k) text = mutated(text, random);
    const std::string file = write("a.world", text);
    try {
      static_cast<void>(load_world({file}));
      ++read;
    } catch (const WorldError& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find("a.world"), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(read, 60);
  EXPECT_GT(refused, 200);
}

TEST_F(HostileWorld, with_a_mangled_mesh_is_read_or_refused_with_a_sentence) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\n";
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid a\n";
  const std::string file = write_world(ground_ + model("it", "<mesh><uri>m.stl</uri></mesh>") +
                                       model("at", "<mesh><uri>m.obj</uri></mesh>"));
  std::mt19937 random(20260102);
  for (int i = 0; i < 300; ++i) {
    write("m.obj", i % 2 == 0 ? mutated(obj, random) : obj);
    write("m.stl", i % 2 == 1 ? mutated(stl, random) : stl);
    try {
      static_cast<void>(load_world({file}));
    } catch (const WorldError& error) {
      EXPECT_NE(std::string(error.what()).find("a.world"), std::string::npos) << error.what();
    }
  }
}

TEST_F(HostileWorld, of_an_element_with_very_many_attributes_is_refused_at_once) {
  std::string many;
  for (int i = 0; i < 200'000; ++i) many += " a" + std::to_string(i) + "='1'";
  const std::string sentence = sentence_of(write_world("\n<model name='m'" + many + "/>"));
  EXPECT_NE(sentence.find("attributes or more"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("line "), std::string::npos) << sentence;
}

}  // namespace
}  // namespace navvi_sim::read

/// assimp loses memory over some broken files; the leak sanitizer asks here what is not ours.
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp"; }
