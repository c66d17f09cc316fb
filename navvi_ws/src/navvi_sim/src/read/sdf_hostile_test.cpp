// Worlds that nobody means well with.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

class HostileWorld : public SdfFolder {};

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
      write("a.txt", "hello"),
      write("words.world", "this is no XML"),
      write("html.sdf", "<html><body/></html>"),
      write("model.sdf", "<sdf version='1.6'><model name='m'>" + cube_ + "</model></sdf>"),
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
  EXPECT_NE(sentence_of(write_world(ground_ + "<include><uri>model://a</uri></include>"))
                .find("includes itself"),
            std::string::npos);
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
